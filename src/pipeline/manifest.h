#pragma once
#include "core/result.h"
#include "pipeline/job_context.h"

namespace skylapse::pipeline {

/// Writes OUT/manifest.json: per frame the moment, sun and moon, exposure, model, effects, and per
/// file fingerprint, sha256, bytes and milliseconds. Holds the folder's lock meanwhile and reads
/// the records of all shards again, so that the last shard to finish writes the whole manifest.
/// Frames with no finished file are left out until they have one.
Status write_manifest(const JobContext& job);

}  // namespace skylapse::pipeline
