#include "plan/cost_model.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace skylapse::plan {
namespace {

/// Nanoseconds of one core per pixel, and bytes per pixel, of a step of the pipeline.
struct Rate {
  double nanoseconds;
  double bytes;
};

constexpr double kSkyNs = 7;       // either model
constexpr double kSliceMs = 60;    // slice of 16 wavelengths on software GL, and the disc
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

/// Core seconds to compute the tables of four wavelengths on software GL, shaders compiled.
double precomputation_s(sky::bruneton::Level level) {
  switch (level) {
    case sky::bruneton::Level::draft:
      return 0.1;
    case sky::bruneton::Level::low:
      return 0.3;
    case sky::bruneton::Level::standard:
      return 0.55;
    case sky::bruneton::Level::fine:
      return 2.2;
  }
  return 0;
}

/// The media whose tables the frames need, each once.
std::map<std::string, sky::atmosphere::Medium> table_media(const Plan& plan,
                                                           const std::vector<long>& frames) {
  const bool changes = std::any_of(plan.air.sites.begin(), plan.air.sites.end(),
                                   [](const auto& nodes) { return !nodes.empty(); });
  std::map<std::string, sky::atmosphere::Medium> media;
  std::set<std::pair<int, int>> seen;  // air that stands still: one frame of each will do
  for (const long number : frames) {
    const Frame& frame = plan.frames[number - 1];
    if (!changes && !seen.emplace(frame.turbidity, frame.albedo).second) continue;
    const auto of_frame = tables_of_frame(plan.job, plan.air, frame);
    if (!of_frame) continue;  // the run will say what is wrong
    media.emplace(canonical_text(of_frame->a), of_frame->a);
    if (of_frame->weight > 0) media.emplace(canonical_text(of_frame->b), of_frame->b);
  }
  return media;
}

void add_tables(const Plan& plan, const std::vector<long>& frames, Cost& cost) {
  const double groups = (plan.job.sky.wavelengths + 3) / 4;
  for (const auto& [name, medium] : table_media(plan, frames)) {
    const auto settings = sky::bruneton::settings_for(plan.job.sky.level, medium);
    const double texels = double(settings.heights) * settings.sun_rows() * settings.table_azimuths *
                          settings.table_zeniths;
    ++cost.table_sets;
    cost.table_core_seconds += groups * precomputation_s(plan.job.sky.level);
    cost.table_bytes += groups * 4 * sizeof(float) * texels;
  }
  cost.core_seconds += cost.table_core_seconds;
}

}  // namespace

Cost estimate_cost(const Plan& plan, const std::vector<long>& frames) {
  const bool computed = !is_fitted(plan.model);
  Rate per_pixel{kSkyNs, 0};
  for (const auto& output : plan.job.outputs) {
    const Rate rate = rate_of(output);
    per_pixel.nanoseconds += rate.nanoseconds;
    per_pixel.bytes += rate.bytes;
  }
  Cost cost;
  if (plan.model == config::SkyModel::bruneton) add_tables(plan, frames, cost);
  for (const long number : frames) {
    const image::Camera& camera = plan.job.cameras[plan.frames[number - 1].camera].camera;
    const double pixels = double(camera.width) * camera.height;
    cost.core_seconds += pixels * per_pixel.nanoseconds * 1e-9;
    if (computed) cost.core_seconds += 1e-3 * kSliceMs;
    cost.bytes += pixels * per_pixel.bytes;
  }
  return cost;
}

}  // namespace skylapse::plan
