#pragma once
// What the files of one output cost beside the sky that they show.
#include "config/job_config.h"

namespace skylapse::plan {

struct OutputCost {
  double core_seconds = 0;  // display transform, filtering, encoding
  double bytes = 0;         // written
};

/// Of one frame of one of the job's cameras. For a movie the share of the frame; nothing for what
/// is made of all frames at once.
OutputCost cost_of_output(const config::Output& output, const config::CameraConfig& camera);

/// Core seconds of the pixels of all pictures of a frame, where they are read from a table of
/// directions, and of all files.
double picture_seconds(const config::JobConfig& job, const config::CameraConfig& camera);

/// Pixels of all pictures of a frame.
double picture_pixels(const config::JobConfig& job, const config::CameraConfig& camera);

}  // namespace skylapse::plan
