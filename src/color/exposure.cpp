#include "color/exposure.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace skylapse::color {
namespace {

constexpr double kReflectedMeterConstant = 12.5;  // K, cd s m^-2
constexpr double kDarkestMetered = 1e-5;          // cd/m^2
constexpr double kDaylightSky = 5000;             // cd/m^2, mean of a clear sky around noon
constexpr double kDaylightBias = 0.6;             // stops brighter than the meter
constexpr double kCompressionOfLightLoss = 0.86;
constexpr double kMiddleGrey = 0.18;
constexpr double kIso = 100;

}  // namespace

double metered_ev(Luminance luminance) {
  const double l = std::max(luminance.in(cd_per_m2), kDarkestMetered);
  return std::log2(l * kIso / kReflectedMeterConstant);
}

double sun_curve_ev(Luminance clear_sky) {
  const double daylight = metered_ev(kDaylightSky * cd_per_m2);
  return daylight - kDaylightBias + kCompressionOfLightLoss * (metered_ev(clear_sky) - daylight);
}

std::vector<double> follow_meter(const std::vector<MeteredFrame>& frames, double rate_limit) {
  std::vector<double> evs;
  evs.reserve(frames.size());
  for (size_t i = 0; i < frames.size(); ++i) {
    if (i == 0) {
      evs.push_back(frames[i].ev);
      continue;
    }
    const double minutes = (frames[i].time - frames[i - 1].time).in(minute);
    assert(minutes >= 0);
    const double reach = rate_limit * minutes;
    evs.push_back(std::clamp(frames[i].ev, evs.back() - reach, evs.back() + reach));
  }
  return evs;
}

double exposure_scale_per_cd_m2(double ev) {
  return kMiddleGrey * kIso / (kReflectedMeterConstant * std::exp2(ev));
}

Duration exposure_time_at_f8(double ev) {
  constexpr double kFNumber = 8;
  return kFNumber * kFNumber / std::exp2(ev) * second;
}

}  // namespace skylapse::color
