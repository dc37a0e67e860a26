#pragma once
// Twins that several tests ask.
#include <memory>

#include "sky/bruneton/twin.h"

namespace skylapse::sky::bruneton {

/// The twin of a medium at a level; `single` leaves out multiple scattering.
inline Twin make_twin(const atmosphere::Medium& medium, Level level = Level::draft) {
  return Twin(std::make_shared<const Tables>(precompute_twin(medium, settings_for(level, medium))));
}

inline Twin single_scattering_twin(const atmosphere::Medium& medium) {
  auto tables = std::make_shared<Tables>();
  tables->medium = medium;
  return Twin(tables);
}

/// The reference medium at 550 nm alone, with Y of weight 1.
inline atmosphere::Medium green_medium() {
  atmosphere::Medium medium = atmosphere::reference_medium();
  medium.bands = {medium.bands[1]};
  medium.bands[0].xyz_weight = {0, 1, 0};
  return medium;
}

/// One that absorbs nothing, over a ground of this albedo.
inline atmosphere::Medium conservative_medium(double albedo) {
  atmosphere::Medium medium = green_medium();
  medium.bands[0].ozone_absorption_per_km = 0;
  medium.bands[0].aerosol_scattering_per_km = medium.bands[0].aerosol_extinction_per_km;
  medium.bands[0].ground_albedo = albedo;
  return medium;
}

}  // namespace skylapse::sky::bruneton
