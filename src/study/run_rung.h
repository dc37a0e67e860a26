#pragma once
// Renders a rung through the product's own functions and measures it.
#include <filesystem>
#include <functional>

#include "gpu/context.h"
#include "output/image_writer.h"
#include "plan/plan.h"
#include "study/measurement.h"
#include "study/sky_sample.h"
#include "study/truth.h"

namespace skylapse::study {

/// A frame that is studied, with its truth.
struct StudyScene {
  std::string id;     // "noon"; "prague-0012" of a config's frame
  std::string title;  // "Noon, sun at 63 deg"
  std::function<Result<config::JobConfig, Diagnostics>(const std::vector<config::Override>&)> load;
  long frame = 1;  // number in the plan of the job with one camera
  // What prepare_scene adds:
  SkyGeometry geometry;
  Angle sun_elevation;
  Length height;
  std::string instant;  // UTC
  std::vector<SamplePoint> points;
  Truth truth;
  double exposure_ev = 0;
};

/// The plan of a rung for a scene: its job with the study's camera, one output, and all frames of
/// the job.
Result<plan::Plan, Diagnostics> plan_of_rung(const StudyScene& scene, const Rung& rung,
                                             const image::Camera& camera);

struct RunSettings {
  gpu::Backend backend = gpu::Backend::automatic;
  int frames = 3;  // rendered after the first, in each round
  /// Tables computed in the first round wait here for the later ones.
  std::filesystem::path tables;
  const output::DisplayTransform* display = nullptr;
};

/// The first round: tables computed, picture judged, first times. Never fails: a rung that the
/// product refuses is skipped with its reason.
Measurement measure_rung(const StudyScene& scene, const Rung& rung, const RunSettings& settings);

/// A later round: more times for a rung that was measured; its tables are read.
void repeat_rung(const StudyScene& scene, const RunSettings& settings, Measurement& measured);

}  // namespace skylapse::study
