#include "plan/rung_cost.h"

#include <algorithm>
#include <map>
#include <set>

#include "plan/cost_model.h"
#include "plan/plan.h"
#include "plan/rates.h"
#include "sky/bruneton/sun_range.h"

namespace skylapse::plan {
namespace {

using config::SkyModel;
using sky::atmosphere::Medium;
using sky::bruneton::Settings;

/// Of a slice without multiple scattering (bench_effects).
constexpr double kSingleShareOfSlice = 0.6;

/// What the work of a precomputation grows with.
double work_of(const Settings& s) {
  return double(s.heights) * s.suns * (s.directions_up + s.directions_down) * s.azimuths *
         (s.samples + s.harmonics);
}

/// Work of tables over that in clear air, which the rates are of.
double difficulty(sky::bruneton::Level level, const Settings& settings) {
  const auto clear = sky::atmosphere::atmosphere_of({});
  const Medium usual = medium_at(clear.value(), sky::atmosphere::band_edges(1));
  return work_of(settings) / work_of(settings_for(level, usual));
}

Frame frame_of(const PromiseInputs& in, const Picture& picture) {
  const ScheduledTime& time = in.schedule.times[picture.time];
  Frame frame;
  frame.site = time.site;
  frame.instant = time.instant;
  frame.turbidity = picture.turbidity, frame.albedo = picture.albedo;
  return frame;
}

/// The media whose tables the pictures need, each once.
std::vector<Medium> media_of(const PromiseInputs& in, const std::vector<Picture>& pictures) {
  config::JobConfig coarse = in.job;
  coarse.sky.wavelengths = 1;
  const bool changes =
      std::ranges::any_of(in.air.sites, [](const auto& nodes) { return !nodes.empty(); });
  std::map<std::string, Medium> media;
  std::set<std::pair<int, int>> seen;  // air that stands still: one picture of each will do
  for (const Picture& picture : pictures) {
    if (!changes && !seen.emplace(picture.turbidity, picture.albedo).second) continue;
    const auto tables = tables_of_frame(coarse, in.air, frame_of(in, picture));
    if (!tables) continue;  // the run will say what is wrong
    media.emplace(canonical_text(tables->a), tables->a);
    if (tables->weight > 0) media.emplace(canonical_text(tables->b), tables->b);
  }
  std::vector<Medium> all;
  for (const auto& [text, medium] : media) all.push_back(medium);
  return all;
}

}  // namespace

double picture_seconds_of(const config::JobConfig& job, const std::vector<Picture>& pictures) {
  double seconds = 0;
  for (const Picture& picture : pictures)
    seconds += picture_seconds(job, job.cameras[picture.camera]);
  return pictures.empty() ? 0 : seconds / double(pictures.size());
}

RungCost::RungCost(const PromiseInputs& inputs, const std::vector<Picture>& pictures)
    : picture_seconds_(picture_seconds_of(inputs.job, pictures)),
      media_(media_of(inputs, pictures)) {
  for (const Picture& picture : pictures) {
    const SceneFeatures& scene = picture.scene.features;
    lowest_sun_ = std::min(lowest_sun_, scene.sun_elevation);
    highest_sun_ = std::max(highest_sun_, scene.sun_elevation);
    highest_camera_ = std::max(highest_camera_, scene.height);
  }
  const config::JobConfig& job = inputs.job;
  frames_ = double(std::max<size_t>(1, inputs.schedule.times.size() * job.air.turbidity.size() *
                                           job.air.ground_albedo.size() * job.cameras.size()));
}

double RungCost::core_seconds(const Rung& rung) const {
  if (is_fitted(rung.model)) return picture_seconds_;
  Plan plan;
  plan.job.sky.level = rung.level;
  plan.job.sky.wavelengths = rung.wavelengths;
  const double slice = rates::slice_seconds(plan);
  if (rung.model == SkyModel::single_scattering)
    return picture_seconds_ + kSingleShareOfSlice * slice;
  double tables = 0;
  for (const Medium& medium : media_) {
    const Settings all = settings_for(rung.level, medium);
    const auto suns = sky::bruneton::sun_range_for(medium, 90 * deg - highest_sun_,
                                                   90 * deg - lowest_sun_, highest_camera_);
    // Sizes beyond those of the level in clear air are work beyond that of the rates.
    tables +=
        rates::table_seconds(plan, restricted_to(suns, all, medium)) * difficulty(rung.level, all);
  }
  return picture_seconds_ + slice + tables / frames_;
}

}  // namespace skylapse::plan
