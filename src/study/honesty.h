#pragma once
// Are the promises of sky.accuracy kept? Random scenes that no calibration has seen, planned and
// rendered as a user's job would be, against the path tracer.
#include <optional>
#include <string>

#include "core/result.h"
#include "gpu/context.h"
#include "study/accuracy_scene.h"

namespace skylapse::study {

/// A job with a promise: one frame, one camera.
struct HonestyJob {
  AccuracyScene scene;
  double accuracy = 0.02;
  std::string config;  // YAML
};

/// Scene `index` of the seed, a camera (map, fisheye, perspective of 30 to 100 deg) and a promise
/// between 1 and 30 %, uniform in its logarithm. Half of the skies have nothing that rules
/// Hosek-Wilkie out but sun, haze and height.
HonestyJob draw_honesty_job(uint64_t seed, int index);

struct HonestyResult {
  std::string taken;                      // rung
  std::string refused;                    // why no promise was made; nothing else is set then
  double bound = 0;                       // predicted error
  double measured = 0;                    // rms of the picture's sky, noise of the truth taken off
  double uncertainty = 0;                 // standard error of `measured`
  double predicted_s = 0;                 // core seconds of the frame: the planner's,
  double measured_s = 0;                  // and the clock's, of the sky alone with its tables
  double best_predicted_s = 0;            // the same of the best rung
  std::optional<double> best_measured_s;  // where it was asked for
};

struct HonestyOptions {
  int pixels = 24;            // that are traced
  long most_paths = 400'000;  // for each of them
  bool time_best = false;
  gpu::Backend backend = gpu::Backend::automatic;
};

/// Plans the job, renders its sky by the pipeline and measures it at pixels drawn by their solid
/// angle, those within 2.5 pixels of the horizon apart, which are means. Errors: those of the
/// pipeline.
Result<HonestyResult> measure_honesty(const HonestyJob& job, uint64_t seed,
                                      const HonestyOptions& options = {});

}  // namespace skylapse::study
