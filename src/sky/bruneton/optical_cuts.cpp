#include "sky/bruneton/optical_cuts.h"

#include <algorithm>
#include <array>

namespace skylapse::sky::bruneton {
namespace {

/// Depths at which a thick ray is cut, and by how much the whole must exceed them.
constexpr std::array kDepths{0.5, 3.0, 12.0};
constexpr double kExcess = 4;

glm::dvec3 mean_extinction(const atmosphere::Medium& medium) {
  glm::dvec3 sum(0);
  for (const atmosphere::SpectralBand& band : medium.bands)
    sum += glm::dvec3(band.rayleigh_scattering_per_km, band.aerosol_extinction_per_km,
                      band.ozone_absorption_per_km);
  return sum / double(medium.bands.size());
}

/// Places and optical depths from the start, close enough to find a depth between two of them.
struct Profile {
  std::vector<double> distance{0}, depth{0};
};
Profile depth_profile(const Columns& columns, double h, double mu, double length, double lowest) {
  constexpr int kSteps = 40;
  Geometry geometry = columns.paths().geometry();
  const glm::dvec3 extinction = mean_extinction(columns.medium());
  text::Ray ray{};
  ray.height = h;
  ray.mu = mu;
  Profile profile;
  const auto walk = [&](double from, double to, bool rising) {
    for (int i = 1; i <= kSteps && to > from; ++i) {
      const double s = double(rising ? i : kSteps - i) / kSteps;
      const double away = (to - from) * s * s * s;
      const double t = rising ? from + away : to - away;
      const glm::dvec3 step = geometry.columns_between(ray, profile.distance.back(), t);
      profile.distance.push_back(t);
      profile.depth.push_back(profile.depth.back() + glm::dot(step, extinction));
    }
  };
  walk(0, lowest, false);
  walk(lowest, length, true);
  return profile;
}

}  // namespace

std::vector<double> march_cuts(const Columns& columns, double h, double mu, double length) {
  const double lowest = std::clamp(-(columns.medium().bottom_radius_km + h) * mu, 0.0, length);
  const Profile profile = depth_profile(columns, h, mu, length, lowest);
  std::vector<double> cuts;
  if (lowest > 0 && lowest < length) cuts.push_back(lowest);
  for (const double depth : kDepths) {
    if (profile.depth.back() < kExcess * depth) break;
    const size_t above =
        std::upper_bound(profile.depth.begin(), profile.depth.end(), depth) - profile.depth.begin();
    const double share =
        (depth - profile.depth[above - 1]) / (profile.depth[above] - profile.depth[above - 1]);
    cuts.push_back(profile.distance[above - 1] +
                   share * (profile.distance[above] - profile.distance[above - 1]));
  }
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

}  // namespace skylapse::sky::bruneton
