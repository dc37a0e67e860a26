#include "plan/cost_model.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "plan/effect_planner.h"
#include "plan/rates.h"
#include "plan/rung_cost.h"
#include "plan/table_settings.h"

namespace skylapse::plan {
namespace {

/// Nanoseconds of one core per pixel, and bytes per pixel, of a step of the pipeline.
struct Rate {
  double nanoseconds;
  double bytes;
};

constexpr double kSkyNs = 7;       // Hosek-Wilkie, or a picture from a slice
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

/// Core seconds of a pixel of the fits that have no tables of directions, and of a frame.
constexpr double kBaselineNs = 300, kBaselineFrameSeconds = 8e-3;
/// The path tracer: paths a second in the daytime medium (bench_reference prints it), all bands.
constexpr double kPathsPerSecond = 3e5;

/// The media whose tables the frames need, each once, with the sizes that the service takes.
struct TableNeeds {
  std::map<std::string, sky::bruneton::Settings> sets;
  long mixtures = 0;  // frames between two sets
};

TableNeeds table_needs(const Plan& plan, const std::vector<long>& frames) {
  const bool changes = std::any_of(plan.air.sites.begin(), plan.air.sites.end(),
                                   [](const auto& nodes) { return !nodes.empty(); });
  TableNeeds needs;
  std::set<std::tuple<int, int, int>> seen;  // air that stands still: one frame of each will do
  for (const long number : frames) {
    const Frame& frame = plan.frames[number - 1];
    const int camera = int(frame.camera) + int(plan.job.cameras.size()) * frame.site;
    if (!changes && !seen.emplace(frame.turbidity, frame.albedo, camera).second) continue;
    const sky::EffectSet effects = effects_of(plan, frame);
    if (!reads_tables(plan, effects)) continue;
    const auto media = tables_of_frame(plan.job, plan.air, frame);
    if (!media) continue;  // the run will say what is wrong
    const auto settings = table_settings(plan, *media, effects);
    needs.sets.emplace(canonical_text(media->a), settings);
    if (media->weight == 0) continue;
    needs.sets.emplace(canonical_text(media->b), settings);
    ++needs.mixtures;
  }
  return needs;
}

void add_tables(const Plan& plan, const std::vector<long>& frames, Cost& cost) {
  const double groups = (plan.job.sky.wavelengths + 3) / 4;
  const TableNeeds needs = table_needs(plan, frames);
  double bytes = 0;
  for (const auto& [name, settings] : needs.sets) {
    const double texels = double(settings.heights) * settings.sun_rows() * settings.table_azimuths *
                          settings.table_zeniths;
    ++cost.table_sets;
    cost.table_core_seconds += rates::table_seconds(plan, settings);
    bytes = std::max(bytes, groups * 4 * sizeof(float) * texels);
    cost.table_bytes += groups * 4 * sizeof(float) * texels;
  }
  cost.core_seconds +=
      cost.table_core_seconds + double(needs.mixtures) * bytes * rates::kBlendSecondsPerByte;
}

/// Of the sky of one frame, without tables and files.
double sky_seconds(const Plan& plan, const Frame& frame, double pixels) {
  using config::SkyModel;
  switch (plan.model) {
    case SkyModel::cie:
    case SkyModel::preetham:
      return pixels * kBaselineNs * 1e-9 + kBaselineFrameSeconds;
    case SkyModel::reference:
      return pixels * (kPixelSetupSeconds + double(plan.job.sky.paths.samples) / kPathsPerSecond);
    case SkyModel::single_scattering:
    case SkyModel::bruneton:
      return pixels * kSkyNs * 1e-9 +
             rates::frame_slice_seconds(plan, frame, effects_of(plan, frame));
    default:
      return pixels * kSkyNs * 1e-9;
  }
}

}  // namespace

double picture_seconds(const config::JobConfig& job, const image::Camera& camera) {
  double nanoseconds = kSkyNs;
  for (const auto& output : job.outputs) nanoseconds += rate_of(output).nanoseconds;
  return 1e-9 * nanoseconds * camera.width * camera.height;
}

Cost estimate_cost(const Plan& plan, const std::vector<long>& frames) {
  Rate per_pixel{0, 0};
  for (const auto& output : plan.job.outputs) {
    const Rate rate = rate_of(output);
    per_pixel.nanoseconds += rate.nanoseconds;
    per_pixel.bytes += rate.bytes;
  }
  Cost cost;
  if (plan.model == config::SkyModel::bruneton) add_tables(plan, frames, cost);
  for (const long number : frames) {
    const Frame& frame = plan.frames[number - 1];
    const image::Camera& camera = plan.job.cameras[frame.camera].camera;
    const double pixels = double(camera.width) * camera.height;
    cost.core_seconds += pixels * per_pixel.nanoseconds * 1e-9 + sky_seconds(plan, frame, pixels);
    cost.bytes += pixels * per_pixel.bytes;
  }
  return cost;
}

}  // namespace skylapse::plan
