#include "pipeline/disc_of_frame.h"

#include <algorithm>

namespace skylapse::pipeline {

/// Transmittance over the disc's elevations above the horizon, in steps far below those in which it
/// changes: on the horizon it falls by a factor of e in about a degree.
std::optional<sky::AtmosphereDisc> disc_of_frame(
    const sky::atmosphere::Medium& medium, const plan::Frame& frame,
    const std::function<std::vector<double>(Angle zenith)>& transmittance) {
  constexpr int kSteps = 32;
  const Angle centre = elevation(frame.sun.direction), radius = frame.sky.sun_radius;
  if (centre + radius <= frame.horizon) return {};
  const Angle lowest = std::max(frame.horizon, centre - radius);
  const Angle step = std::max((centre + radius - lowest) / kSteps, 1e-9 * rad);
  std::vector<std::vector<double>> values;
  for (int i = 0; i <= kSteps; ++i)
    values.push_back(transmittance(90 * deg - (lowest + double(i) * step)));
  return sky::AtmosphereDisc(medium, radius, lowest, step, values);
}

}  // namespace skylapse::pipeline
