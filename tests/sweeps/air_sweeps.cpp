// Air and sky models in double: against long double where the formula is short, by laws elsewhere.
#include <fmt/format.h>

#include "sky/atmosphere/atmosphere.h"
#include "sky/atmosphere/phase_functions.h"
#include "sky/atmosphere/standard_air.h"
#include "sky/bruneton/columns.h"
#include "sky/bruneton/rays.h"
#include "sky/bruneton/sky_slice.h"
#include "sky/hosek_wilkie/model.h"
#include "sky/sun_disc.h"
#include "sky/twilight.h"
#include "sweeps/sweep.h"

namespace skylapse::sweeps {
namespace {

using namespace skylapse::sky;

constexpr double kEpsilon = 0x1p-53;
constexpr long double kPi = 3.141592653589793238462643383279502884L;

double relative(double value, long double truth) {
  return double(std::abs(value - truth) / std::max(std::abs(truth), 1e-300L));
}

void add_phases(std::vector<Sweep>& sweeps) {
  sweeps.push_back(
      {"atmosphere: rayleigh_phase", "relative to long double", 8 * kEpsilon, "seven roundings", 1,
       [](Draw& draw, Tally& tally) {
         const double rho = draw.in(0, 1), nu = draw.in(-1, 1);
         const auto where = [&] { return fmt::format("rho {:.17g} nu {:.17g}", rho, nu); };
         const double value = atmosphere::rayleigh_phase(rho, nu);
         if (!tally.finite(value, where)) return;
         const long double r = rho, n = nu;
         tally.error(relative(value, 3 / (8 * kPi * (2 + r)) * ((1 + r) + (1 - r) * n * n)), where);
       }});
  sweeps.push_back({"atmosphere: aerosol_phase", "relative to long double", 16 * kEpsilon,
                    "(1 - g)^2 + 2 g (1 - nu) keeps its digits: a dozen roundings", 1,
                    [](Draw& draw, Tally& tally) {
                      const double end = std::nextafter(1.0, 0.0);
                      const double g = draw.in(-end, end), nu = draw.in(-1, 1);
                      const auto where = [&] { return fmt::format("g {:.17g} nu {:.17g}", g, nu); };
                      const double value = atmosphere::aerosol_phase(g, nu);
                      if (!tally.finite(value, where)) return;
                      tally.law(value >= 0, where);
                      const long double G = g, n = nu;
                      const long double d = G >= 0 ? (1 - G) * (1 - G) + 2 * G * (1 - n)
                                                   : (1 + G) * (1 + G) - 2 * G * (1 + n);
                      tally.error(relative(value, 3 / (8 * kPi) * (1 - G) * (1 + G) / (2 + G * G) *
                                                      (1 + n * n) / (d * std::sqrt(d))),
                                  where);
                    }});
}

atmosphere::DensityProfile draw_profile(Draw& draw) {
  switch (draw.below(3)) {
    case 0:
      return atmosphere::exponential_profile(draw.magnitude(0.01, 1000) * km, 100.0 * km);
    case 1: {
      const double bottom = draw.in(0, 50);
      return atmosphere::tent_profile(bottom * km, (bottom + draw.magnitude(1e-3, 20)) * km,
                                      (bottom + 20 + draw.magnitude(1e-3, 30)) * km);
    }
    default:
      return atmosphere::standard_air_profile(100.0 * km);
  }
}

void add_profiles(std::vector<Sweep>& sweeps) {
  sweeps.push_back(
      {"atmosphere: DensityProfile::at", "none", 0, "laws alone", 1, [](Draw& draw, Tally& tally) {
         const auto profile = draw_profile(draw);
         const double h = draw.below(4) == 0 ? draw.in(-1e308, 1e308) : draw.in(-1, 101);
         const auto where = [&] { return fmt::format("h {:.17g}", h); };
         const double value = profile.at(h);
         if (tally.finite(value, where)) tally.law(value >= 0 && value <= 1.01, where);
       }});
  sweeps.push_back(
      {"atmosphere: vertical_column_km", "none", 0, "laws alone", 1, [](Draw& draw, Tally& tally) {
         const auto profile = draw_profile(draw);
         const double low = draw.in(0, 120), high = low + draw.magnitude(1e-9, 50);
         const auto where = [&] { return fmt::format("to {:.17g} km", high); };
         const double below = profile.vertical_column_km(low);
         const double value = profile.vertical_column_km(high);
         if (!tally.finite(value, where)) return;
         // Grows with the height, by no more than the greatest density.
         tally.law(value >= below - 1e-12 * value, where);
         tally.law(value - below <= 1.01 * (high - low) + 1e-12 * value, where);
       }});
}

const bruneton::Columns& earth_columns() {
  static const bruneton::Columns kColumns(
      medium_at(*atmosphere::atmosphere_of({}), atmosphere::band_edges(4)));
  return kColumns;
}

void add_rays(std::vector<Sweep>& sweeps) {
  sweeps.push_back(
      {"bruneton: make_ray", "km off ground or top at the ray's end", 1e-8,
       "a length of 1e4 km in double; from 1e6 km away the last digits of the direction count", 1,
       [](Draw& draw, Tally& tally) {
         // On the ground, in the air, at 400 km, 36,000 km and as far as the moon.
         const double h = draw.below(2) == 0 ? draw.in(0, 110) : draw.magnitude(110, 4e5);
         const double mu = draw.in(-1, 1);
         const auto where = [&] { return fmt::format("h {:.17g} km mu {:.17g}", h, mu); };
         const auto ray = bruneton::make_ray(earth_columns(), h, mu);
         if (!tally.finite(ray.length + ray.skipped + ray.height + ray.mu, where)) return;
         tally.law(ray.length >= 0 && ray.lowest >= 0 && ray.lowest <= ray.length, where);
         tally.law(ray.height >= 0 && ray.height <= 100 && std::abs(ray.mu) <= 1, where);
         for (int i = 0; i < int(ray.cut_count); ++i)
           tally.law(ray.cuts[i] >= 0 && ray.cuts[i] <= ray.length &&
                         (i == 0 || ray.cuts[i] >= ray.cuts[i - 1]),
                     where);
         if (ray.length == 0 || h > 1000) return;
         const double R = earth_columns().medium().bottom_radius_km;
         const double r = R + ray.height, t = ray.length;
         const double end = std::sqrt(r * r + t * t + 2 * r * ray.mu * t) - R;
         tally.error(std::abs(end - (ray.hits_ground > 0 ? 0 : 100)), where);
       }});
  sweeps.push_back(
      {"bruneton: SliceGrid share and elevation", "rad, there and back", 1e-8,
       "share^2 is found from elevation by a root: half the digits where it is 0", 1,
       [](Draw& draw, Tally& tally) {
         const double h = draw.below(2) == 0 ? draw.in(0, 100e3) : draw.magnitude(1e5, 4e8);
         const auto grid = bruneton::slice_grid(earth_columns().medium(), h * metre);
         const bool sky = draw.below(2) == 0;
         const double span = sky ? grid.sky_span_rad : grid.ground_span_rad;
         const double over = (sky ? 1 : -1) * draw.in(0, span);
         const auto where = [&] { return fmt::format("h {:.17g} m over {:.17g} rad", h, over); };
         const double share = grid.share(over);
         if (!tally.finite(share, where)) return;
         tally.law(share >= 0 && share <= 1 + 1e-12, where);
         if (span > 0) tally.error(std::abs(grid.elevation(share, sky) - std::abs(over)), where);
       }});
}

/// The fit may be negative near the horizon, where its terms cancel: the error is judged by their
/// sizes.
double error_of_pattern(const hosek_wilkie::Pattern& p, double cos_theta, double gamma,
                        double value) {
  const long double gradient = 1 + p.a * std::exp((long double)p.b / (cos_theta + 0.01L));
  const long double cosine = std::cos((long double)gamma);
  const long double d = 1 + (long double)p.h * p.h - 2 * p.h * cosine;
  const long double terms[] = {p.c, p.d * std::exp((long double)p.e * gamma), p.f * cosine * cosine,
                               p.g * (1 + cosine * cosine) / (d * std::sqrt(d)),
                               p.i * std::sqrt((long double)cos_theta)};
  long double sum = 0, size = 0;
  for (const long double term : terms) sum += term, size += std::abs(term);
  const long double whole = std::abs(p.scale) * (1 + std::abs(gradient - 1)) * size;
  return double(std::abs(value - p.scale * gradient * sum) / whole);
}

void add_hosek_wilkie(std::vector<Sweep>& sweeps) {
  using namespace hosek_wilkie;
  sweeps.push_back(
      {"hosek_wilkie: radiance", "of the sum of its terms' sizes, to long double", 1e-13,
       "exp(E gamma) and exp(B / (cos theta + 0.01)) take the rounding of exponents up to 100",
       0.02, [](Draw& draw, Tally& tally) {
         const Fit fit = Fit(draw.below(3));
         SkyParameters sky;
         sky.turbidity = draw.in(1, 10);
         for (double& albedo : sky.albedo) albedo = draw.in(0, 1);
         sky.sun_elevation = draw.in(0, 90) * deg;
         const auto patterns = make_patterns(fit, sky);
         const auto sky_text = [&] {
           return fmt::format("fit {} T {:.17g} albedo {:.17g} sun {:.17g} deg", int(fit),
                              sky.turbidity, sky.albedo[0], sky.sun_elevation.in(deg));
         };
         tally.law(patterns.ok(), sky_text);
         if (!patterns) return;
         for (int i = 0; i < 50; ++i) {
           const Pattern& pattern = patterns->items[size_t(draw.below(patterns->count))];
           const double cos_theta = draw.in(0, 1);
           const Angle gamma = draw.in(0, 180) * deg;
           const auto where = [&] {
             return fmt::format("{} cos theta {:.17g} gamma {:.17g}", sky_text(), cos_theta,
                                gamma.in(deg));
           };
           const double value = radiance(pattern, cos_theta, gamma);
           if (tally.finite(value, where))
             tally.error(error_of_pattern(pattern, cos_theta, gamma.in(rad), value), where);
         }
       }});
}

void add_light(std::vector<Sweep>& sweeps) {
  sweeps.push_back({"sky: twilight and mean luminance", "none", 0, "laws alone", 1,
                    [](Draw& draw, Tally& tally) {
                      const double h = draw.in(-90, 90);
                      const double higher = std::min(h + draw.magnitude(1e-6, 10), 90.0);
                      const auto where = [&] { return fmt::format("sun {:.17g} deg", h); };
                      const auto brightens = [&](const auto& light, auto unit) {
                        const double here = light(h * deg).in(unit);
                        if (!tally.finite(here, where)) return;
                        tally.law(here > 0, where);
                        // The mean sky of a sun near the zenith may fall by a little.
                        if (higher < 20)
                          tally.law(light(higher * deg).in(unit) >= here * (1 - 1e-9), where);
                      };
                      brightens(clear_sky_illuminance, lux);
                      brightens(mean_clear_sky_luminance, cd_per_m2);
                      brightens(mean_computed_sky_luminance, cd_per_m2);
                    }});
  sweeps.push_back(
      {"sky: twilight_level", "none", 0, "laws alone", 1, [](Draw& draw, Tally& tally) {
         const double h = draw.in(-90, 90), h0 = draw.in(-1, 0);
         const double at_horizon = draw.magnitude(200, 1e4);
         const auto where = [&] {
           return fmt::format("h {:.17g} h0 {:.17g} lux {:.17g}", h, h0, at_horizon);
         };
         const double level = twilight_level(h * deg, h0 * deg, at_horizon * lux);
         if (!tally.finite(level, where)) return;
         tally.law(level > 0 && level <= 1, where);
         tally.law(h < h0 || level == 1, where);
       }});
  sweeps.push_back(
      {"sky: haversine_in_disc", "of round discs, relative to the angle's own", 1e-9,
       "two roundings of unit vectors 1e-6 apart", 1, [](Draw& draw, Tally& tally) {
         SunDisc disc;
         disc.centre = enu_direction(draw.in(0, 360) * deg, draw.in(-1, 90) * deg);
         disc.radius = draw.magnitude(1e-3, 10) * deg;
         disc.flattening = draw.below(2) == 0 ? 1 : draw.in(0.5, 1);
         const auto seen = enu_direction(draw.in(0, 360) * deg, draw.in(-90, 90) * deg);
         const auto where = [&] {
           return fmt::format("centre {:.17g} {:.17g} seen {:.17g} {:.17g} flattening {:.17g}",
                              azimuth(disc.centre).in(deg), elevation(disc.centre).in(deg),
                              azimuth(seen).in(deg), elevation(seen).in(deg), disc.flattening);
         };
         const double value = haversine_in_disc(disc, seen);
         if (!tally.finite(value, where)) return;
         tally.law(value >= 0 && value <= 1 + 1e-12, where);
         if (disc.flattening != 1) return;
         const double half = std::sin(0.5 * separation(disc.centre, seen).in(rad));
         if (half > 1e-6) tally.error(std::abs(value / (half * half) - 1), where);
       }});
  sweeps.push_back(
      {"sky: disc_energy", "above that of the whole disc, relative", 1e-6, "stated in sun_disc.h",
       2e-3, [](Draw& draw, Tally& tally) {
         SunDisc disc;
         const double elevation_deg = draw.in(-1, 90), radius_deg = draw.magnitude(1e-3, 1);
         disc.centre = enu_direction(draw.in(0, 360) * deg, elevation_deg * deg);
         disc.radius = radius_deg * deg;
         disc.flattening = draw.in(0.5, 1);
         disc.radiance = [](Angle, double) { return glm::dvec3(1); };
         const auto where = [&] {
           return fmt::format("elevation {:.17g} radius {:.17g} deg flattening {:.17g}",
                              elevation_deg, radius_deg, disc.flattening);
         };
         const DiscEnergy energy = disc_energy(disc);
         if (!tally.finite(energy.normal_irradiance.x + energy.horizontal_irradiance.x, where))
           return;
         tally.law(energy.normal_irradiance.x >= 0 && energy.horizontal_irradiance.x >= 0, where);
         tally.law(energy.horizontal_irradiance.x <= energy.normal_irradiance.x * (1 + 1e-9),
                   where);
         const double half = std::sin(0.5 * disc.radius.in(rad));
         const double whole = 4 * M_PI * half * half * disc.flattening;
         tally.error(
             std::max(0.0, energy.normal_irradiance.x / whole - 1) * (radius_deg < 0.3 ? 1 : 0),
             where);
       }});
}

}  // namespace

void add_air_sweeps(std::vector<Sweep>& sweeps) {
  add_phases(sweeps);
  add_profiles(sweeps);
  add_rays(sweeps);
  add_hosek_wilkie(sweeps);
  add_light(sweeps);
}

}  // namespace skylapse::sweeps
