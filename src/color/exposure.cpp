#include "color/exposure.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace skylapse::color {
namespace {

constexpr double kIncidentMeterConstant = 250;    // C, lx s
constexpr double kReflectedMeterConstant = 12.5;  // K, cd s m^-2
constexpr double kDarkestMeteredLux = 1e-4;
constexpr double kDaylightLux = 1e5;
constexpr double kCompressionOfLightLoss = 0.86;
constexpr double kMiddleGrey = 0.18;
constexpr double kIso = 100;

}  // namespace

double metered_ev(Illuminance horizontal) {
  const double e = std::max(horizontal.in(lux), kDarkestMeteredLux);
  return std::log2(e * kIso / kIncidentMeterConstant);
}

double sun_curve_ev(Illuminance horizontal) {
  const double daylight = metered_ev(kDaylightLux * lux);
  return daylight + kCompressionOfLightLoss * (metered_ev(horizontal) - daylight);
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
