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

/// EV100 that a reflected-light meter with K = 12.5 cd s m^-2 reads (ISO 2720:1974) on a surface of
/// this luminance: log2(100 L / K). Below 1e-5 cd/m^2 counts as that.
double metered_ev(Luminance luminance);

/// The `sun_curve` mode, for the mean luminance of a clear sky. Daylight is exposed 0.6 stops above
/// the meter, and each stop of light lost is answered by 0.86 stops of exposure, so that dusk looks
/// darker than noon by about a stop and night by three, with no step where the light has none.
double sun_curve_ev(Luminance clear_sky);

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
