#pragma once
// A page to look a library of skies through: HTML that works from the file system.
#include <string>

#include "core/result.h"
#include "pipeline/job_context.h"

namespace skylapse::pipeline {

/// The page of all frames of a job, from what the ledger knows: per sky its preview (the
/// display-referred image output `image_path`; its first face if they lie apart), place, time, sun,
/// air, light, and every file with size, sha256 and irradiance after encoding. Links are relative
/// to the page; files that the ledger does not know are left out. No clock enters: the same ledger
/// gives the same page. Error (invalid_input, at image_path): no such image output, or one that is
/// not for display.
Result<std::string> make_gallery(const JobContext& job, const config::LibraryOutput& output);

}  // namespace skylapse::pipeline
