#include "sky/bruneton/physics.h"

#include <algorithm>
#include <cmath>

#include "sky/bruneton/directions.h"
#include "sky/bruneton/sun_rows.h"

namespace skylapse::sky::bruneton {
namespace {

using text::PI;

double set_pieces(text::AirParameters& air, int first, const atmosphere::DensityProfile& profile) {
  const int count = std::min<int>(int(profile.terms.size()), text::MAX_DENSITY_TERMS);
  for (int i = 0; i < count; ++i) {
    const atmosphere::DensityTerm& term = profile.terms[i];
    air.pieces[first + i] = {term.bottom_km,
                             term.top_km,
                             term.amplitude,
                             term.inverse_scale_height_per_km,
                             term.slope_per_km,
                             term.constant,
                             0,
                             0};
  }
  return count;
}

/// Whether any band has more than none of something.
bool any_band(const atmosphere::Medium& medium, double atmosphere::SpectralBand::*coefficient) {
  return std::any_of(medium.bands.begin(), medium.bands.end(),
                     [&](const atmosphere::SpectralBand& band) { return band.*coefficient > 0; });
}

/// The profiles of what is there: densities of what neither scatters nor absorbs are not computed.
void set_densities(text::AirParameters& air, const atmosphere::Medium& medium) {
  using Band = atmosphere::SpectralBand;
  if (any_band(medium, &Band::rayleigh_scattering_per_km))
    air.rayleigh_terms = set_pieces(air, 0, medium.rayleigh);
  if (any_band(medium, &Band::aerosol_scattering_per_km) ||
      any_band(medium, &Band::aerosol_extinction_per_km))
    air.aerosol_terms = set_pieces(air, text::MAX_DENSITY_TERMS, medium.aerosol);
  if (any_band(medium, &Band::ozone_absorption_per_km))
    air.ozone_terms = set_pieces(air, 2 * text::MAX_DENSITY_TERMS, medium.ozone);
}

void set_phase(text::AirParameters& air, const atmosphere::Medium& medium) {
  // Bucholtz 1995, Eqs. 10-12: gamma = rho / (2 - rho).
  const double gamma = medium.rayleigh_depolarization / (2 - medium.rayleigh_depolarization);
  const double norm = 3 / (16 * PI * (1 + 2 * gamma));
  air.rayleigh_constant = norm * (1 + 3 * gamma);
  air.rayleigh_quadratic = norm * (1 - gamma);
  air.aerosol_g = medium.aerosol_g;
  air.aerosol_norm = aerosol_phase_norm(medium.aerosol_g);
}

void set_table_coordinates(text::AirParameters& air, const atmosphere::Medium& medium,
                           const Settings& settings) {
  const SunNodes suns = sun_nodes(medium, settings);
  air.sun_centre = suns.warp.centre_rad;
  air.sun_width = suns.warp.width_rad;
  air.sun_first = suns.warp.first() - suns.first_share * suns.warp.span();
  air.sun_row_last = settings.sun_rows() - 1;
  air.sun_rows_per_unit = settings.sun_rows_per_interval / (suns.share_step * suns.warp.span());
  air.height_last = settings.heights - 1;
  air.zenith_last = settings.table_zeniths - 1;
  air.azimuth_last = settings.table_azimuths - 1;
  air.height_power = 1 / kHeightExponent;
  air.columns_height_last = kColumnHeights - 1;
  air.columns_distance_last = kColumnDistances - 1;
}

void set_layers(text::AirParameters& air, const atmosphere::Medium& medium,
                const Settings& settings) {
  for (const Layer& layer : layers_aloft(medium)) {
    const auto is = [&](Component component) { return layer.component == component ? 1.0 : 0.0; };
    air.layers[int(air.layer_count)] = {
        layer.bottom_km,         layer.top_km,           layer.slope_per_km,   layer.constant,
        is(Component::rayleigh), is(Component::aerosol), is(Component::ozone), 0};
    ++air.layer_count;
  }
  const std::vector<HeightKnot> knots = height_knots(medium, settings);
  air.knot_count = double(knots.size()) - 1;
  for (size_t i = 0; i + 1 < knots.size(); ++i)
    air.knots[i] = {knots[i].share, double(knots[i].node),
                    (knots[i + 1].node - knots[i].node) / (knots[i + 1].share - knots[i].share), 0};
}

}  // namespace

text::AirParameters air_parameters(const atmosphere::Medium& medium, const Settings& settings) {
  text::AirParameters air{};
  const double H = medium.top_height_km;
  air.bottom_radius = medium.bottom_radius_km;
  air.top_height = H;
  air.sun_angular_radius = medium.sun_angular_radius_rad;
  air.horizon_length = std::sqrt(H * (2 * medium.bottom_radius_km + H));
  set_phase(air, medium);
  set_table_coordinates(air, medium, settings);
  set_densities(air, medium);
  set_layers(air, medium, settings);
  return air;
}

std::vector<text::BandGroup> band_groups(const atmosphere::Medium& medium) {
  std::vector<text::BandGroup> groups((medium.bands.size() + 3) / 4);
  for (size_t i = 0; i < 4 * groups.size(); ++i) {
    const atmosphere::SpectralBand& band = medium.bands[std::min(i, medium.bands.size() - 1)];
    text::BandGroup& group = groups[i / 4];
    const int channel = int(i % 4);
    group.solar_irradiance[channel] = band.solar_irradiance;
    group.rayleigh_scattering[channel] = band.rayleigh_scattering_per_km;
    group.aerosol_scattering[channel] = band.aerosol_scattering_per_km;
    group.aerosol_extinction[channel] = band.aerosol_extinction_per_km;
    group.ozone_absorption[channel] = band.ozone_absorption_per_km;
    group.ground_albedo[channel] = band.ground_albedo;
    group.source_scale[channel] = 1;
  }
  return groups;
}

double aerosol_phase_norm(double g) { return 3 / (8 * PI) * (1 - g * g) / (2 + g * g); }

std::vector<glm::dvec2> gauss_nodes(int count) {
  std::vector<glm::dvec2> nodes(count);
  for (int i = 0; i < count; ++i) {
    // Newton's method on P_count from Tricomi's first guess.
    double x = std::cos(PI * (i + 0.75) / (count + 0.5));
    double slope = 1;
    for (int step = 0; step < 100; ++step) {
      double p0 = 1, p1 = x;
      for (int n = 2; n <= count; ++n) {
        const double p2 = ((2 * n - 1) * x * p1 - (n - 1) * p0) / n;
        p0 = p1;
        p1 = p2;
      }
      slope = count * (x * p1 - p0) / (x * x - 1);
      const double change = p1 / slope;
      x -= change;
      if (std::abs(change) < 1e-15) break;
    }
    nodes[count - 1 - i] = {0.5 * (1 + x), 1 / ((1 - x * x) * slope * slope)};
  }
  return nodes;
}

PhysicsData physics_data(const atmosphere::Medium& medium, const Settings& settings, int samples) {
  PhysicsData data;
  data.air = air_parameters(medium, settings);
  data.air.march_samples = samples;
  data.groups = band_groups(medium);
  data.gauss = gauss_nodes(samples);
  return data;
}

}  // namespace skylapse::sky::bruneton
