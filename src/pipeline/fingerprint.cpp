#include "pipeline/fingerprint.h"

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/sha256.h"
#include "core/version.h"
#include "output/atomic_file.h"
#include "pipeline/output_view.h"
#include "plan/effect_planner.h"
#include "plan/table_settings.h"

namespace skylapse::pipeline {
namespace {

using nlohmann::json;

json site_json(const config::Site& site) {
  return {{"lat", site.position.latitude.in(deg)},
          {"lon", site.position.longitude.in(deg)},
          {"height", site.position.height.in(metre)},
          {"name", site.name}};
}

json air_json(const config::JobConfig& job, const plan::Frame& frame) {
  const auto& refraction = job.air.refraction;
  const auto& albedo = job.air.ground_albedo[frame.albedo].value;
  return {{"turbidity", job.air.turbidity[frame.turbidity].value},
          {"albedo", albedo.spectral ? json(albedo.name) : json(albedo.value)},
          {"refraction", refraction.enabled},
          {"pressure", refraction.pressure.in(hPa)},
          {"temperature", refraction.temperature.in(degC)}};
}

/// What a model depends on, and no other.
json model_json(const plan::Plan& plan, const plan::Frame& frame) {
  using enum config::SkyModel;
  const config::Sky& sky = plan.job.sky;
  switch (plan.model) {
    case preetham:
      return json::object();
    case cie:
      return {{"type", sky.cie_type}};
    case automatic:
    case hosek_wilkie:
    case hosek_wilkie_gl:
      return {{"fit", int(sky.fit)}, {"flux", int(sky.solar_flux)}};
    case single_scattering:
    case bruneton:
    case reference:
      break;
  }
  // A medium that is refused has no text, and no picture either.
  const auto medium = plan::medium_of_frame(plan.job, plan.air, frame);
  json all{{"wavelengths", sky.wavelengths},
           {"orders", sky.orders},
           {"medium", medium ? canonical_text(*medium) : ""}};
  if (plan.model == reference) {
    all["samples"] = sky.paths.samples;
    all["relative_error"] = sky.paths.relative_error.value_or(0);
    all["seed"] = sky.paths.seed;
    return all;
  }
  all["level"] = sky::bruneton::name_of(sky.level);
  all["steps"] = sky.steps;
  all["slice"] = {sky.slice_azimuths, sky.slice_zeniths};
  all["precision"] = int(sky.precision);
  // Which suns the tables hold is decided for the whole job.
  const sky::EffectSet effects = plan::effects_of(plan, frame);
  const auto media = plan::tables_of_frame(plan.job, plan.air, frame);
  if (media && plan::reads_tables(plan, effects))
    all["tables"] = canonical_text(plan::table_settings(plan, *media, effects));
  return all;
}

/// Those that are on; what chose them shows nowhere else.
json effects_json(const plan::Plan& plan, const plan::Frame& frame) {
  const sky::EffectSet effects = plan::effects_of(plan, frame);
  json on = json::array();
  for (const auto& [name, effect] : sky::kEffectNames)
    if (effects.has(effect)) on.push_back(std::string(name));
  return on;
}

json sky_json(const plan::Plan& plan, const plan::Frame& frame) {
  const config::Sky& sky = plan.job.sky;
  return {{"model", plan::name_of(plan.model)},
          {"settings", model_json(plan, frame)},
          {"effects", effects_json(plan, frame)},
          {"disc", sky.sun_disc},
          {"sun_algorithm", name_of(sky.sun_algorithm)}};
}

json camera_json(const config::CameraConfig& config) {
  const image::Camera& camera = config.camera;
  json axes = json::array();
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) axes.push_back(camera.camera_to_enu[c][r]);
  return {{"projection", int(camera.projection)},
          {"width", camera.width},
          {"height", camera.height},
          {"fov", camera.field_of_view.in(rad)},
          {"layout", int(camera.cube_layout)},
          {"faces_apart", config.cube_faces_apart},
          {"axes", axes}};
}

json frame_json(const plan::Plan& plan, const plan::Frame& frame) {
  return {{"source", kSourceHash},
          {"site", site_json(plan.job.sites[frame.site])},
          {"utc", format_utc(frame.instant, 6)},
          {"utc_offset", frame.local.utc_offset.count()},
          {"dut1", plan.job.time.dut1.in(second)},
          {"air", air_json(plan.job, frame)},
          {"sky", sky_json(plan, frame)},
          {"camera", camera_json(plan.job.cameras[frame.camera])},
          {"space", plan.job.color.space},
          {"ev", frame.ev}};
}

}  // namespace

