#include "study/run_rung.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include "color/exposure.h"
#include "color/rgb_space.h"
#include "core/constants.h"
#include "pipeline/render_frame.h"
#include "study/delta_e.h"
#include "study/machine.h"

namespace skylapse::study {
namespace {

namespace fs = std::filesystem;
using pipeline::AtmosphereService;
using pipeline::Stage;
using pipeline::StageTimes;
using sky::bruneton::TableCache;

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

std::string text_of(const Diagnostics& errors) {
  std::string text = errors.empty() ? "refused" : errors.front().message;
  if (!errors.empty() && !errors.front().hint.empty()) text += " (" + errors.front().hint + ")";
  return text;
}

/// Pixels of the large picture for each one that is rendered.
double pixel_factor(const Rung& rung) {
  return rung.small_picture ? kSmallMapFactor * kSmallMapFactor : 1;
}

image::Camera camera_of(const StudyScene& scene, const Rung& rung) {
  return rung.small_picture ? small_study_camera(scene.geometry.sun)
                            : study_camera(scene.geometry.sun);
}

/// Core time of this process [ms].
double core_milliseconds() { return 1000.0 * double(std::clock()) / CLOCKS_PER_SEC; }

/// `core_ms` of a frame is divided as its time on the clock is.
void add_times(const StageTimes& times, double core_ms, const Rung& rung, Timing& timing) {
  const double once = times[Stage::atmosphere], pixels = times[Stage::sky] + times[Stage::disc];
  timing.once_ms.push_back(once);
  timing.pixels_ms.push_back(pixels * pixel_factor(rung));
  const double share = once + pixels > 0 ? pixels / (once + pixels) : 0;
  timing.core_ms.push_back(core_ms * (1 + share * (pixel_factor(rung) - 1)));
}

/// Display-encoded sRGB of scene-linear light.
std::vector<glm::dvec3> displayed(const std::vector<glm::dvec3>& xyz, const glm::dmat3& xyz_to_rgb,
                                  double ev, const output::DisplayTransform& display) {
  const double scale = color::exposure_scale_per_cd_m2(ev) * kLuminousEfficacy;
  std::vector<float> values;
  for (const glm::dvec3& v : xyz) {
    const glm::dvec3 rgb = xyz_to_rgb * v * scale;
    for (int c = 0; c < 3; ++c) values.push_back(float(rgb[c]));
  }
  display.apply(values.data(), xyz.size());
  std::vector<glm::dvec3> out;
  for (size_t i = 0; i < xyz.size(); ++i)
    out.emplace_back(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  return out;
}

PerceptualMeasure perceptual(const std::vector<SkyDirection>& directions,
                             const std::vector<glm::dvec3>& shown,
                             const std::vector<glm::dvec3>& truth) {
  std::vector<std::pair<double, double>> differences;
  PerceptualMeasure m;
  double weight = 0;
  for (size_t i = 0; i < shown.size(); ++i) {
    const double w = directions[i].solid_angle.in(sr);
    const double difference = ciede2000(lab_of_srgb(shown[i]), lab_of_srgb(truth[i]));
    differences.emplace_back(difference, w);
    weight += w, m.mean += w * difference, m.max = std::max(m.max, difference);
  }
  if (weight > 0) m.mean /= weight;
  m.p95 = weighted_quantile(std::move(differences), 0.95);
  return m;
}

/// Compares a picture with the truth of its scene.
void judge(const StudyScene& scene, const plan::Plan& plan, const plan::Frame& frame,
           const pipeline::RenderedFrame& rendered, const output::DisplayTransform* display,
           Measurement& out) {
  const MapSize size = out.rung.small_picture ? MapSize::small : MapSize::large;
  const auto space = *color::rgb_space_from_name(plan.job.color.space);
  std::vector<SamplePoint> points;
  std::vector<TrueRadiance> truth;
  for (size_t i = 0; i < scene.points.size(); ++i) {
    if (size == MapSize::small && scene.points[i].small_x < 0) continue;
    points.push_back(scene.points[i]);
    truth.insert(truth.end(), 2, scene.truth.radiance[i]);
  }
  const auto directions = directions_of(points, scene.geometry, size);
  const auto xyz = pixels_of(points, *rendered.scene_without_disc, size, color::rgb_to_xyz(space));
  out.errors = sky_errors(directions, xyz, truth, scene.geometry);
  out.irradiance = relative_error(rendered.sky_irradiance_xyz, scene.truth.sky_irradiance_xyz);
  if (glm::length(scene.truth.sun_normal_irradiance) > 0)
    out.disc =
        relative_error(rendered.sun_normal_irradiance_xyz, scene.truth.sun_normal_irradiance);
  out.sun_arcsec = separation(frame.sky.sun_apparent, scene.geometry.sun).in(arcsec);
  out.ev = frame.ev;
  if (display == nullptr) return;
  std::vector<glm::dvec3> true_xyz;
  for (const TrueRadiance& t : truth) true_xyz.push_back(t.xyz);
  const glm::dmat3& to_rgb = color::xyz_to_rgb(space);
  out.delta_e = perceptual(directions, displayed(xyz, to_rgb, frame.ev, *display),
                           displayed(true_xyz, to_rgb, scene.exposure_ev, *display));
}

/// Renders `count` further frames; their times are kept.
Status render_more(const plan::Plan& plan, const plan::Frame& frame, AtmosphereService& service,
                   int count, Measurement& out) {
  for (int i = 0; i < count; ++i) {
    StageTimes times;
    const double before = core_milliseconds();
    const auto again = render_frame(plan, frame, service, false, times);
    if (!again) return again.error();
    add_times(times, core_milliseconds() - before, out.rung, out.timing);
  }
  return Done{};
}

/// Moves the files of a folder into another one, over what is there.
void move_files(const fs::path& from, const fs::path& to) {
  std::error_code ignored;
  fs::create_directories(to, ignored);
  for (const auto& entry : fs::directory_iterator(from, ignored))
    fs::rename(entry.path(), to / entry.path().filename(), ignored);
  fs::remove_all(from, ignored);
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    const double place = share * double(values.size() - 1);
    const auto i = std::min(size_t(place), values.size() - 1);
    const size_t next = std::min(i + 1, values.size() - 1);
    return values[i] + (place - double(i)) * (values[next] - values[i]);
  };
  return {at(0.5), at(0.25), at(0.75), int(values.size())};
}

Spread Timing::frame() const {
  std::vector<double> sums;
  for (size_t i = 0; i < once_ms.size(); ++i) sums.push_back(once_ms[i] + pixels_ms[i]);
  return spread_of(std::move(sums));
}

double Timing::pixel_share() const {
  const double once = spread_of(once_ms).median, pixels = spread_of(pixels_ms).median;
  return once + pixels > 0 ? pixels / (once + pixels) : 0;
}

Result<plan::Plan, Diagnostics> plan_of_rung(const StudyScene& scene, const Rung& rung,
                                             const image::Camera& camera) {
  auto job = job_of_rung(rung, scene.load);
  if (!job) return job.error();
  config::CameraConfig one;
  one.camera = camera;
  job->cameras = {one};
  config::ImageOutput output;
  output.path.value = "study.########.exr", output.format = "exr";
  job->outputs = {output};
  return plan::make_plan(*std::move(job));
}

Measurement measure_rung(const StudyScene& scene, const Rung& rung, const RunSettings& settings) {
  Measurement out;
  out.rung = rung;
  const auto plan = plan_of_rung(scene, rung, camera_of(scene, rung));
  if (!plan) return out.skipped = text_of(plan.error()), out;
  const plan::Frame& frame = plan->frames[size_t(scene.frame - 1)];
  const fs::path fresh = settings.tables / "fresh";
  std::error_code ignored;
  fs::remove_all(fresh, ignored);

  const MemoryRise memory;
  const auto start = std::chrono::steady_clock::now();
  const double core_start = core_milliseconds();
  AtmosphereService service(*plan, settings.backend, {}, TableCache(fresh));
  StageTimes times;
  auto rendered = render_frame(*plan, frame, service, true, times);
  if (!rendered) return out.skipped = rendered.error().message, out;
  // A small picture's pixels are counted up; what comes before them is not.
  const double pixels = times[Stage::sky] + times[Stage::disc];
  out.timing.first_ms = milliseconds_since(start) + pixels * (pixel_factor(rung) - 1);
  out.timing.first_core_ms = core_milliseconds() - core_start;
  out.memory.peak_rise = memory.bytes();
  if (const auto record = service.record()) {
    out.renderer = record->context.renderer;
    for (const auto& tables : record->tables) {
      out.timing.tables_ms += tables.seconds * 1000;
      out.memory.table_bytes += tables.bytes;
    }
  }
  judge(scene, *plan, frame, *rendered, settings.display, out);
  const Status more = render_more(*plan, frame, service, settings.frames, out);
  if (!more) return out.skipped = more.error().message, out;
  if (!rung.small_picture) out.picture = std::move(*rendered->scene_without_disc);
  move_files(fresh, settings.tables);
  return out;
}

void repeat_rung(const StudyScene& scene, const RunSettings& settings, Measurement& measured) {
  const auto plan = plan_of_rung(scene, measured.rung, camera_of(scene, measured.rung));
  if (!plan) return;
  const plan::Frame& frame = plan->frames[size_t(scene.frame - 1)];
  AtmosphereService service(*plan, settings.backend, {}, TableCache(settings.tables));
  StageTimes warm_up;
  if (!render_frame(*plan, frame, service, false, warm_up)) return;
  const Status done = render_more(*plan, frame, service, settings.frames, measured);
  static_cast<void>(done);  // what was measured before stays
}

}  // namespace skylapse::study
