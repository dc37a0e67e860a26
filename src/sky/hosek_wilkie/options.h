#pragma once

namespace skylapse::sky::hosek_wilkie {

/// The three published fits; each stands for itself, none is a conversion of another.
enum class Fit { spectral, xyz, rgb };

/// Flux of the solar disc (2013). The published limb darkening is 1 at the disc's centre, so the
/// model as published carries 70-85 % of the direct sunlight it was given.
enum class SolarFlux {
  reference,   // as published
  conserving,  // divided by the disc mean of the limb darkening
};

}  // namespace skylapse::sky::hosek_wilkie
