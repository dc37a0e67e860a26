#include "plan/plan.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <unordered_map>

#include "astro/refraction.h"
#include "config/path_template.h"
#include "config/time_expression.h"
#include "image/camera/cube.h"
#include "plan/accuracy_choice.h"
#include "plan/baseline_of_frame.h"
#include "plan/effect_planner.h"
#include "plan/effects/calibrated_bounds.h"
#include "plan/exposure_plan.h"
#include "plan/path_template.h"
#include "plan/sky_of_frame.h"

namespace skylapse::plan {
namespace {

std::string clock_text(const astro::LocalTime& local) {
  const auto since_midnight =
      std::chrono::floor<std::chrono::seconds>(local.wall.time_since_epoch()) %
      std::chrono::days(1);
  const auto s = (since_midnight + std::chrono::days(1)) % std::chrono::days(1);
  return fmt::format("{:02}{:02}{:02}", s / std::chrono::hours(1),
                     s % std::chrono::hours(1) / std::chrono::minutes(1),
                     s % std::chrono::minutes(1) / std::chrono::seconds(1));
}

PathValues path_values(const config::JobConfig& job, const Frame& frame) {
  PathValues values;
  values.site = job.sites[frame.site].name;
  values.date = config::date_text(frame.date);
  values.time = clock_text(frame.local);
  values.camera = job.cameras[frame.camera].name;
  values.turbidity = fmt::format("{:.3g}", job.air.turbidity[frame.turbidity].value);
  values.albedo = job.air.ground_albedo[frame.albedo].value.name;
  const Angle sun =
      frame.asked_sun ? frame.asked_sun->elevation : elevation(frame.sky.sun_apparent);
  values.sun_elevation = fmt::format("{:+06.2f}", sun.in(deg) + 0.0);  // no -0
  if (frame.asked_sun) values.half = frame.asked_sun->rising ? "morning" : "afternoon";
  return values;
}

/// Fills in the paths of one output; '#' counts from 1 among the frames whose names differ in
/// nothing else.
void number_paths(Plan& plan, size_t output) {
  const std::string& pattern = config::path_of(plan.job.outputs[output]).value;
  std::unordered_map<std::string, long> counters;
  for (Frame& frame : plan.frames) {
    PathValues values = path_values(plan.job, frame);
    values.size = size_label(view_of(plan, frame, output).camera);
    const std::string path = expand_tokens(pattern, values);
    frame.paths[output] = expand_number(path, ++counters[path]);
  }
}

/// Two frames must not write one file, nor one of the program's own; a movie is one file for many
/// frames by intent.
std::optional<Error> find_collision(const Plan& plan) {
  std::unordered_map<std::string, std::pair<long, size_t>> writers;
  for (const Frame& frame : plan.frames)
    for (size_t o = 0; o < plan.job.outputs.size(); ++o) {
      const bool one_for_many = !config::is_per_frame(plan.job.outputs[o]);
      const SourceSpan& span = config::path_of(plan.job.outputs[o]).span;
      for (const std::string& file : files_of(plan, frame, o)) {
        if (config::is_reserved_path(file))
          return Error{ErrorCode::invalid_input,
                       fmt::format("frame {} would write '{}', which belongs to the program's own "
                                   "records",
                                   frame.index, file),
                       span, "rename the location or camera, or put it into a folder"};
        const auto [known, fresh] = writers.try_emplace(file, frame.index, o);
        if (fresh || (one_for_many && known->second.second == o)) continue;
        return Error{
            ErrorCode::invalid_input,
            known->second.first == frame.index
                ? fmt::format("two outputs of frame {} would both write '{}'", frame.index, file)
                : fmt::format("frames {} and {} would both write '{}'", known->second.first,
                              frame.index, file),
            span,
            "add ####, {site}, {date}, {time}, {camera}, {turbidity}, {albedo} or {size} to the "
            "name"};
      }
    }
  return {};
}

/// Sun and moon at each time, refracted as `model` has it.
std::vector<astro::SkyState> sky_states(const config::JobConfig& job, const Schedule& schedule,
                                        config::SkyModel model) {
  const astro::Ephemeris ephemeris({.algorithm = job.sky.sun_algorithm, .dut1 = job.time.dut1});
  std::vector<astro::SkyState> skies;
  skies.reserve(schedule.times.size());
  for (const ScheduledTime& time : schedule.times) {
    const config::Site& site = job.sites[time.site];
    skies.push_back(
        ephemeris.sky_state(time.instant, site.position, refraction_at(job, site, model)));
  }
  return skies;
}

/// The model, and the suns that go with it: only high sites, which rule Hosek-Wilkie out, have
/// another refraction in another model.
Result<std::vector<astro::SkyState>, Diagnostics> choose_model_and_suns(Plan& plan,
                                                                        const Schedule& schedule) {
  auto skies = sky_states(plan.job, schedule, plan.job.sky.model);
  if (plan.job.sky.accuracy || plan.job.sky.time_budget) {
    auto choice = choose_rung({plan.job, plan.air, schedule, skies});
    if (!choice) return Diagnostics{choice.error()};
    plan.job.sky = choice->sky;
    plan.model = choice->sky.model;
    plan.model_reason = fmt::format("{}: the way to keep sky.{}", choice->promise.taken.name,
                                    choice->promise.accuracy ? "accuracy" : "time_budget");
    plan.promise = std::move(choice->promise);
    return skies;
  }
  const ModelChoice choice = choose_model(plan.job, schedule, skies);
  plan.model = choice.model;
  plan.model_reason = name_of(choice.model) + ": " + choice.reason;
  return skies;
}

bool is_on(const Plan& plan, const Frame& frame, Effect effect) {
  const auto decision = decide_effect(plan, frame, effect);
  return decision && decision->on;
}

/// Leaves out refraction where it is not called for, and says how flat it would make the disc.
void refract(const Plan& plan, Frame& frame) {
  if (!is_on(plan, frame, Effect::refraction)) {
    frame.sky.sun_apparent = frame.sky.sun_true;
    frame.sky.moon_apparent = frame.sky.moon_true;
    return;
  }
  frame.sun_flattening =
      astro::flattening(elevation(frame.sky.sun_true), frame.sky.sun_radius,
                        refraction_at(plan.job, plan.job.sites[frame.site], plan.model));
}

/// What the model is asked for: `sky_at_horizon` is used by Hosek-Wilkie only.
void ask_model(const Plan& plan, Illuminance sky_at_horizon, Frame& frame) {
  const config::JobConfig& job = plan.job;
  refract(plan, frame);
  if (is_fitted(plan.model)) {
    frame.sun = sun_for_sky(frame.sky, job.air.refraction, sky_at_horizon);
    if (frame.sun.extrapolated && !is_on(plan, frame, Effect::twilight_continuation))
      frame.sun.twilight_level = 0;
    return;
  }
  frame.sun = sun_for_atmosphere(frame.sky);
  frame.camera_height = camera_height(job.sites[frame.site]);
  frame.horizon = horizon_elevation(frame.camera_height, job.air.description.planet_radius);
}

Status add_frames(Plan& plan, const Schedule& schedule, const std::vector<astro::SkyState>& skies) {
  const config::JobConfig& job = plan.job;
  int sequence = 0;
  size_t begin = 0;
  while (begin < schedule.times.size()) {
    size_t end = begin;
    while (end < schedule.times.size() && schedule.times[end].site == schedule.times[begin].site)
      ++end;
    for (size_t t = 0; t < job.air.turbidity.size(); ++t)
      for (size_t a = 0; a < job.air.ground_albedo.size(); ++a) {
        const auto at_horizon = is_fitted(plan.model) ? sky_at_horizon(job, int(t), int(a))
                                                      : Result<Illuminance>(Illuminance{});
        if (!at_horizon) return at_horizon.error();
        for (size_t c = 0; c < job.cameras.size(); ++c, ++sequence)
          for (size_t i = begin; i < end; ++i) {
            Frame frame;
            frame.index = long(plan.frames.size()) + 1;
            frame.site = schedule.times[i].site;
            frame.turbidity = int(t), frame.albedo = int(a), frame.camera = int(c);
            frame.sequence = sequence;
            frame.date = schedule.times[i].date;
            frame.instant = schedule.times[i].instant;
            frame.local = schedule.times[i].local;
            frame.asked_sun = schedule.times[i].asked_sun;
            frame.sky = skies[i];
            ask_model(plan, *at_horizon, frame);
            frame.paths.resize(job.outputs.size());
            plan.frames.push_back(std::move(frame));
          }
      }
    begin = end;
  }
  return Done{};
}

/// What decisions need of the cameras.
void look_through_cameras(Plan& plan) {
  for (const config::CameraConfig& camera : plan.job.cameras) {
    plan.sights.push_back(sight_of(plan.job, camera));
    plan.views.push_back(plan.sights.back().reach());
    plan.pixels.push_back(plan.sights.back().pixels());
  }
}

/// Decisions that shape the media of all frames, once sun and air are known.
void decide_for_the_job(Plan& plan) {
  plan.reach = reach_of(plan);
  if (is_fitted(plan.model) || plan.frames.empty()) return;
  const Frame& any = plan.frames.front();
  plan.air.ozone = is_on(plan, any, Effect::ozone);
  plan.air.aerosol = is_on(plan, any, Effect::aerosol);
  if (is_on(plan, any, Effect::full_spectrum)) plan.job.sky.wavelengths = kFullSpectrum;
}

/// Sites below the ground of a computed atmosphere are seen from it: said, not done in silence.
void note_low_sites(Plan& plan) {
  if (is_fitted(plan.model)) return;
  for (const config::Site& site : plan.job.sites)
    if (site.position.height < camera_height(site))
      plan.notes.push_back(
          fmt::format("site '{}' at {:g} m is seen from height 0, the ground of the atmosphere",
                      site.name, site.position.height.in(metre)));
}

/// Whether files of an output hold pixels of its view.
bool has_pixels(const config::Output& output) {
  if (const auto* product = std::get_if<config::ProductOutput>(&output))
    return product->view.has_value();
  return std::holds_alternative<config::ImageOutput>(output);
}

/// Levels that an output writes to files of their own; 0: it has none.
int levels_apart(const config::Output& output) {
  const auto* product = std::get_if<config::ProductOutput>(&output);
  const bool apart = product != nullptr && product->kind == config::ProductKind::specular &&
                     product->format != "ktx2";
  return apart ? product->levels : 0;
}

}  // namespace

Result<Plan, Diagnostics> make_plan(config::JobConfig job, const EffectRules& rules) {
  auto schedule = make_schedule(job);
  if (!schedule) return schedule.error();
  const size_t combinations =
      job.air.turbidity.size() * job.air.ground_albedo.size() * job.cameras.size();
  if (schedule->times.size() * combinations > size_t(config::kMaxJobFrames))
    return Diagnostics{
        {ErrorCode::invalid_input,
         fmt::format("this job has {} frames", schedule->times.size() * combinations),
         job.time.span, fmt::format("allowed: at most {}", config::kMaxJobFrames)}};
  Plan plan;
  plan.rules = &rules;
  plan.job = std::move(job);
  look_through_cameras(plan);
  plan.notes = std::move(schedule->notes);
  auto air = make_air_timeline(plan.job);
  if (!air) return air.error();
  plan.air = *std::move(air);
  const auto skies = choose_model_and_suns(plan, *schedule);
  if (!skies) return skies.error();
  note_low_sites(plan);
  const Status added = add_frames(plan, *schedule, *skies);
  if (!added) return Diagnostics{added.error()};
  const Status known = check_baseline(plan);
  if (!known) return Diagnostics{known.error()};
  decide_for_the_job(plan);
  for (size_t o = 0; o < plan.job.outputs.size(); ++o) number_paths(plan, o);
  if (auto collision = find_collision(plan)) return Diagnostics{*collision};
  const Status exposed = plan_exposure(plan);
  if (!exposed) return Diagnostics{exposed.error()};
  return plan;
}

const config::CameraConfig& view_of(const Plan& plan, const Frame& frame, size_t output) {
  const auto& frame_view = plan.job.cameras[frame.camera];
  if (const auto* image = std::get_if<config::ImageOutput>(&plan.job.outputs[output]))
    return image->own_view ? *image->own_view : frame_view;
  if (const auto* product = std::get_if<config::ProductOutput>(&plan.job.outputs[output]))
    return product->view ? *product->view : frame_view;
  return frame_view;
}

std::string size_label(const image::Camera& camera) {
  const int width = camera.width, height = camera.height;
  if (camera.projection == image::Projection::cube)
    return fmt::format("{}", image::cube_face_size(camera));
  if (width == 2 * height && width % 1024 == 0) return fmt::format("{}k", width / 1024);
  return width == height ? fmt::format("{}", width) : fmt::format("{}x{}", width, height);
}

std::vector<std::string> files_of(const Plan& plan, const Frame& frame, size_t output) {
  const config::Output& what = plan.job.outputs[output];
  const bool faces = has_pixels(what) && view_of(plan, frame, output).cube_faces_apart;
  const int levels = levels_apart(what);
  std::vector<std::string> files;
  for (int level = 0; level < std::max(1, levels); ++level) {
    PathValues values;
    if (levels > 0) values.level = fmt::format("{}", level);
    const std::string path = expand_tokens(frame.paths[output], values);
    if (!faces) {
      files.push_back(path);
      continue;
    }
    for (const std::string& face : face_names()) {
      values.face = face;
      files.push_back(expand_tokens(path, values));
    }
  }
  return files;
}

}  // namespace skylapse::plan
