#pragma once
// What the sky of a frame truly is, in the directions of a study: light scattered once by
// quadrature in double, all further orders by tracing paths (sky/monte_carlo), in more bands of
// wavelength than any model that is judged. Nothing of it comes out of a table.
#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "core/result.h"
#include "plan/plan.h"
#include "study/sky_error.h"

namespace skylapse::study {

struct TruthSettings {
  int wavelengths = 32;
  /// Paths are added until the standard error of a direction's XYZ is this share of it ...
  double noise = 0.005;
  long most_paths = 400'000;  // ... or so many are traced
  uint64_t seed = 1;
};

struct Truth {
  std::vector<TrueRadiance> radiance;   // one a direction, at the sun's distance
  glm::dvec3 sky_irradiance_xyz{0};     // horizontal, without the disc
  glm::dvec3 sky_irradiance_error{0};   // its standard error
  glm::dvec3 sun_normal_irradiance{0};  // XYZ of the disc, on a surface that faces it
  long paths = 0;                       // traced in all
  double seconds = 0;                   // of all cores; as it was when they were traced
  bool from_cache = false;
};

/// `plan` and `frame` give air, height and sun; only the air, the site, the time and the ground of
/// the plan's job matter, not its model. Errors: those of the medium; `interrupted` once
/// `stop_signal` is not 0. `progress`: told the share that is done.
/// With `cache_folder`, a truth of the same medium, directions, settings and program is read from
/// there, and a new one is kept there.
Result<Truth> truth_of(const plan::Plan& plan, const plan::Frame& frame,
                       const std::vector<Direction<Enu>>& directions, const TruthSettings& settings,
                       const std::optional<std::filesystem::path>& cache_folder = {},
                       const std::atomic<int>* stop_signal = nullptr,
                       const std::function<void(double)>& progress = {});

}  // namespace skylapse::study
