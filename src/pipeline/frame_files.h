#pragma once
// From the light of a frame to its files.
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "output/image_writer.h"
#include "pipeline/frame_source.h"
#include "pipeline/ledger.h"
#include "pipeline/output_view.h"
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

/// Seed of the dither: the frame's moment, so that grain moves in time and repeats on resume.
uint64_t dither_seed(const plan::Frame& frame);

/// Exposure and display transform of rows of a picture, all cores; `values` has their size.
void display_values(const plan::Frame& frame, const image::FrameBuffer& scene,
                    const output::DisplayTransform& display, std::span<float> values);

/// Display-referred 8-bit picture of a frame, dithered with a seed from the frame's moment.
std::vector<uint8_t> display_picture(const plan::Frame& frame, const RenderedFrame& rendered,
                                     const output::DisplayTransform& display, StageTimes& times);

/// Pixels of a picture that are in memory at once; larger ones are made in strips of rows.
inline constexpr size_t kStripPixels = size_t{8} << 20;

/// Bytes that a frame takes at most for each pixel in memory: the scene, itself without the disc,
/// the values of a file, and what its library makes of them, three floats each; a weight.
inline constexpr double kBytesPerPixel = 4 * 3 * sizeof(float) + sizeof(float);

/// Image outputs of a frame that show the same pixels.
struct ViewGroup {
  OutputView view;
  std::vector<size_t> outputs;
};
std::vector<ViewGroup> group_by_view(const plan::Plan& plan, const plan::Frame& frame,
                                     const std::vector<size_t>& outputs);

/// What is told of each finished file.
using Record = std::function<Status(LedgerEntry)>;
/// Fingerprint of an output of the frame.
using FingerprintOf = std::function<std::string(size_t output)>;

/// Renders a view once (twice, if it is larger than kStripPixels and a file must know the whole
/// before it begins), encodes and writes all its outputs. The same bytes for any size of the
/// strips. `times` is of all of it; an entry's times are `before`, the view's and its own output's.
Status write_view(const FrameSource& source, const ViewGroup& group,
                  const FingerprintOf& fingerprint_of, const StageTimes& before,
                  const Record& record, StageTimes& times, size_t strip_pixels = kStripPixels);

/// Renders, filters and writes one cube texture: an image output of the format ktx2.
Status write_texture(const FrameSource& source, size_t output, const std::string& fingerprint,
                     const StageTimes& before, const Record& record, StageTimes& times);
/// Whether an output is one.
bool is_texture(const config::Output& output);

/// Makes and writes one product of a frame.
Status write_product(const FrameSource& source, size_t output, const std::string& fingerprint,
                     const StageTimes& before, const Record& record, StageTimes& times);

}  // namespace skylapse::pipeline
