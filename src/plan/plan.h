#pragma once
// The whole job before anything is rendered: frames, sun, exposure, paths. Pure: the same config
// gives the same plan, whoever makes it.
#include <optional>
#include <string>
#include <vector>

#include "astro/sky_state.h"
#include "config/job_config.h"
#include "plan/atmosphere_of_frame.h"
#include "plan/effects/reach.h"
#include "plan/effects/rule.h"
#include "plan/frame_schedule.h"
#include "plan/promise.h"
#include "plan/sight.h"
#include "plan/sky_model.h"
#include "plan/sun_for_sky.h"

namespace skylapse::plan {

struct Frame {
  long index = 0;                                       // 1, 2, ... over the whole job
  int site = 0, turbidity = 0, albedo = 0, camera = 0;  // which of the job's lists
  int sequence = 0;  // frames of one site, air and camera share it
  std::chrono::year_month_day date;
  astro::Instant instant;
  astro::LocalTime local;
  std::optional<AskedSun> asked_sun;  // what put the frame at this moment, if an elevation did
  astro::SkyState sky;
  SunForSky sun;         // what the sky model is asked for
  Length camera_height;  // above the ground of a computed atmosphere; else 0
  Angle horizon;         // elevation of the camera's horizon, at most 0
  double ev = 0;         // EV100
  /// Height of the sun's disc over its width, as refraction would have it; 1 without.
  double sun_flattening = 1;
  /// One for each output of the job; {face} and {level} still to be filled.
  std::vector<std::string> paths;
};

struct Plan {
  config::JobConfig job;
  std::vector<Frame> frames;
  std::vector<std::string> notes;
  config::SkyModel model = config::SkyModel::hosek_wilkie;  // of all frames; never `automatic`
  std::string model_reason;                                 // why that one
  std::optional<Promise> promise;  // what sky.accuracy or sky.time_budget led to
  AirTimeline air;                 // the air's keyframes in time
  // What decisions on effects rest on (effect_planner.h).
  const EffectRules* rules = &standard_rules();
  std::vector<Sight> sights;       // of the frames of each camera
  std::vector<ViewReach> views;    // of each sight
  std::vector<PixelSides> pixels;  // of each sight
  Reach reach;
};

/// Errors carry the spans of the config: unresolvable times, two frames writing one file.
/// `rules` decide on effects and must outlive the plan; other ones than the standard are for tests.
Result<Plan, Diagnostics> make_plan(config::JobConfig job,
                                    const EffectRules& rules = standard_rules());

/// The view that an output of a frame has: its own, else that of the frame's camera.
const config::CameraConfig& view_of(const Plan& plan, const Frame& frame, size_t output);

/// "2k" for a map 2048 wide and twice as wide as high (any multiple of 1024), the side of a square
/// or of a cube's face, else "1920x1080".
std::string size_label(const image::Camera& camera);

/// Paths of the files that one output of a frame writes: one, or six for separate cube faces; of
/// levels in files of their own, all of the first, then all of the second, ...
std::vector<std::string> files_of(const Plan& plan, const Frame& frame, size_t output);

}  // namespace skylapse::plan
