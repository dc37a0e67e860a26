#pragma once
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "plan/plan.h"

namespace skylapse::plan::testing {

/// A scene in one file; parts replace the defaults.
struct Scene {
  std::string location =
      "location: {name: Prague, latitude: 50.0755, longitude: 14.4378, height: 235 m}";
  std::string time =
      "time: {zone: Europe/Prague, date: 2026-06-21, from: 10:00, to: 12:00, step: 1 h}";
  std::string more;
  std::string camera =
      "camera: {projection: perspective, look_at: {azimuth: 180 deg, elevation: 20 deg}, fov: 90 "
      "deg, size: 64x36}";
  std::string outputs = "outputs: [{image: \"f.####.png\"}]";
};

inline std::string text_of(const Scene& scene) {
  return scene.location + "\n" + scene.time + "\n" + scene.more + "\n" + scene.camera + "\n" +
         scene.outputs + "\n";
}

inline config::JobConfig job_of(const Scene& scene) {
  auto job = config::parse_job(text_of(scene), "scene.yaml");
  if (!job) {
    for (const auto& error : job.error()) ADD_FAILURE() << format_error(error);
    throw std::runtime_error("the scene does not parse");
  }
  return *std::move(job);
}

inline Plan plan_of(const Scene& scene) {
  auto plan = make_plan(job_of(scene));
  if (!plan) {
    for (const auto& error : plan.error()) ADD_FAILURE() << format_error(error);
    throw std::runtime_error("the scene has no plan");
  }
  return *std::move(plan);
}

/// The errors of a scene that parses but cannot be planned.
inline Diagnostics plan_errors(const Scene& scene) {
  auto plan = make_plan(job_of(scene));
  EXPECT_FALSE(plan.ok());
  return plan ? Diagnostics{} : plan.error();
}

}  // namespace skylapse::plan::testing
