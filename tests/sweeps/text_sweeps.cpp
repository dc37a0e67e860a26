// The physics text of the shaders, float against double at the same (float) arguments.
#include <fmt/format.h>

#include <array>
#include <memory>

#include "sky/atmosphere/atmosphere.h"
#include "sky/bruneton/columns.h"
#include "sky/bruneton/physics.h"
#include "sky/bruneton/physics_fetch.h"
#include "sky/bruneton/slice_angles.h"
#include "sweeps/float_text.h"
#include "sweeps/sweep.h"

namespace skylapse::sweeps {
namespace {

using namespace skylapse::sky;
using bruneton::Geometry;

/// A medium in both precisions.
struct Both {
  explicit Both(const atmosphere::Medium& medium)
      : columns(medium), data(physics_data(medium, bruneton::Settings{}, 4)) {
    data.columns = columns.nodes().data();
    const auto& group = data.groups[0];
    narrow = std::make_unique<FloatText>(reinterpret_cast<const double*>(&data.air),
                                         sizeof(data.air) / sizeof(double), columns.nodes(),
                                         group.rayleigh_scattering, group.aerosol_extinction,
                                         group.ozone_absorption);
  }
  [[nodiscard]] Geometry wide() const { return Geometry(data); }

  bruneton::Columns columns;
  bruneton::PhysicsData data;
  std::unique_ptr<FloatText> narrow;
};

atmosphere::Medium medium_of(const atmosphere::AirDescription& air) {
  return medium_at(*atmosphere_of(air), atmosphere::band_edges(4));
}

/// Thick haze that scatters almost straight ahead, under a volcano's veil.
atmosphere::AirDescription murk() {
  atmosphere::AirDescription air;
  air.aerosol_optical_depth = 5;
  air.aerosol_g = 0.99;
  air.stratospheric_optical_depth = 0.3;
  return air;
}

/// A planet of a tenth of the Earth's size, whose haze scatters backward.
atmosphere::AirDescription small_planet() {
  atmosphere::AirDescription air;
  air.aerosol_g = -0.9;
  air.planet_radius = 600.0 * km;
  return air;
}

/// The published medium, the default air, and the two above.
const Both& medium_for(Draw& draw) {
  static const std::array<Both, 4> kMedia{Both(atmosphere::reference_medium()), Both(medium_of({})),
                                          Both(medium_of(murk())), Both(medium_of(small_planet()))};
  return kMedia[size_t(draw.below(int(kMedia.size())))];
}

constexpr double kRounding = 0x1p-24;  // half a unit of float's last place, relative to 1

using Where = std::function<std::string()>;

/// One function of the text: `narrow` and `wide` answer at the same drawn arguments.
struct Arguments {
  float h, mu, mu_s, nu;
  const Both* both;
  [[nodiscard]] std::string text() const {
    return fmt::format("h {:.9g} mu {:.9g} mu_s {:.9g} nu {:.9g} R {:.6g}", h, mu, mu_s, nu,
                       both->data.air.bottom_radius);
  }
};

/// A height of the air, a direction there (often the horizon or close to it), a sun and an angle
/// between the two that geometry allows.
Arguments draw_arguments(Draw& draw) {
  Arguments a{};
  a.both = &medium_for(draw);
  a.h = draw.float_in(0, float(a.both->data.air.top_height));
  auto g = a.both->wide();
  a.mu = draw.float_in(-1, 1);
  if (draw.below(4) == 0) a.mu = float(g.horizon_mu(a.h) + (draw.unit() - 0.5) * 1e-3);
  a.mu_s = draw.float_in(-1, 1);
  if (draw.below(4) == 0) a.mu_s = float(g.horizon_mu(a.h) + (draw.unit() - 0.5) * 1e-2);
  a.mu = std::clamp(a.mu, -1.f, 1.f);
  a.mu_s = std::clamp(a.mu_s, -1.f, 1.f);
  a.nu = float(g.cosine_to_sun(a.mu, a.mu_s, draw.in(0, bruneton::text::PI)));
  return a;
}

/// Both answers finite, their difference an error in the given measure.
using Compare = std::function<double(const Arguments&, Draw&, Tally&, const Where&)>;

void add(std::vector<Sweep>& sweeps, std::string name, std::string measure, double bound,
         std::string reason, const Compare& error_of) {
  sweeps.push_back({"text: " + name, std::move(measure), bound, std::move(reason), 1,
                    [error_of](Draw& draw, Tally& tally) {
                      const Arguments a = draw_arguments(draw);
                      const Where where = [&a] { return a.text(); };
                      const double error = error_of(a, draw, tally, where);
                      if (tally.finite(error, where)) tally.error(error, where);
                    }});
}

double relative(double narrow, double wide) {
  return std::abs(narrow - wide) / std::max(std::abs(wide), 1e-37);
}

void add_phases(std::vector<Sweep>& sweeps) {
  add(sweeps, "rayleigh_phase", "relative", 6 * kRounding, "five roundings",
      [](const Arguments& a, Draw&, Tally&, const Where&) {
        return relative(a.both->narrow->rayleigh_phase(a.nu), a.both->wide().rayleigh_phase(a.nu));
      });
  // The host rounds g: 1 - g of g = 0.99 has lost 2^-24 / 0.01, and stands there to the third
  // power.
  add(sweeps, "aerosol_phase", "relative", 3 * 100 * kRounding + 12 * kRounding,
      "g itself is rounded; the peak goes with (1 - g)^-3",
      [](const Arguments& a, Draw&, Tally&, const Where&) {
        return relative(a.both->narrow->aerosol_phase(a.nu), a.both->wide().aerosol_phase(a.nu));
      });
}

void add_densities(std::vector<Sweep>& sweeps) {
  add(sweeps, "densities", "of the density at the ground", 1e-5,
      "exp takes the rounding of h / H times h / H; breaks are rounded to 2^-24 of their height",
      [](const Arguments& a, Draw&, Tally& tally, const Where& where) {
        const glm::vec3 narrow = a.both->narrow->densities(a.h);
        const glm::dvec3 wide = a.both->wide().densities(a.h);
        double worst = 0;
        for (int c = 0; c < 3; ++c) {
          tally.law(narrow[c] >= 0, where);
          // At a height where a term ends, rounding decides which side it is on.
          worst = std::max(worst, std::abs(narrow[c] - wide[c]));
        }
        return worst;
      });
}

void add_rays(std::vector<Sweep>& sweeps) {
  add(sweeps, "height_along", "km", 1e-3, "t mu of 1000 km is rounded to 2^-24: 0.06 m, some times",
      [](const Arguments& a, Draw& draw, Tally& tally, const Where& where) {
        auto g = a.both->wide();
        const double end = a.mu < g.horizon_mu(a.h) ? g.distance_to_ground(a.h, a.mu)
                                                    : g.distance_to_top(a.h, a.mu);
        const auto t = float(draw.in(0, end));
        const float narrow = a.both->narrow->height_along(a.h, a.mu, t);
        tally.law(narrow >= 0 && narrow <= float(a.both->data.air.top_height), where);
        return std::abs(narrow - g.height_along(a.h, a.mu, t));
      });
  add(sweeps, "horizon_mu", "absolute", 6 * kRounding, "five roundings of numbers up to 1",
      [](const Arguments& a, Draw&, Tally&, const Where&) {
        return std::abs(a.both->narrow->horizon_mu(a.h) - a.both->wide().horizon_mu(a.h));
      });
  add(sweeps, "distance_to_top", "km, times the slope there", 4e-3,
      "through the planet the ray is 12,900 km long: five roundings of 2^-24",
      [](const Arguments& a, Draw&, Tally& tally, const Where& where) {
        auto g = a.both->wide();
        const float narrow = a.both->narrow->distance_to_top(a.h, a.mu);
        tally.law(narrow >= 0, where);
        const double R = a.both->data.air.bottom_radius, H = a.both->data.air.top_height;
        const double slope = (g.radius_of(a.h) * a.mu + g.distance_to_top(a.h, a.mu)) / (R + H);
        return std::abs(narrow - g.distance_to_top(a.h, a.mu)) * std::abs(slope);
      });
  add(sweeps, "distance_to_ground", "km, times the slope there", 1e-3,
      "as height_along: how far above or below the ground the ray ends",
      [](const Arguments& a, Draw&, Tally& tally, const Where& where) {
        auto g = a.both->wide();
        const float mu = std::min(a.mu, std::nextafter(float(g.horizon_mu(a.h)), -1.f));
        const float narrow = a.both->narrow->distance_to_ground(a.h, mu);
        tally.law(narrow >= 0, where);
        const double wide = g.distance_to_ground(a.h, mu);
        const double slope = (g.radius_of(a.h) * mu + wide) / a.both->data.air.bottom_radius;
        return std::abs(narrow - wide) * std::abs(slope);
      });
}

/// Cuts are places to begin the march anew: that one is there, and no number is none.
void add_cuts(std::vector<Sweep>& sweeps) {
  const auto law = [](const glm::dvec2& cuts, Tally& tally, const Where& where) {
    tally.law(cuts.x <= cuts.y, where);
    return std::isfinite(cuts.x) && std::isfinite(cuts.y) ? 0.0 : double(NAN);
  };
  add(sweeps, "shadow_cuts", "finite, in order", 0, "a place more or less is no error",
      [law](const Arguments& a, Draw&, Tally& tally, const Where& where) {
        return law(a.both->narrow->shadow_cuts(a.h, a.mu, a.mu_s, a.nu), tally, where) +
               law(a.both->wide().shadow_cuts(a.h, a.mu, a.mu_s, a.nu), tally, where);
      });
  add(sweeps, "grazing_cuts", "finite, in order", 0, "a place more or less is no error",
      [law](const Arguments& a, Draw& draw, Tally& tally, const Where& where) {
        const float level = draw.float_in(0, float(a.both->data.air.top_height));
        return law(a.both->narrow->grazing_cuts(a.h, a.mu, a.mu_s, a.nu, level), tally, where) +
               law(a.both->wide().grazing_cuts(a.h, a.mu, a.mu_s, a.nu, level), tally, where);
      });
}

void add_coordinates(std::vector<Sweep>& sweeps) {
  add(sweeps, "columns_texel", "texels, height and distance", 0.05,
      "the distance of a grazing ray to the top: its rounding over the texel's share of it",
      [](const Arguments& a, Draw&, Tally& tally, const Where& where) {
        auto g = a.both->wide();
        const float mu = std::max(a.mu, float(g.horizon_mu(a.h)));
        const glm::vec2 narrow = a.both->narrow->columns_texel(a.h, mu);
        tally.law(narrow.x >= 0 && narrow.x <= 63 && narrow.y >= 0 && narrow.y <= 255, where);
        // At the top itself all distances are one: directions there say nothing.
        const double weight = a.h < float(a.both->data.air.top_height) * 0.9999f ? 1 : 0;
        const glm::dvec2 wide = g.columns_texel(a.h, mu);
        return std::max(std::abs(narrow.x - wide.x), weight * std::abs(narrow.y - wide.y));
      });
  add(sweeps, "height_coordinate", "nodes", 1e-4, "a few roundings of a coordinate up to 50",
      [](const Arguments& a, Draw&, Tally& tally, const Where& where) {
        const double narrow = a.both->narrow->height_coordinate(a.h);
        tally.law(narrow >= 0 && narrow <= a.both->data.air.height_last + 1e-4, where);
        return std::abs(narrow - a.both->wide().height_coordinate(a.h));
      });
  add(sweeps, "zenith_coordinate", "texels", 1e-4, "a few roundings of a coordinate up to 100",
      [](const Arguments& a, Draw&, Tally&, const Where&) {
        return std::abs(a.both->narrow->zenith_coordinate(a.mu) -
                        a.both->wide().zenith_coordinate(a.mu));
      });
  add(sweeps, "sun_row_of", "rows", 2e-3,
      "near centre_rad a row is hundredths of a degree wide: the rounding of acos against that",
      [](const Arguments& a, Draw&, Tally& tally, const Where& where) {
        const double narrow = a.both->narrow->sun_row_of(a.mu_s);
        tally.law(narrow >= 0 && narrow <= a.both->data.air.sun_row_last, where);
        return std::abs(narrow - a.both->wide().sun_row_of(a.mu_s));
      });
  // sin^2 of the distance moved on the sphere: azimuths turn without end at the zenith.
  add(sweeps, "azimuth_coordinate", "of the azimuth's cosine, times both sines", 20 * kRounding,
      "nu - mu mu_s is rounded to 2^-24 whatever the sines that divide it",
      [](const Arguments& a, Draw&, Tally&, const Where&) {
        const double scale = bruneton::text::PI / a.both->data.air.azimuth_last;
        const double narrow = a.both->narrow->azimuth_coordinate(a.mu, a.mu_s, a.nu) * scale;
        const double wide = a.both->wide().azimuth_coordinate(a.mu, a.mu_s, a.nu) * scale;
        const double sines = std::sqrt((1 - double(a.mu) * a.mu) * (1 - double(a.mu_s) * a.mu_s));
        return std::abs(std::cos(narrow) - std::cos(wide)) * sines;
      });
}

void add_light(std::vector<Sweep>& sweeps) {
  add(sweeps, "sun_visibility", "absolute", 3e-4,
      "the rounding of two cosines against the disc's width of 0.0093, slope 1.5, small planets "
      "more",
      [](const Arguments& a, Draw&, Tally& tally, const Where& where) {
        const float narrow = a.both->narrow->sun_visibility(a.h, a.mu_s);
        tally.law(narrow >= 0 && narrow <= 1, where);
        return std::abs(narrow - a.both->wide().sun_visibility(a.h, a.mu_s));
      });
  add(sweeps, "sun_mean_cosine", "absolute", 6 * kRounding, "a few roundings of numbers up to 1",
      [](const Arguments& a, Draw&, Tally& tally, const Where& where) {
        const float narrow = a.both->narrow->sun_mean_cosine(a.mu_s);
        tally.law(narrow >= 0 && narrow <= 1, where);
        return std::abs(narrow - a.both->wide().sun_mean_cosine(a.mu_s));
      });
  add(sweeps, "cosine_to_sun", "absolute", 10 * kRounding, "a few roundings of numbers up to 1",
      [](const Arguments& a, Draw& draw, Tally& tally, const Where& where) {
        const float azimuth = draw.float_in(0, 3.14159274f);
        const float narrow = a.both->narrow->cosine_to_sun(a.mu, a.mu_s, azimuth);
        tally.law(narrow >= -1 && narrow <= 1, where);
        return std::abs(narrow - a.both->wide().cosine_to_sun(a.mu, a.mu_s, azimuth));
      });
  add(sweeps, "transmittance to the top", "absolute", 2e-3,
      "as columns_texel and the roundings of an optical depth",
      [](const Arguments& a, Draw&, Tally& tally, const Where& where) {
        const glm::vec4 narrow = a.both->narrow->transmittance(a.h, a.mu);
        auto g = a.both->wide();
        const glm::dvec4 wide =
            glm::exp(-g.optical_depth(a.both->data.groups[0], g.columns_to_top(a.h, a.mu)));
        double worst = 0;
        for (int c = 0; c < 4; ++c) {
          tally.law(narrow[c] >= 0 && narrow[c] <= 1 && wide[c] >= 0 && wide[c] <= 1, where);
          worst = std::max(worst, std::abs(narrow[c] - wide[c]));
        }
        return worst;
      });
}

/// The pixel loops' own functions; their headers state the bounds.
void add_angles(std::vector<Sweep>& sweeps) {
  sweeps.push_back({"slice angles: fast_atan2", "rad", 4e-7, "stated in slice_angles.h", 1,
                    [](Draw& draw, Tally& tally) {
                      const float y = draw.float_in(-1, 1), x = draw.float_in(-1, 1);
                      const auto where = [&] { return fmt::format("y {:.9g} x {:.9g}", y, x); };
                      const double narrow = bruneton::kernel::fast_atan2(y, x);
                      // Below float's normal numbers the quotient is guarded, not right.
                      if (!tally.finite(narrow, where) || std::hypot(x, y) < 1e-30) return;
                      const double wide = std::atan2(double(y), double(x));
                      tally.error(std::min(std::abs(narrow - wide),
                                           std::abs(std::abs(narrow - wide) - 2 * M_PI)),
                                  where);
                    }});
  sweeps.push_back({"slice angles: power_two_thirds", "relative", 5e-7, "stated in slice_angles.h",
                    1, [](Draw& draw, Tally& tally) {
                      const auto v = float(draw.magnitude(1e-22, 1));
                      const auto where = [&] { return fmt::format("v {:.9g}", v); };
                      const double narrow = bruneton::kernel::power_two_thirds(v);
                      if (tally.finite(narrow, where))
                        tally.error(relative(narrow, std::pow(double(v), 2.0 / 3)), where);
                    }});
}

}  // namespace

void add_text_sweeps(std::vector<Sweep>& sweeps) {
  add_phases(sweeps);
  add_densities(sweeps);
  add_rays(sweeps);
  add_cuts(sweeps);
  add_coordinates(sweeps);
  add_light(sweeps);
  add_angles(sweeps);
}

}  // namespace skylapse::sweeps
