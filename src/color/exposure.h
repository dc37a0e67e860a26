#pragma once
// Exposure in EV at ISO 100, planned before anything is rendered.
#include <string>
#include <vector>

#include "core/quantity.h"

namespace skylapse::color {

enum class ExposureMode { fixed, sun_curve, metered };

struct ExposureSettings {
  ExposureMode mode = ExposureMode::sun_curve;
  double ev = 15.0;           // EV100 in mode fixed
  double compensation = 0.0;  // stops; positive is brighter
  double rate_limit = 0.5;    // metered: greatest change in stops per minute
};

/// EV100 that an incident-light meter with C = 250 lx s reads (ISO 2720:1974):
/// log2(E / 2.5 lx). Illuminances below 1e-4 lx count as 1e-4 lx.
double metered_ev(Illuminance horizontal);

/// The `sun_curve` mode: full daylight (above 100 klx) is exposed as metered, and each stop of
/// light lost is answered by 0.86 stops of exposure, so that dusk looks darker than noon by about
/// a stop and a night by three, with no step anywhere the illuminance has none.
double sun_curve_ev(Illuminance horizontal);

/// A value of a metered sequence: seconds since the sequence's start, and the meter's EV.
struct MeteredFrame {
  Duration time;
  double ev = 0;
};

/// Follows the meter from frame to frame, never faster than `rate_limit` stops per minute; times
/// must not decrease. The first frame is as metered.
std::vector<double> follow_meter(const std::vector<MeteredFrame>& frames, double rate_limit);

/// Factor from luminance to the scene-linear display value: middle grey (0.18) is the luminance
/// K/100 2^EV of a reflected-light meter with K = 12.5 cd s m^-2 (ISO 2720:1974).
double exposure_scale_per_cd_m2(double ev);

/// Exposure time in seconds that stands for `ev` at ISO 100 and f/8, for image metadata.
Duration exposure_time_at_f8(double ev);

}  // namespace skylapse::color
