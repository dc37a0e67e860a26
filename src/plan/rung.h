#pragma once
// The ladder: the ways of computing a sky among which a promise chooses, each with its error.
#include <optional>
#include <string>
#include <vector>

#include "config/job_config.h"
#include "plan/error_bounds.h"

namespace skylapse::plan {

struct Rung {
  config::SkyModel model = config::SkyModel::bruneton;
  sky::bruneton::Level level = sky::bruneton::Level::standard;  // of bruneton
  int wavelengths = 16;                                         // of computed atmospheres

  friend bool operator==(const Rung&, const Rung&) = default;
};

/// Hosek-Wilkie, single scattering, tables of the four levels, with 4 to 32 bands. In no order;
/// the reference, which reaches any error in the time that it takes, is not among them.
const std::vector<Rung>& ladder();

/// "hosek-wilkie", "single-scattering, 8 wavelengths", "bruneton low, 16 wavelengths".
std::string name_of(const Rung& rung);

/// A picture's scene: what errors depend on, and how its sky is shared out.
struct PictureScene {
  SceneFeatures features;
  PartShares shares{};
  bool known_air = true;  // else the bound is that of the nearest air that is, times kUnknownAir
};

/// Air or sun beyond those of the calibration: errors may be this much larger.
inline constexpr double kUnknownAir = 2;

/// What is added, as a square, to every bound: margins are of errors beyond this, which no picture
/// shows.
inline constexpr double kNegligibleError = 0.003;

/// Bound on the rms relative error of the picture's sky, 0 where it shows none; at most 1
/// for single scattering, which only leaves light out. Not for the reference.
double error_bound(const Rung& rung, const PictureScene& scene,
                   const ErrorTable& table = stored_errors());

/// Of the path tracer: rms relative standard error of a pixel made with one path, and seconds of
/// one core that a path takes.
struct PathOutlook {
  double deviation = 0, seconds = 0;
};
PathOutlook path_outlook(const PictureScene& scene, const ErrorTable& table = stored_errors());

/// Sets the keys of the sky that make the job one of this rung.
void take(const Rung& rung, config::Sky& sky);

}  // namespace skylapse::plan
