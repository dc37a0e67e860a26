#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/parallel.h"
#include "sky/bruneton/rays.h"
#include "sky/bruneton/twin.h"
#include "sky/bruneton/twin_march.h"

namespace skylapse::sky::bruneton {
namespace {

/// Directions above the horizontal plane with their projected solid angles. They gather at the
/// sun, or at the horizon below which it is: the aureole may be a degree wide.
struct Sample {
  double zenith_rad, azimuth_rad, weight;
};

std::vector<Sample> hemisphere(double sun_zenith) {
  constexpr int kZeniths = 20, kAzimuths = 28;
  const double edge = text::PI / 2, focus = std::min(sun_zenith, edge);
  std::vector<Sample> samples;
  for (const double end : {0.0, edge}) {
    const double width = std::abs(end - focus);
    for (const glm::dvec2& z : gauss_nodes(kZeniths)) {
      const double zenith = focus + (end - focus) * z.x * z.x;
      const double ring = 2 * z.x * z.y * width * std::sin(zenith) * std::cos(zenith);
      if (width <= 0) continue;
      for (const glm::dvec2& a : gauss_nodes(kAzimuths))
        samples.push_back({zenith, text::PI * a.x * a.x, ring * 2 * text::PI * 2 * a.x * a.y});
    }
  }
  return samples;
}

}  // namespace

Twin::Irradiance Twin::irradiance(Length height, Angle sun_zenith) const {
  const double h = height.in(km), mu_s = cos(sun_zenith);
  assert(std::isfinite(h) && h >= 0);
  const size_t count = medium().bands.size();
  const std::vector<Sample> samples = hemisphere(std::abs(sun_zenith.in(rad)));
  std::vector<std::vector<double>> light(samples.size());
  parallel_for_ranges(samples.size(), 16, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      light[i] =
          answer({height, sun_zenith, samples[i].zenith_rad * rad, samples[i].azimuth_rad * rad})
              .radiance;
  });
  Irradiance result{std::vector<double>(count, 0.0), std::vector<double>(count, 0.0)};
  for (size_t i = 0; i < samples.size(); ++i)
    for (size_t b = 0; b < count; ++b) result.sky[b] += light[i][b] * samples[i].weight;

  Geometry text(*data_);
  const double cosine = text.sun_mean_cosine(mu_s);
  if (cosine <= 0) return result;
  const glm::dvec3 to_sun = columns_to_sun(*columns_, h, mu_s);
  for (size_t b = 0; b < count; ++b)
    result.sun[b] = medium().bands[b].solar_irradiance * cosine *
                    std::exp(-text.optical_depth(data_->groups[b / 4], to_sun)[int(b % 4)]);
  return result;
}

}  // namespace skylapse::sky::bruneton
