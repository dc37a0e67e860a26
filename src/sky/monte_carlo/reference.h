#pragma once
// The ground truth: a spectral Monte Carlo path tracer in double, free of tables, that judges every
// other model of the same medium. Regular tracking (distances by quadrature through the shells),
// sunlight gathered at each event, every collision forced where only air gives light, the first one
// drawn where it matters; Russian roulette, so no order is cut off.
#include <cstdint>
#include <optional>
#include <vector>

#include "sky/atmosphere/medium.h"
#include "sky/bruneton/query.h"
#include "sky/monte_carlo/optics.h"

namespace skylapse::sky::monte_carlo {

struct ReferenceOptions {
  long samples = 100000;  // paths; with relative_error: at most
  /// Stop once the standard error of every band's radiance is below this share of the radiance.
  std::optional<double> relative_error = {};
  uint64_t seed = 1;
  /// Least and greatest number of scattering events and ground bounces together; 0: no greatest.
  /// min_order 2 leaves out what the sun lights directly, air and ground alike: light that can be
  /// integrated exactly, so that the two together have less noise than all orders by paths.
  int min_order = 1, max_order = 0;
  bool ground = false;  // add what the ground at the end of the view ray reflects
  SunVisibility sun = SunVisibility::smooth_step;
  AerosolShape aerosol = AerosolShape::cornette_shanks;
};

/// Per band of the medium [W m^-2 sr^-1 nm^-1], at 1 au, with the standard error of the mean; of
/// the orders min_order to max_order.
/// radiance, transmittance and sun_transmittance are as in bruneton::Answer.
struct ReferenceAnswer {
  std::vector<double> radiance, standard_error;
  std::vector<double> order1, order1_error;
  std::vector<double> up_to_order4, up_to_order4_error;
  std::vector<double> transmittance, sun_transmittance;
  long samples = 0;  // paths that were traced

  [[nodiscard]] bruneton::Answer answer() const {
    return {radiance, transmittance, sun_transmittance};
  }
};

/// Deterministic for one machine: the same numbers on any number of threads. All cores.
/// Domain: a medium that passes check(), height >= 0 (asserted). Observers above the air see it
/// from outside; rays that miss it have radiance 0 and transmittance 1.
ReferenceAnswer reference_answer(const atmosphere::Medium& medium, const bruneton::Query& query,
                                 const ReferenceOptions& options = {});

/// Horizontal irradiance per band [W m^-2 nm^-1] from the upper half of the sky, 1 au.
struct ReferenceIrradiance {
  std::vector<double> sun;  // the disc, exactly
  std::vector<double> sky, sky_error;
  long samples = 0;
};
/// Domain: 0 <= height <= top of the air (asserted).
ReferenceIrradiance reference_irradiance(const atmosphere::Medium& medium, Length height,
                                         Angle sun_zenith, const ReferenceOptions& options = {});

}  // namespace skylapse::sky::monte_carlo
