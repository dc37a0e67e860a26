#include "pipeline/manifest.h"

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>

#include "color/exposure.h"
#include "color/rgb_space.h"
#include "core/constants.h"
#include "core/version.h"
#include "image/camera/camera_words.h"
#include "image/orientation.h"
#include "output/atomic_file.h"
#include "output/sun_policy.h"
#include "pipeline/frame_source.h"
#include "pipeline/library/library_pass.h"
#include "pipeline/movie_pass.h"
#include "pipeline/output_view.h"
#include "pipeline/products/cube_texture.h"
#include "pipeline/promise_json.h"
#include "plan/effect_planner.h"

namespace skylapse::pipeline {
namespace {

using nlohmann::ordered_json;

ordered_json direction_json(const Direction<Enu>& apparent, const Direction<Enu>& airless) {
  return {{"azimuth_deg", azimuth(apparent).in(deg)},
          {"elevation_deg", elevation(apparent).in(deg)},
          {"true_elevation_deg", elevation(airless).in(deg)},
          {"east_north_up", {apparent.x(), apparent.y(), apparent.z()}}};
}

ordered_json entry_json(const LedgerEntry& entry) {
  ordered_json file{{"path", entry.path},
                    {"sha256", entry.sha256},
                    {"bytes", entry.bytes},
                    {"fingerprint", entry.fingerprint}};
  if (!entry.encoding.empty()) file["encoding"] = entry.encoding;
  ordered_json ms;
  for (int i = 0; i < kStageCount; ++i) ms[std::string(kStageNames[i])] = entry.times.ms[i];
  file["milliseconds"] = ms;
  return file;
}

ordered_json sites_json(const config::JobConfig& job) {
  auto sites = ordered_json::array();
  for (const config::Site& site : job.sites) {
    const auto& zone = site.zone ? site.zone : job.time.zone;
    sites.push_back({{"name", site.name},
                     {"latitude_deg", site.position.latitude.in(deg)},
                     {"longitude_deg", site.position.longitude.in(deg)},
                     {"height_m", site.position.height.in(metre)},
                     {"zone", zone ? zone->value : "UTC"}});
  }
  return sites;
}

ordered_json camera_json(const config::CameraConfig& camera) {
  const image::Look look = image::look_of(camera.camera.camera_to_enu);
  ordered_json out{{"name", camera.name},
                   {"projection", name_of(camera.camera.projection)},
                   {"width", camera.camera.width},
                   {"height", camera.camera.height},
                   {"field_of_view_deg", camera.camera.field_of_view.in(deg)},
                   {"azimuth_deg", look.azimuth.in(deg)},
                   {"elevation_deg", look.elevation.in(deg)},
                   {"roll_deg", look.roll.in(deg)}};
  if (camera.camera.projection == image::Projection::cube)
    out["layout"] =
        camera.cube_faces_apart ? image::kFacesApart : name_of(camera.camera.cube_layout);
  return out;
}

ordered_json cameras_json(const config::JobConfig& job) {
  auto cameras = ordered_json::array();
  for (const config::CameraConfig& camera : job.cameras) cameras.push_back(camera_json(camera));
  return cameras;
}

constexpr std::array kTypes{"u8", "u16", "half", "float"};

ordered_json output_json(const config::ImageOutput& image) {
  ordered_json o{{"image", image.path.value},
                 {"format", image.format},
                 {"type", kTypes[size_t(image.sample_type)]}};
  if (image.content == config::ImageContent::standard_error) o["content"] = "standard-error";
  if (image.content == config::ImageContent::sky) o["content"] = "sky";
  if (image.own_view) {
    config::CameraConfig view = *image.own_view;
    view.camera = oriented(view.camera, image.orientation);
    o["camera"] = camera_json(view);
    if (image.format == "ktx2") o["camera"].erase("layout");  // it holds six images
  }
  if (image.orientation) o["orientation"] = std::string(name_of(*image.orientation));
  const bool displayed = image.display || image.view;
  if (!displayed && (image.sample_type == output::SampleType::half_float || image.format == "hdr"))
    o["sun"] = output::sun_policy_name(image.sun_policy);
  if (image.display) o["display"] = *image.display;
  if (image.view) o["view"] = *image.view;
  o["scene_linear"] = !displayed;
  return o;
}

ordered_json output_json(const config::MovieOutput& movie) {
  ordered_json o{{"movie", movie.path.value}, {"fps", movie.frames_per_second}, {"crf", movie.crf}};
  if (movie.display) o["display"] = *movie.display;
  if (movie.view) o["view"] = *movie.view;
  return o;
}

ordered_json output_json(const config::ProductOutput& product) {
  constexpr std::array kKinds{"specular", "irradiance", "harmonics", "sun", "dome"};
  ordered_json o{{kKinds[size_t(product.kind)], product.path.value}, {"format", product.format}};
  if (product.view) {
    o["type"] = kTypes[size_t(product.sample_type)];
    config::CameraConfig view = *product.view;
    view.camera = product_camera(product);
    o["camera"] = camera_json(view);
    if (product.format == "ktx2") o["camera"].erase("layout");
  }
  if (product.kind == config::ProductKind::specular) o["levels"] = product.levels;
  if (product.kind == config::ProductKind::dome) o["map"] = product.map_path.value;
  o["orientation"] = std::string(name_of(product.orientation));
  return o;
}

ordered_json output_json(const config::LibraryOutput& library) {
  constexpr std::array kKinds{"gallery", "sheet"};
  return {{kKinds[size_t(library.kind)], library.path.value}, {"image", library.image_path.value}};
}

ordered_json outputs_json(const config::JobConfig& job) {
  auto outputs = ordered_json::array();
  for (const config::Output& output : job.outputs)
    outputs.push_back(std::visit([](const auto& o) { return output_json(o); }, output));
  return outputs;
}

ordered_json color_json(const config::JobConfig& job) {
  ordered_json color{{"space", job.color.space}, {"white_luminance_cd_m2", kLuminousEfficacy}};
  if (const auto space = color::rgb_space_from_name(job.color.space))
    color["chromaticities"] = color::exr_chromaticities(*space);
  return color;
}

ordered_json exposure_json(double ev) {
  return {{"ev100", ev},
          {"exposure_time_s", color::exposure_time_at_f8(ev).in(second)},
          {"aperture", 8},
          {"iso", 100}};
}

/// The finished files of a frame with the light they were made with.
struct FrameFiles {
  ordered_json files = ordered_json::array();
  std::map<std::string, double> light, noise;
  bool complete = true;
};

FrameFiles files_of_frame(const JobContext& job, const plan::Frame& frame) {
  FrameFiles found;
  for (size_t o = 0; o < job.plan.job.outputs.size(); ++o) {
    if (!config::is_per_frame(job.plan.job.outputs[o])) continue;
    const auto paths = plan::files_of(job.plan, frame, o);
    const std::string print =
        job.ledger.knows(paths.front()) ? job.fingerprint(frame, o) : std::string();
    for (const auto& path : paths) {
      const auto entry = job.ledger.find(path, print);
      found.complete = found.complete && entry;
      if (!entry) continue;
      found.files.push_back(entry_json(*entry));
      found.light = entry->light;
      found.noise = entry->noise;
    }
  }
  return found;
}

ordered_json frame_json(const JobContext& job, const plan::Frame& frame, const FrameFiles& found) {
  const config::JobConfig& config = job.plan.job;
  ordered_json sun = direction_json(frame.sky.sun_apparent, frame.sky.sun_true);
  sun["distance_au"] = frame.sky.sun_distance.in(astronomical_unit);
  sun["radius_deg"] = frame.sky.sun_radius.in(deg);
  ordered_json moon = direction_json(frame.sky.moon_apparent, frame.sky.moon_true);
  moon["illuminated_fraction"] = frame.sky.moon_illuminated_fraction;
  auto effects = ordered_json::array();
  for (const auto& decision : plan::decide_effects(job.plan, frame))
    if (decision.on) effects.push_back(name_of(decision.effect));
  ordered_json out = {{"frame", frame.index},
                      {"site", config.sites[frame.site].name},
                      {"camera", config.cameras[frame.camera].name},
                      {"utc", format_utc(frame.instant, 3)},
                      {"local", format_local(frame.local)},
                      {"sun", sun},
                      {"moon", moon},
                      {"exposure", exposure_json(frame.ev)},
                      {"model", plan::name_of(job.plan.model)},
                      {"extrapolated", frame.sun.extrapolated},
                      {"turbidity", config.air.turbidity[frame.turbidity].value},
                      {"ground_albedo", config.air.ground_albedo[frame.albedo].value.name},
                      {"effects", effects},
                      {"light", found.light},
                      {"complete", found.complete},
                      {"files", found.files}};
  if (!found.noise.empty()) out["noise"] = found.noise;
  return out;
}

/// What computed the atmosphere. A run that kept all its frames has not asked for it: then what the
/// run before wrote stands.
ordered_json computed_by_json(const JobContext& job) {
  const auto record = job.atmospheres.record();
  if (!record) {
    std::ifstream file(job.options.output / "manifest.json");
    const auto before = ordered_json::parse(file, nullptr, false);
    const ordered_json::json_pointer place("/atmosphere/computed_by");
    if (before.is_discarded() || !before.is_object() || !before.contains(place)) return nullptr;
    return before.at(place);
  }
  auto attempts = ordered_json::array();
  for (const gpu::Attempt& attempt : record->context.attempts)
    if (!attempt.reason.empty())
      attempts.push_back({{"backend", attempt.what}, {"reason", attempt.reason}});
  auto tables = ordered_json::array();
  for (const AtmosphereRecord::Tables& t : record->tables)
    tables.push_back({{"id", t.id},
                      {"cached", t.cached},
                      {"seconds", t.seconds},
                      {"orders", t.orders},
                      {"bytes", t.bytes}});
  return {{"backend", record->context.backend},
          {"vendor", record->context.vendor},
          {"renderer", record->context.renderer},
          {"version", record->context.version},
          {"passed_over", attempts},
          {"tables", tables}};
}

/// Nothing for the fitted models that run without GL.
ordered_json atmosphere_json(const JobContext& job) {
  if (plan::is_fitted(job.plan.model) && job.plan.model != config::SkyModel::hosek_wilkie_gl)
    return nullptr;
  if (plan::is_fitted(job.plan.model)) return {{"computed_by", computed_by_json(job)}};
  const config::Sky& sky = job.plan.job.sky;
  if (job.plan.model == config::SkyModel::reference)
    return {{"wavelengths", sky.wavelengths},
            {"samples", sky.paths.samples},
            {"relative_error", sky.paths.relative_error ? ordered_json(*sky.paths.relative_error)
                                                        : ordered_json(nullptr)},
            {"seed", sky.paths.seed},
            {"orders", sky.orders}};
  // 0 and null: the model's own choice.
  constexpr std::array kPrecisions{"half", "float", "double"};
  return {{"level", sky::bruneton::name_of(sky.level)},
          {"wavelengths", sky.wavelengths},
          {"orders", sky.orders},
          {"steps", sky.steps},
          {"slice", sky.slice_azimuths > 0 ? ordered_json{sky.slice_azimuths, sky.slice_zeniths}
                                           : ordered_json(nullptr)},
          {"precision", kPrecisions[size_t(sky.precision)]},
          {"computed_by", computed_by_json(job)}};
}

/// Everything but the frames.
ordered_json head_json(const JobContext& job) {
  const config::JobConfig& config = job.plan.job;
  auto movies = ordered_json::array();
  for (const Movie& movie : movies_of(job.plan))
    if (job.ledger.knows(movie.path))
      if (const auto entry = job.ledger.find(movie.path, fingerprint_of(job, movie)))
        movies.push_back(entry_json(*entry));
  auto library = ordered_json::array();
  for (const LedgerEntry& entry : library_entries(job)) library.push_back(entry_json(entry));
  return {{"program", "skylapse"},
          {"version", kVersion},
          {"source_hash", kSourceHash},
          {"config", config.file},
          {"title", config.title},
          {"sites", sites_json(config)},
          {"cameras", cameras_json(config)},
          {"outputs", outputs_json(config)},
          {"color", color_json(config)},
          {"model", plan::name_of(job.plan.model)},
          {"model_reason", job.plan.model_reason},
          {"promise", promise_json(job.plan)},
          {"atmosphere", atmosphere_json(job)},
          {"notes", job.plan.notes},
          {"movies", movies},
          {"library", library},
          {"frames_total", job.plan.frames.size()}};
}

/// One frame a line, written as it is made: a long job's manifest is larger than its plan.
void stream_manifest(const JobContext& job, std::ostream& out) {
  std::string head = head_json(job).dump(1, ' ', false, ordered_json::error_handler_t::replace);
  head.erase(head.find_last_of('}'));
  head.erase(head.find_last_not_of(" \n") + 1);
  out << head << ",\n \"frames\": [";
  size_t complete = 0;
  bool first = true;
  for (const plan::Frame& frame : job.plan.frames) {
    const FrameFiles found = files_of_frame(job, frame);
    complete += found.complete ? 1 : 0;
    if (found.files.empty() && !found.complete) continue;  // nothing to tell yet
    out << (first ? "\n  " : ",\n  ")
        << frame_json(job, frame, found)
               .dump(-1, ' ', false, ordered_json::error_handler_t::replace);
    first = false;
  }
  out << "\n ],\n \"frames_complete\": " << complete
      << ",\n \"complete\": " << (complete == job.plan.frames.size() ? "true" : "false") << "\n}\n";
}

}  // namespace

Status write_manifest(const JobContext& job) {
  const auto lock = FolderLock::take(job.options.output);
  if (!lock) return lock.error();
  const Status refreshed = job.ledger.refresh();
  if (!refreshed) return refreshed;
  const std::filesystem::path file = job.options.output / "manifest.json";
  const std::filesystem::path temporary = output::temporary_beside(file);
  errno = 0;
  std::ofstream out(temporary, std::ios::binary);
  stream_manifest(job, out);
  out.close();
  if (out) return output::publish(temporary, file);
  const int reason = errno != 0 ? errno : EIO;
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  return output::write_error(file, reason);
}

}  // namespace skylapse::pipeline
