#pragma once
// What all files of a frame are made from, and what they say about it.
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "output/image_writer.h"
#include "output/metadata.h"
#include "pipeline/frame_light.h"
#include "pipeline/ledger.h"
#include "plan/plan.h"

namespace skylapse::pipeline {

class Displays;

struct FrameSource {
  const output::ImageIo& io;
  const plan::Plan& plan;
  const plan::Frame& frame;
  const FrameLight& light;
  const Displays& displays;
  std::filesystem::path folder;
  std::function<bool()> stopped;  // asked now and then
};

/// Attributes that every file of a frame has.
output::FrameMetadata metadata_of(const plan::Plan& plan, const plan::Frame& frame,
                                  const FrameLight& light, const std::string& fingerprint);

/// Adds what is the picture's own: its content, and how `camera`, that of the output, lies.
void describe_picture(const FrameLight& light, const config::ImageOutput& output,
                      const config::CameraConfig& camera, output::FrameMetadata& meta);

/// A record of a finished file with the light of the frame and how sure it is.
LedgerEntry entry_for(const FrameSource& source, std::string file, std::string fingerprint);

/// What the horizontal irradiance of a file is held against, in lux.
struct TrueLight {
  double sky = 0, sun = 0;
};
TrueLight true_light(const FrameLight& light);

}  // namespace skylapse::pipeline
