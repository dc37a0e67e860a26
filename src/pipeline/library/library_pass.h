#pragma once
// Outputs made of all frames of a job that are no movies: gallery and contact sheet.
#include "pipeline/job_context.h"

namespace skylapse::pipeline {

/// Makes what is missing once all frames that it shows are there; else a note says so. One process
/// makes a file, whichever finds it missing first. The same frames give the same bytes.
Status make_library_files(const JobContext& job, RunSummary& summary);

/// The files that are there, for the manifest.
std::vector<LedgerEntry> library_entries(const JobContext& job);

}  // namespace skylapse::pipeline
