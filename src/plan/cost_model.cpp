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

/// Of the sky of one frame, without tables and files, beyond the reading of a table of directions.
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
      return rates::frame_slice_seconds(plan, frame, effects_of(plan, frame));
    default:
      return 0;
  }
}

}  // namespace

Cost estimate_cost(const Plan& plan, const std::vector<long>& frames) {
  const config::JobConfig& job = plan.job;
  std::vector<double> pixels, seconds, bytes;  // of a frame of each camera
  for (const config::CameraConfig& camera : job.cameras) {
    pixels.push_back(picture_pixels(job, camera));
    seconds.push_back(picture_seconds(job, camera));
    bytes.push_back(0);
    for (const auto& output : job.outputs) bytes.back() += cost_of_output(output, camera).bytes;
  }
  Cost cost;
  cost.outputs.resize(job.outputs.size());
  if (plan.model == config::SkyModel::bruneton) add_tables(plan, frames, cost);
  for (const long number : frames) {
    const Frame& frame = plan.frames[number - 1];
    cost.core_seconds += seconds[frame.camera] + sky_seconds(plan, frame, pixels[frame.camera]);
    cost.bytes += bytes[frame.camera];
    for (size_t o = 0; o < job.outputs.size(); ++o) {
      const OutputCost one = cost_of_output(job.outputs[o], job.cameras[frame.camera]);
      cost.outputs[o].core_seconds += one.core_seconds;
      cost.outputs[o].bytes += one.bytes;
    }
  }
  return cost;
}

}  // namespace skylapse::plan
