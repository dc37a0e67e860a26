// The ends of every range, and what random draws find between them.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "bruneton/twins.h"
#include "sky/bruneton/physics.h"

namespace skylapse::sky::bruneton {
namespace {

struct Named {
  std::string name;
  atmosphere::Medium medium;
};

Named changed(const std::string& name, const std::function<void(atmosphere::Medium&)>& change) {
  Named result{name, green_medium()};
  change(result.medium);
  return result;
}

/// Aerosol of a visibility (Koschmieder: extinction 3.912 / V, air included).
void set_visibility(atmosphere::Medium& medium, double visibility_km) {
  atmosphere::SpectralBand& band = medium.bands[0];
  band.aerosol_extinction_per_km =
      std::max(3.912 / visibility_km - band.rayleigh_scattering_per_km, 0.0);
  band.aerosol_scattering_per_km = 0.9 * band.aerosol_extinction_per_km;
}

std::vector<Named> hard_media() {
  using M = atmosphere::Medium;
  return {
      changed("reference", [](M&) {}),
      changed("isotropic aerosol", [](M& m) { m.aerosol_g = 0; }),
      changed("g 0.99", [](M& m) { m.aerosol_g = 0.99; }),
      changed("g -0.5", [](M& m) { m.aerosol_g = -0.5; }),
      changed("black ground", [](M& m) { m.bands[0].ground_albedo = 0; }),
      changed("white ground", [](M& m) { m.bands[0].ground_albedo = 1; }),
      changed("no aerosol",
              [](M& m) {
                m.bands[0].aerosol_extinction_per_km = m.bands[0].aerosol_scattering_per_km = 0;
              }),
      changed("no air", [](M& m) { m.bands[0].rayleigh_scattering_per_km = 0; }),
      changed("no ozone", [](M& m) { m.bands[0].ozone_absorption_per_km = 0; }),
      changed("vacuum",
              [](M& m) {
                m.bands[0].aerosol_extinction_per_km = m.bands[0].aerosol_scattering_per_km = 0;
                m.bands[0].rayleigh_scattering_per_km = m.bands[0].ozone_absorption_per_km = 0;
              }),
      changed("visibility 200 m", [](M& m) { set_visibility(m, 0.2); }),
      changed("visibility 300 km", [](M& m) { set_visibility(m, 300); }),
      changed("planet of 400 km", [](M& m) { m.bottom_radius_km = 400; }),
      changed("planet of 60,000 km", [](M& m) { m.bottom_radius_km = 60000; }),
      changed("conservative, white",
              [](M& m) {
                m.bands[0].ozone_absorption_per_km = 0;
                m.bands[0].aerosol_scattering_per_km = m.bands[0].aerosol_extinction_per_km;
                m.bands[0].ground_albedo = 1;
              }),
  };
}

/// The same checks for every answer: finite, not negative, not more than the sun gives.
void expect_sound(const Twin& twin, const Query& query, const std::string& where) {
  MarchSettings march;
  march.ground = true;
  const Answer answer = twin.answer(query, march);
  const auto place = [&] {
    return where + ": height " + std::to_string(query.height.in(metre)) + " m, sun " +
           std::to_string(query.sun_zenith.in(deg)) + ", view " +
           std::to_string(query.view_zenith.in(deg)) + ", azimuth " +
           std::to_string(query.azimuth.in(deg));
  };
  for (size_t b = 0; b < answer.radiance.size(); ++b) {
    ASSERT_TRUE(std::isfinite(answer.radiance[b])) << place();
    ASSERT_GE(answer.radiance[b], 0) << place();
    for (const double t : {answer.transmittance[b], answer.sun_transmittance[b]}) {
      ASSERT_GE(t, 0) << place();
      ASSERT_LE(t, 1) << place();
    }
  }
}

std::vector<Length> hard_heights(double top_km) {
  return {0 * metre,   1e-2 * metre,
          1 * metre,   top_km * km - 1 * metre,
          top_km * km, top_km * km + 1 * metre,
          400 * km,    36000 * km};
}

TEST(HardCases, AreFiniteAndNotNegativeInEveryMedium) {
  const double pi = text::PI;
  for (const Named& air : hard_media()) {
    const Twin twin = make_twin(air.medium);
    for (const Length height : hard_heights(air.medium.top_height_km)) {
      const double horizon = slice_grid(air.medium, height, 8, 8).horizon_zenith_rad;
      for (const double sun :
           {0.0, 30 * pi / 180, pi / 2, horizon, 100 * pi / 180, 140 * pi / 180, pi}) {
        const std::vector<std::pair<double, double>> views{{0, 0},
                                                           {pi, 0},
                                                           {horizon, 0},
                                                           {horizon + 1e-6, 0},
                                                           {horizon - 1e-6, 0},
                                                           {horizon, pi},
                                                           {sun, 0},
                                                           {pi - sun, pi},
                                                           {pi / 2, pi / 2},
                                                           {horizon - 0.02, 0.1},
                                                           {horizon + 0.02, 3}};
        for (const auto& [zenith, azimuth] : views)
          expect_sound(twin, {height, sun * rad, zenith * rad, azimuth * rad}, air.name);
      }
    }
  }
}

/// 10^7 draws are in benchmarks/bruneton_twin.
TEST(HardCases, RandomDrawsAreFiniteAndNotNegative) {
  const atmosphere::Medium medium = atmosphere::reference_medium();
  const Twin twin = make_twin(medium);
  std::mt19937_64 random(20260101);
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < 20000; ++i) {
    const double height_km = share(random) < 0.8 ? 60 * std::pow(share(random), 3)
                                                 : 60 * std::pow(1000.0, share(random));
    expect_sound(twin,
                 {height_km * km, std::acos(1 - 2 * share(random)) * rad,
                  std::acos(1 - 2 * share(random)) * rad, share(random) * text::PI * rad},
                 "draw " + std::to_string(i));
  }
}

TEST(HardCases, NothingIsSeenInTheSkyOfSpace) {
  const Twin twin = make_twin(green_medium());
  for (const double height : {61.0, 400.0, 36000.0})
    for (const double view : {0.0, 60.0, 90.0}) {
      const Answer answer = twin.answer({height * km, 20 * deg, view * deg, 0 * deg});
      EXPECT_EQ(answer.radiance[0], 0);
      EXPECT_EQ(answer.transmittance[0], 1);
      EXPECT_EQ(answer.sun_transmittance[0], 1);
    }
}

TEST(HardCases, BehindThePlanetTheSunIsHidden) {
  const Twin twin = make_twin(green_medium());
  for (const double height : {0.0, 60.0, 400.0, 36000.0})
    EXPECT_EQ(twin.answer({height * km, 180 * deg, 0 * deg, 0 * deg}).sun_transmittance[0], 0);
}

}  // namespace
}  // namespace skylapse::sky::bruneton
