#pragma once
// The studies of docs/atmosphere.md, one function each; they print what they find.
#include <memory>

#include "sky/bruneton/twin.h"

namespace skylapse::sky::bruneton {

/// Levels against converged tables and against the truth files: errors, CPU time, size.
void study_accuracy();
/// 200 directions while the sun moves from +10 to -18 degrees in steps of 0.02.
void study_twilight(Level level);
/// Horizontal illuminance of a clear atmosphere against the published table.
void study_illuminance(Level level);
/// What the bilinear lookup of a slice costs, by size, height and sun.
void study_slices();
/// Whether light is made or lost.
void study_energy(Level level);
/// Random draws over the whole domain: nothing but finite, non-negative light.
void study_draws(long long count);

inline Twin twin_of(const atmosphere::Medium& medium, const Settings& settings) {
  return Twin(std::make_shared<const Tables>(precompute_twin(medium, settings)));
}

}  // namespace skylapse::sky::bruneton
