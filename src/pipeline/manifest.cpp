#include "pipeline/manifest.h"

#include <nlohmann/json.hpp>

#include "core/constants.h"
#include "core/version.h"
#include "output/atomic_file.h"
#include "pipeline/movie_pass.h"
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

ordered_json effects_json(const JobContext& job, const plan::Frame& frame) {
  auto effects = ordered_json::array();
  for (const auto& decision : plan::decide_effects(job.plan.job, frame))
    if (decision.on) effects.push_back(name_of(decision.effect));
  return effects;
}

/// The finished files of a frame; `complete` becomes false if one is missing.
ordered_json files_json(const JobContext& job, const plan::Frame& frame, bool& complete) {
  auto files = ordered_json::array();
  for (size_t o = 0; o < job.plan.job.outputs.size(); ++o) {
    if (!std::holds_alternative<config::ImageOutput>(job.plan.job.outputs[o])) continue;
    const std::string print = job.fingerprint(frame, o);
    for (const auto& path : plan::files_of(job.plan, frame, o)) {
      if (const auto entry = job.ledger.find(path, print))
        files.push_back(entry_json(*entry));
      else
        complete = false;
    }
  }
  return files;
}

ordered_json frame_json(const JobContext& job, const plan::Frame& frame) {
  const config::JobConfig& config = job.plan.job;
  ordered_json sun = direction_json(frame.sky.sun_apparent, frame.sky.sun_true);
  sun["distance_au"] = frame.sky.sun_distance.in(astronomical_unit);
  sun["radius_deg"] = frame.sky.sun_radius.in(deg);
  ordered_json moon = direction_json(frame.sky.moon_apparent, frame.sky.moon_true);
  moon["illuminated_fraction"] = frame.sky.moon_illuminated_fraction;
  bool complete = true;
  ordered_json files = files_json(job, frame, complete);
  return {{"frame", frame.index},
          {"site", config.sites[frame.site].name},
          {"camera", config.cameras[frame.camera].name},
          {"utc", format_utc(frame.instant, 3)},
          {"local", format_local(frame.local)},
          {"sun", sun},
          {"moon", moon},
          {"exposure_ev100", frame.ev},
          {"model", "hosek-wilkie"},
          {"extrapolated", frame.sun.extrapolated},
          {"turbidity", config.air.turbidity[frame.turbidity].value},
          {"ground_albedo", config.air.ground_albedo[frame.albedo].value.name},
          {"effects", effects_json(job, frame)},
          {"complete", complete},
          {"files", files}};
}

}  // namespace

Status write_manifest(const JobContext& job) {
  const auto lock = FolderLock::take(job.options.output);
  if (!lock) return lock.error();
  const Status refreshed = job.ledger.refresh();
  if (!refreshed) return refreshed;
  auto frames = ordered_json::array();
  long done = 0;
  for (const plan::Frame& frame : job.plan.frames) {
    frames.push_back(frame_json(job, frame));
    done += frames.back()["complete"].get<bool>() ? 1 : 0;
  }
  auto movies = ordered_json::array();
  for (const Movie& movie : movies_of(job.plan))
    if (const auto entry = job.ledger.find(movie.path, fingerprint_of(job, movie)))
      movies.push_back(entry_json(*entry));
  const ordered_json manifest{{"program", "skylapse"},
                              {"version", kVersion},
                              {"source_hash", kSourceHash},
                              {"config", job.plan.job.file},
                              {"title", job.plan.job.title},
                              {"color_space", job.plan.job.color.space},
                              {"white_luminance_cd_m2", kLuminousEfficacy},
                              {"model_reason", job.plan.model_reason},
                              {"notes", job.plan.notes},
                              {"frames_total", job.plan.frames.size()},
                              {"frames_complete", done},
                              {"complete", done == long(job.plan.frames.size())},
                              {"movies", movies},
                              {"frames", frames}};
  const std::string text = manifest.dump(1) + "\n";
  return output::write_file_atomically(job.options.output / "manifest.json",
                                       std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace skylapse::pipeline
