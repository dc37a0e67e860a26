#pragma once
// Single numbers from the model, every input checked: for tables and comparisons, not for images.
#include <string>

#include "core/quantity.h"
#include "core/result.h"

namespace skylapse::sky::hosek_wilkie {

enum class ProbeKind {
  spectral,      // sky at `band` = wavelength in nm, 320..720 [W m^-2 sr^-1 nm^-1]
  xyz,           // XYZ fit, `band` = X, Y or Z [W m^-2 sr^-1]
  rgb,           // RGB fit, `band` = R, G or B [W m^-2 sr^-1]
  solar_direct,  // reference disc alone, radius 0.255 deg, as spectral; 0 outside the disc
  solar_total,   // disc and spectral sky together
};

struct ProbeQuery {
  ProbeKind kind = ProbeKind::spectral;
  double turbidity = 2.5;  // 1..10
  double albedo = 0;       // 0..1, the same in all bands
  Angle sun_elevation;     // 0..90 deg
  Angle view_zenith;       // 0..90 deg
  Angle gamma;             // view to sun, 0..180 deg
  std::string band;
};

/// Errors (invalid_input): anything outside the ranges above, NaN included, or an unknown band.
/// Negative radiances of the fit are returned as they are.
Result<double> probe(const ProbeQuery& query);

/// "spectral", "xyz", "rgb", "solar_direct", "solar_total"; an unknown name is an error.
Result<ProbeKind> probe_kind_from_name(const std::string& name);

}  // namespace skylapse::sky::hosek_wilkie
