#pragma once
// From scene-linear pixels to the files of one frame.
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "output/image_writer.h"
#include "pipeline/frame_light.h"
#include "pipeline/ledger.h"
#include "pipeline/render_frame.h"
#include "plan/plan.h"

namespace skylapse::pipeline {

/// Display transforms of a job, made once and shared by all threads.
class Displays {
 public:
  /// Makes the transform of every output that names a display or view (and checks the names, so
  /// that a slip is found before anything is rendered).
  static Result<Displays> make(const output::ImageIo& io, const config::JobConfig& job);
  /// Nothing for a scene-linear output.
  [[nodiscard]] const output::DisplayTransform* of(size_t output) const;

 private:
  std::vector<std::shared_ptr<const output::DisplayTransform>> by_output_;
};

/// Display-referred 8-bit picture of a frame, dithered with a seed from the frame's moment.
std::vector<uint8_t> display_picture(const plan::Frame& frame, const RenderedFrame& rendered,
                                     const output::DisplayTransform& display, StageTimes& times);

/// What all files of a frame are made from.
struct FrameSource {
  const output::ImageIo& io;
  const plan::Plan& plan;
  const plan::Frame& frame;
  const FrameLight& light;
  const Displays& displays;
  std::filesystem::path folder;
};

/// Renders, encodes and writes one image output of a frame; one ledger entry for each of its files.
Result<std::vector<LedgerEntry>> write_image_output(const FrameSource& source, size_t output,
                                                    const std::string& fingerprint,
                                                    StageTimes& times);

/// Makes and writes one product of a frame; one ledger entry for each of its files.
Result<std::vector<LedgerEntry>> write_product(const FrameSource& source, size_t output,
                                               const std::string& fingerprint, StageTimes& times);

}  // namespace skylapse::pipeline
