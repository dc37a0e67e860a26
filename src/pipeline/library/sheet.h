#pragma once
// The contact sheet of a job: all its skies with their labels.
#include <string>
#include <vector>

#include "pipeline/existing_frames.h"
#include "pipeline/job_context.h"

namespace skylapse::pipeline {

/// More pictures than these are not put on one sheet of a job: they are evenly chosen, and a note
/// says so.
inline constexpr int kMostOnSheet = 600;

/// PNG or JPEG, by the output's format. The pictures must be there.
Result<std::vector<std::byte>> make_sheet(const JobContext& job,
                                          const config::LibraryOutput& output, RunSummary& summary);

/// What tells frames of one site and time apart: turbidity, ground and camera, each where the job
/// has more than one.
std::vector<std::string> choices_of(const config::JobConfig& job, const plan::Frame& frame);

/// The picture of a frame with its label: site, local time, elevation of the sun, and its choices.
ExistingFrame labelled_frame(const plan::Plan& plan, const plan::Frame& frame,
                             const std::filesystem::path& picture);

}  // namespace skylapse::pipeline
