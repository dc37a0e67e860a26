#include "plan/cost_model.h"

namespace skylapse::plan {
namespace {

/// Nanoseconds of one core per pixel, and bytes per pixel, of a step of the pipeline.
struct Rate {
  double nanoseconds;
  double bytes;
};

constexpr double kSkyNs = 8;
constexpr double kDisplayNs = 190;  // exposure, display transform, dither
constexpr double kMovieNs = 120;

Rate encoding(const config::ImageOutput& output) {
  const bool wide = output.sample_type == output::SampleType::float32;
  if (output.format == "png")
    return {output.sample_type == output::SampleType::u16 ? 150. : 75., 1.8};
  if (output.format == "jpg") return {12, 0.12};
  if (output.format == "hdr") return {25, 3.2};
  if (output.format == "tif") return {60, wide ? 10. : 5.};
  return {wide ? 160. : 80., wide ? 9.0 : 3.2};  // exr
}

Rate rate_of(const config::Output& output) {
  if (const auto* image = std::get_if<config::ImageOutput>(&output)) {
    Rate rate = encoding(*image);
    if (image->view || image->display) rate.nanoseconds += kDisplayNs;
    return rate;
  }
  return {kMovieNs, 0.02};
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
