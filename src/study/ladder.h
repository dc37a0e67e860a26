#pragma once
// The rungs of the ladder: ways to compute a sky, each as values of the config.
#include <functional>
#include <string>
#include <vector>

#include "config/job_config.h"

namespace skylapse::study {

/// What the rungs of a group have apart from each other; all else is the base: bruneton as a config
/// without further keys has it, with the sun by erfa.
struct Rung {
  std::string id;       // unique: "wavelengths-8"
  std::string group;    // "wavelengths"
  std::string label;    // "8 wavelengths"
  std::string setting;  // the keys, as a user writes them: "sky.wavelengths=8"
  std::vector<config::Override> overrides;
  bool quick = false;  // part of the quick study
  /// Too slow for the large picture: rendered in the small one, its time counted up by pixels.
  bool small_picture = false;
};

/// The id of the base.
inline constexpr const char* kBaseRung = "bruneton";

/// Groups in the order of a report, with what their rungs show.
struct RungGroup {
  std::string name, title, explanation;
  /// What the base is called among the group's rungs and how many of them come before it; empty
  /// where the rungs are no series.
  std::string base{};
  int before_base = 0;
};
const std::vector<RungGroup>& rung_groups();

/// All rungs, or those of the quick study; the base is among them.
std::vector<Rung> ladder(bool quick);

/// The rung's job: the scene's places, times, air and exposure, and a sky of the rung alone,
/// whatever the scene's own `sky` says. `load` reads the scene with overrides of keys outside
/// `sky`. Errors: those of the config; invalid_input where a fitted model would leave out what the
/// scene asks of the air.
Result<config::JobConfig, Diagnostics> job_of_rung(
    const Rung& rung, const std::function<Result<config::JobConfig, Diagnostics>(
                          const std::vector<config::Override>&)>& load);

}  // namespace skylapse::study