std::string scene_fingerprint(const plan::Plan& plan, const plan::Frame& frame) {
  return sha256_hex(frame_json(plan, frame).dump());
}

std::string image_fingerprint(const plan::Plan& plan, const plan::Frame& frame,
                              const config::ImageOutput& output, const std::string& color_config) {
  json all = frame_json(plan, frame);
  all["index"] = frame.index;
  all["view_camera"] = camera_json(view_of_output(plan, frame, output).camera);
  if (output.orientation) all["orientation"] = int(*output.orientation);
  all["format"] = output.format;
  all["content"] = int(output.content);
  all["sample"] = int(output.sample_type);
  all["sun_policy"] = int(output.sun_policy);
  all["quality"] = output.quality;
  all["compression"] = output.compression;
  if (output.display || output.view) {
    all["display"] = output.display.value_or("");
    all["view"] = output.view.value_or("");
    all["color_config"] = color_config;
  }
  return sha256_hex(all.dump());
}

/// A dome names its map relative to itself, and stands as the map is laid out, scaled, and without
/// the disc or with it.
static json map_json(const plan::Plan& plan, const plan::Frame& frame,
                     const config::ProductOutput& dome) {
  json all{{"path", dome.path.value}};
  for (size_t o = 0; o < plan.job.outputs.size(); ++o)
    if (const auto* image = std::get_if<config::ImageOutput>(&plan.job.outputs[o]);
        image != nullptr && image->path.value == dome.map_path.value) {
      all["files"] = plan::files_of(plan, frame, o);
      all["settings"] = image_fingerprint(plan, frame, *image, "");
    }
  return all;
}

std::string product_fingerprint(const plan::Plan& plan, const plan::Frame& frame,
                                const config::ProductOutput& output) {
  json all = frame_json(plan, frame);
  all["index"] = frame.index;
  all["product"] = int(output.kind);
  all["format"] = output.format;
  all["sample"] = int(output.sample_type);
  if (output.view) all["view_camera"] = camera_json(*output.view);
  all["levels"] = output.levels;
  all["orientation"] = int(output.orientation);
  all["with_disc"] = output.sun_disc;
  if (output.kind == config::ProductKind::dome) all["map"] = map_json(plan, frame, output);
  return sha256_hex(all.dump());
}

std::string movie_fingerprint(const config::MovieOutput& output,
                              const std::vector<std::string>& frame_fingerprints) {
  const json all = {{"fps", output.frames_per_second},
                    {"crf", output.crf},
                    {"path", output.path.value},
                    {"frames", frame_fingerprints}};
  return sha256_hex(all.dump());
}

std::string color_config_file(const config::JobConfig& job) {
  if (job.color.ocio) return job.color.ocio->value;
  const char* from_environment = std::getenv("OCIO");
  return from_environment ? from_environment : "";
}

Result<std::string> color_config_hash(const config::JobConfig& job) {
  const std::string file = color_config_file(job);
  if (file.empty()) return std::string("built-in");
  auto bytes = output::read_file(file);
  if (bytes) return sha256_hex(*bytes);
  Error error = bytes.error();
  if (job.color.ocio) error.span = job.color.ocio->span;
  return error;
}

}  // namespace skylapse::pipeline
