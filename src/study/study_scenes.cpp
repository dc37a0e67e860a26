#include "study/study_scenes.h"

#include <fmt/format.h>

#include <algorithm>

#include "astro/time/instant.h"
#include "plan/work_list.h"
#include "study/study_texts.h"

namespace skylapse::study {
namespace {

/// From the easiest sky to the hardest.
constexpr std::array kSceneOrder{"noon", "low_sun", "twilight", "airliner"};

Rung truth_rung() {
  return {"truth", "", "", "", {{"sky.model", "bruneton"}, {"sky.effects", "all"}}, true, false};
}

Result<std::vector<StudyScene>, Diagnostics> built_in(const StudyOptions& options) {
  const auto names = built_in_scenes();
  for (const std::string& wanted : options.scenes)
    if (std::find(names.begin(), names.end(), wanted) == names.end())
      return Diagnostics{{ErrorCode::invalid_input,
                          fmt::format("--scenes: there is no scene '{}'", wanted),
                          {},
                          fmt::format("allowed: {}", fmt::join(names, ", "))}};
  std::vector<StudyScene> scenes;
  for (const std::string& name : names) {
    if (!options.scenes.empty() &&
        std::find(options.scenes.begin(), options.scenes.end(), name) == options.scenes.end())
      continue;
    StudyScene scene;
    scene.id = name;
    const std::string text(study_text("scenes/" + name + ".yaml"));
    scene.load = [text, name](const std::vector<config::Override>& overrides) {
      return config::parse_job(text, name + ".yaml", overrides);
    };
    const auto job = scene.load({});
    if (!job) return job.error();
    scene.title = job->title;
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

/// Up to three, from the first to the last.
std::vector<long> spread_frames(long count) {
  std::vector<long> frames;
  const long wanted = std::min(count, 3L);
  for (long i = 0; i < wanted; ++i)
    frames.push_back(1 + (wanted == 1 ? 0 : i * (count - 1) / (wanted - 1)));
  return frames;
}

Result<std::vector<StudyScene>, Diagnostics> of_config(const StudyOptions& options) {
  StudyScene scene;
  scene.load = [path = options.config](const std::vector<config::Override>& overrides) {
    return config::load_job(path, overrides);
  };
  const auto plan = plan_of_rung(scene, truth_rung(), study_camera(Direction<Enu>{}));
  if (!plan) return plan.error();
  const long count = long(plan->frames.size());
  std::vector<StudyScene> scenes;
  Result<std::vector<long>> frames = spread_frames(count);
  if (!options.frames.empty()) frames = plan::parse_frame_list(options.frames, count);
  if (!frames) return Diagnostics{frames.error()};
  for (const long frame : *frames) {
    scene.frame = frame;
    const std::string stem = std::filesystem::path(options.config).stem().string();
    scene.id = count == 1 ? stem : fmt::format("{}-{:04}", stem, frame);
    const plan::Frame& f = plan->frames[size_t(frame - 1)];
    const std::string title = plan->job.title.empty() ? stem : plan->job.title;
    scene.title = fmt::format("{}, frame {}, sun at {:.1f} deg", title, frame,
                              elevation(f.sky.sun_apparent).in(deg));
    scenes.push_back(scene);
  }
  return scenes;
}

}  // namespace

std::vector<std::string> built_in_scenes() { return {kSceneOrder.begin(), kSceneOrder.end()}; }

Result<std::vector<StudyScene>, Diagnostics> scenes_of(const StudyOptions& options) {
  return options.config.empty() ? built_in(options) : of_config(options);
}

Result<plan::Plan, Diagnostics> prepare_scene(StudyScene& scene, Sampling sampling) {
  auto plan = plan_of_rung(scene, truth_rung(), study_camera(Direction<Enu>{}));
  if (!plan) return plan;
  const plan::Frame& frame = plan->frames[size_t(scene.frame - 1)];
  scene.geometry = {frame.sky.sun_apparent, frame.horizon};
  scene.sun_elevation = elevation(frame.sky.sun_apparent);
  scene.height = frame.camera_height;
  scene.instant = astro::format_utc(frame.instant);
  scene.exposure_ev = frame.ev;
  scene.points = sample_points(scene.geometry, sampling);
  return plan;
}

}  // namespace skylapse::study
