#include "sky/bruneton/optical_cuts.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace skylapse::sky::bruneton {
namespace {

/// Depths at which a thick ray is cut, and by how much the whole must exceed them.
constexpr std::array kDepths{0.5, 3.0, 12.0};
constexpr double kExcess = 4;

/// Whether a density jumps at h, or bends there by more than 10 % a kilometre (those of the
/// standard air's pieces bend by 3 %).
bool has_corner(const atmosphere::DensityProfile& profile, double h) {
  constexpr double kStep = 1e-3;  // km
  const double below = profile.at(h - kStep), above = profile.at(h + kStep);
  const double density = std::max(below, above);
  const double slope_below = (below - profile.at(h - 2 * kStep)) / kStep;
  const double slope_above = (profile.at(h + 2 * kStep) - above) / kStep;
  return std::abs(above - below) > 0.01 * density ||
         std::abs(slope_above - slope_below) > 0.1 * density;
}

/// Distances in (0, length), ascending, at which the ray passes the edges and the peak of a layer
/// that scatters: no Gauss rule sees a veil of 10 km in a piece of 1000 km.
std::vector<double> layer_cuts(const Columns& columns, double h, double mu, double length) {
  const atmosphere::Medium& medium = columns.medium();
  const double R = medium.bottom_radius_km, b = (R + h) * mu;
  std::vector<double> cuts;
  for (const atmosphere::DensityProfile* profile : {&medium.rayleigh, &medium.aerosol})
    for (const double level : profile->breaks_km(medium.top_height_km)) {
      const double d = b * b + (level - h) * (2 * R + level + h);
      if (d <= 0 || !has_corner(*profile, level)) continue;
      for (const double t : {-b - std::sqrt(d), -b + std::sqrt(d)})
        if (t > 0 && t < length) cuts.push_back(t);
    }
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

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
  // The far ones are left out where there are too many: a ray this deep hides them, or nearly.
  const std::vector<double> layers = layer_cuts(columns, h, mu, length);
  const size_t fitting = std::min(layers.size(), size_t(text::MAX_CUTS) - cuts.size());
  cuts.insert(cuts.end(), layers.begin(), layers.begin() + fitting);
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

}  // namespace skylapse::sky::bruneton
