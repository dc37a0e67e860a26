#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <string>

#include "core/sha256.h"
#include "output/atomic_file.h"
#include "pipeline/run_job.h"
#include "support/temporary_folder.h"

namespace skylapse::pipeline::testing {

inline plan::Plan plan_of_text(const std::string& text) {
  auto job = config::parse_job(text, "scene.yaml");
  if (!job)
    for (const auto& error : job.error()) ADD_FAILURE() << format_error(error);
  auto plan = plan::make_plan(*std::move(job));
  if (!plan)
    for (const auto& error : plan.error()) ADD_FAILURE() << format_error(error);
  return *std::move(plan);
}

/// Six small frames from before sunrise into the day, by the model that needs no GL unless `more`
/// has a sky of its own; `outputs` in YAML flow style.
inline std::string small_scene(const std::string& outputs, std::string more = "") {
  if (more.find("sky:") == std::string::npos) more += "\nsky: {model: hosek-wilkie}";
  return "location: {name: Prague, latitude: 50.0755, longitude: 14.4378, height: 235 m}\n"
         "time: {zone: Europe/Prague, date: 2026-06-21, from: sunrise - 20 min, to: sunrise + 30 "
         "min, "
         "step: 10 min}\n"
         "camera: {projection: perspective, look_at: {azimuth: 60 deg, elevation: 10 deg}, "
         "fov: 80 deg, size: 96x54}\n" +
         more + "\noutputs: [" + outputs + "]\n";
}

inline RunOptions options_for(const plan::Plan& plan, const std::filesystem::path& folder) {
  RunOptions options;
  options.output = folder;
  options.frames.resize(plan.frames.size());
  std::iota(options.frames.begin(), options.frames.end(), 1L);
  return options;
}

/// Hash of each visible file but the manifest, which carries times.
inline std::map<std::string, std::string> hashes(const std::filesystem::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = std::filesystem::relative(entry.path(), folder).string();
    if (!entry.is_regular_file() || name.starts_with(".skylapse") || name == "manifest.json")
      continue;
    all[name] = sha256_hex(*output::read_file(entry.path()));
  }
  return all;
}

}  // namespace skylapse::pipeline::testing
