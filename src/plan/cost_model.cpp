#include "plan/cost_model.h"

namespace skylapse::plan {
namespace {

/// Nanoseconds of one core per pixel, and bytes per pixel, of a step of the pipeline.
struct Rate {
  double nanoseconds;
  double bytes;
};

constexpr double kSkyNs = 7;
constexpr double kDisplayNs = 51;  // exposure, display transform, dither
constexpr double kMovieNs = 58;    // reading back and x264

Rate encoding(const config::ImageOutput& output) {
  const bool float32 = output.sample_type == output::SampleType::float32;
  const bool u16 = output.sample_type == output::SampleType::u16;
  if (output.format == "png") return u16 ? Rate{53, 1.8} : Rate{27, 0.9};
  if (output.format == "jpg") return {3, 0.05};
  if (output.format == "hdr") return {8, 0.6};
  if (output.format == "tif") return {float32 ? 120. : 40., float32 ? 7. : u16 ? 2. : 1.};
  return float32 ? Rate{215, 6.8} : Rate{39, 0.4};  // exr
}

Rate rate_of(const config::Output& output) {
  if (const auto* image = std::get_if<config::ImageOutput>(&output)) {
    Rate rate = encoding(*image);
    if (image->view || image->display) rate.nanoseconds += kDisplayNs;
    return rate;
  }
  return {kMovieNs, 0.005};
}

}  // namespace

Cost estimate_cost(const Plan& plan, const std::vector<long>& frames) {
  Rate per_pixel{kSkyNs, 0};
  for (const auto& output : plan.job.outputs) {
    const Rate rate = rate_of(output);
    per_pixel.nanoseconds += rate.nanoseconds;
    per_pixel.bytes += rate.bytes;
  }
  Cost cost;
  for (const long number : frames) {
    const image::Camera& camera = plan.job.cameras[plan.frames[number - 1].camera].camera;
    const double pixels = double(camera.width) * camera.height;
    cost.core_seconds += pixels * per_pixel.nanoseconds * 1e-9;
    cost.bytes += pixels * per_pixel.bytes;
  }
  return cost;
}

}  // namespace skylapse::plan
