#include "sky/bruneton/settings.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "sky/bruneton/directions.h"
#include "sky/bruneton/harmonics.h"
#include "sky/bruneton/layers.h"
#include "sky/bruneton/sun_rows.h"

namespace skylapse::sky::bruneton {
namespace {

constexpr int kGreatestDegree = 40;  // what g 0.95 is cut at
constexpr double kThick = 0.4;       // vertical optical depth by scattering of the aerosol
constexpr int kHazeSamples = 12;     // 6 are up to 16 % off at visibility 2 km

}  // namespace

const std::vector<std::string>& level_names() {
  static const std::vector<std::string> kNames{"draft", "low", "standard", "fine"};
  return kNames;
}

std::string name_of(Level level) { return level_names()[size_t(level)]; }

namespace {

Settings sizes_of(Level level) {
  Settings s;
  switch (level) {
    case Level::draft:
      s.heights = 12, s.suns = 20, s.sun_rows_per_interval = 4;
      s.directions_up = 10, s.directions_down = 4, s.azimuths = 8, s.harmonics = 8;
      s.table_azimuths = 8, s.table_zeniths = 16;
      break;
    case Level::low:
      s.heights = 16, s.suns = 28;
      s.directions_up = 12, s.directions_down = 6, s.azimuths = 10, s.harmonics = 10;
      s.table_azimuths = 10, s.table_zeniths = 20;
      break;
    case Level::standard:
      break;
    case Level::fine:
      s.heights = 28, s.suns = 44;
      s.directions_up = 20, s.directions_down = 8, s.azimuths = 16, s.harmonics = 14;
      s.table_azimuths = 16, s.table_zeniths = 32;
      s.stop_below = 0.01;
      break;
  }
  return s;
}

/// What the rules look at: the worst of all bands.
struct Difficulty {
  double aerosol_depth = 0;  // vertical, by scattering
  double aerosol_share = 0;  // of the scattering where the aerosol is densest
  double albedo = 0;
  bool aerosol = false;  // scatters at all
};

Difficulty difficulty_of(const atmosphere::Medium& medium) {
  const double H = medium.top_height_km;
  const double aerosol_column = medium.aerosol.vertical_column_km(H);
  Difficulty worst;
  for (const atmosphere::SpectralBand& band : medium.bands) {
    worst.albedo = std::max(worst.albedo, band.ground_albedo);
    worst.aerosol |= band.aerosol_scattering_per_km > 0;
    worst.aerosol_depth =
        std::max(worst.aerosol_depth, band.aerosol_scattering_per_km * aerosol_column);
    constexpr int kSteps = 64;
    for (int i = 0; i < kSteps; ++i) {
      const double h = H * std::pow(double(i) / kSteps, kHeightExponent);
      const double air = band.rayleigh_scattering_per_km * medium.rayleigh.at(h);
      const double aerosol = band.aerosol_scattering_per_km * medium.aerosol.at(h);
      // A layer too thin to matter may be all aerosol.
      if (aerosol * H > 0.01)
        worst.aerosol_share = std::max(worst.aerosol_share, aerosol / (air + aerosol));
    }
  }
  return worst;
}

/// The least degree past which the mixture's phase function has no moment above `tolerance`.
int degree_needed(double g, double share, double tolerance) {
  const std::vector<double> moments = aerosol_moments(g, kGreatestDegree + 1);
  int degree = kGreatestDegree;
  while (degree > 2 && share * std::abs(moments[degree]) < tolerance) --degree;
  return degree;
}

/// The reference medium ends at 7.55 mean heights of its scattering air.
double height_growth(const atmosphere::Medium& medium) {
  const double reach = medium.top_height_km / scattering_top_km(medium);
  return std::min(std::pow(reach, 1 / kHeightExponent), 1.5);
}

double moment_tolerance(Level level) {
  switch (level) {
    case Level::draft:
      return 0.13;
    case Level::low:
      return 0.09;
    case Level::standard:
      return 0.06;
    case Level::fine:
      return 0.035;
  }
  return 0.06;
}

}  // namespace

Settings settings_for(Level level, const atmosphere::Medium& medium) {
  Settings s = sizes_of(level);
  const Difficulty difficulty = difficulty_of(medium);
  // 0 clear .. 1 thick: at visibility 9 km it is nearly 1.
  const double haze = std::clamp((difficulty.aerosol_depth - 0.1) / 0.4, 0.0, 1.0);
  const bool thick = difficulty.aerosol_depth > kThick;

  const int degree = degree_needed(medium.aerosol_g, difficulty.aerosol_share,
                                   moment_tolerance(level) * (1 - 0.5 * haze));
  // Air alone scatters by a polynomial of degree 2: no more is needed, and it is exact.
  if (!difficulty.aerosol) s.harmonics = 2;
  if (degree > s.harmonics) {
    const double growth = double(degree) / s.harmonics;
    s.harmonics = degree;
    s.azimuths = std::max(s.azimuths, degree);
    s.table_azimuths = std::max(s.table_azimuths, degree);
    s.table_zeniths = std::max(s.table_zeniths, 2 * degree);
    s.directions_up =
        std::max(s.directions_up, int(std::lround(s.directions_up * std::sqrt(growth))));
    s.directions_down =
        std::max(s.directions_down, int(std::lround(s.directions_down * std::sqrt(growth))));
  }
  // The nodes of a high top are spread over the heights that scatter as those of a low one.
  s.heights = int(std::lround(s.heights * height_growth(medium)));
  if (thick) s.heights = int(std::lround(1.6 * s.heights));
  s.heights += layer_nodes(medium);
  s.samples += int(std::lround(haze * (kHazeSamples - s.samples)));
  if (thick || difficulty.albedo > 0.5) s.stop_below = std::min(s.stop_below, 0.01);
  return s;
}

std::string canonical_text(const Settings& s) {
  std::ostringstream out;
  out << std::hexfloat << s.heights << ' ' << s.suns << ' ' << s.sun_rows_per_interval << ' '
      << s.directions_up << ' ' << s.directions_down << ' ' << s.azimuths << ' ' << s.harmonics
      << ' ' << s.table_azimuths << ' ' << s.table_zeniths << ' ' << s.samples << ' '
      << s.first_order_samples << ' ' << s.max_orders << ' ' << s.stop_below << ' ' << s.first_sun
      << ' ' << s.warp_suns() << ' ' << s.orders;
  return out.str();
}

}  // namespace skylapse::sky::bruneton
