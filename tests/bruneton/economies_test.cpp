// What may be left out of tables and marches, by what it changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bruneton/twins.h"
#include "sky/bruneton/half_source.h"
#include "sky/bruneton/slice_irradiance.h"
#include "sky/bruneton/slice_refine.h"
#include "sky/bruneton/sun_range.h"
#include "sky/bruneton/sun_rows.h"

namespace skylapse::sky::bruneton {
namespace {

constexpr double kPi = std::numbers::pi;

Twin twin_of(const atmosphere::Medium& medium, const Settings& settings) {
  return Twin(std::make_shared<const Tables>(precompute_twin(medium, settings)));
}

Settings with_orders(Settings settings, int orders) {
  settings.orders = orders;
  return settings;
}

SkySlice slice_of(const Twin& twin, Length height, Angle sun) {
  return twin.slice(height, sun, slice_grid(twin.medium(), height, 9, 24),
                    {.samples = 8, .ground = true});
}

/// Greatest relative distance of Y over the nodes, of values above 0.1 % of the brightest.
double distance(const SkySlice& slice, const SkySlice& truth) {
  float brightest = 0;
  for (const glm::vec4& node : truth.smooth) brightest = std::max(brightest, node.y);
  double worst = 0;
  for (size_t i = 0; i < truth.smooth.size(); ++i)
    if (truth.smooth[i].y > 1e-3f * brightest)
      worst = std::max(worst, std::abs(double(slice.smooth[i].y) / truth.smooth[i].y - 1));
  return worst;
}

TEST(Orders, EachAddsLightAndTheSeriesConvergesFromBelow) {
  const atmosphere::Medium medium = green_medium();
  const Settings settings = settings_for(Level::draft, medium);
  Settings converged = settings;
  converged.stop_below = 1e-5;
  const Twin all = twin_of(medium, converged);
  const std::vector<double> suns{40, 88, 95};
  std::vector<SkySlice> truth, before;
  for (const double sun : suns) {
    truth.push_back(slice_of(all, 1 * km, sun * deg));
    before.push_back(slice_of(single_scattering_twin(medium), 1 * km, sun * deg));
  }
  for (const int orders : {2, 3, 5, 8}) {
    const Twin some = twin_of(medium, with_orders(settings, orders));
    for (size_t k = 0; k < suns.size(); ++k) {
      const SkySlice slice = slice_of(some, 1 * km, suns[k] * deg);
      for (size_t i = 0; i < slice.smooth.size(); ++i) {
        // 1e-6: the tables' numbers are rounded to float.
        ASSERT_GE(slice.smooth[i].y, before[k].smooth[i].y * (1 - 1e-6f)) << orders;
        ASSERT_LE(slice.smooth[i].y, truth[k].smooth[i].y * (1 + 1e-6f)) << orders;
      }
      EXPECT_LT(distance(slice, truth[k]), 0.6 * distance(before[k], truth[k]))
          << orders << " orders, sun " << suns[k];
      before[k] = slice;
    }
  }
}

TEST(Orders, AreAsManyAsAsked) {
  const atmosphere::Medium medium = green_medium();
  for (const int orders : {2, 3, 7}) {
    const Tables tables =
        precompute_twin(medium, with_orders(settings_for(Level::draft, medium), orders));
    EXPECT_EQ(tables.orders, orders);
  }
}

TEST(Orders, ShapeTheNameOfTables) {
  const Settings settings = settings_for(Level::draft, green_medium());
  EXPECT_NE(canonical_text(settings), canonical_text(with_orders(settings, 4)));
  const Settings part = restricted_to({20 * deg, 30 * deg}, settings, green_medium());
  EXPECT_NE(canonical_text(settings), canonical_text(part));
}

TEST(PartOfTheSuns, HasItsNodesWhereTheWholeHasThem) {
  const atmosphere::Medium medium = green_medium();
  const Settings whole = settings_for(Level::standard, medium);
  const SunNodes nodes = sun_nodes(medium, whole);
  for (const double low : {0.0, 30.0, 85.0, 110.0})
    for (const double high : {low, low + 20, 180.0}) {
      const Settings part = restricted_to({low * deg, high * deg}, whole, medium);
      const SunNodes some = sun_nodes(medium, part);
      EXPECT_GE(part.suns, kLeastSuns);
      EXPECT_EQ(part.warp_suns(), whole.suns);
      for (int j = 0; j < part.suns; ++j)
        EXPECT_NEAR(some.zenith_rad(j), nodes.zenith_rad(part.first_sun + j), 1e-12);
      // They span what was asked for, as far as there are nodes.
      EXPECT_LE(some.zenith_rad(0), std::max(low * kPi / 180, nodes.zenith_rad(0)) + 1e-2);
      EXPECT_GE(some.zenith_rad(part.suns - 1),
                std::min(high * kPi / 180, nodes.zenith_rad(whole.suns - 1)) - 1e-2);
      // Once more changes nothing, nor does asking for less and for all again.
      EXPECT_EQ(canonical_text(restricted_to({low * deg, high * deg}, part, medium)),
                canonical_text(part));
      EXPECT_EQ(canonical_text(restricted_to({0 * deg, 180 * deg}, part, medium)),
                canonical_text(whole));
    }
}

TEST(PartOfTheSuns, ChangesTheSlicesOfItsFramesLessThanItsBound) {
  for (const double haze : {1.0, 10.0}) {
    atmosphere::Medium medium = green_medium();
    medium.bands[0].aerosol_scattering_per_km *= haze;
    medium.bands[0].aerosol_extinction_per_km *= haze;
    const Settings whole = settings_for(Level::draft, medium);
    const Twin full = twin_of(medium, whole);
    for (const Length height : {0 * km, 400 * km})
      for (const double sun : {50.0, 85.0, 94.0, 107.0}) {
        const Settings part =
            restricted_to(sun_range_for(medium, sun * deg, sun * deg, height), whole, medium);
        if (height < 400 * km) {
          EXPECT_LT(part.suns, whole.suns);
        }
        EXPECT_LT(distance(slice_of(twin_of(medium, part), height, sun * deg),
                           slice_of(full, height, sun * deg)),
                  kPartialTablesError)
            << height.in(km) << " km, sun " << sun << ", haze " << haze;
      }
  }
}

TEST(HalfSource, IsRoundedByLessThanItSays) {
  const atmosphere::Medium medium = atmosphere::reference_medium();
  const Tables tables = precompute_twin(medium, settings_for(Level::draft, medium));
  const Tables half = rounded_to_half(tables);
  for (size_t g = 0; g < tables.source.size(); ++g) {
    float brightest[4] = {};
    for (size_t i = 0; i < tables.source[g].size(); ++i)
      brightest[i % 4] = std::max(brightest[i % 4], tables.source[g][i]);
    for (size_t i = 0; i < tables.source[g].size(); ++i) {
      const double value = tables.source[g][i];
      ASSERT_LE(std::abs(half.source[g][i] - value),
                std::max(std::ldexp(value, -11), std::ldexp(double(brightest[i % 4]), -38)));
    }
  }
  EXPECT_EQ(half.ground_irradiance, tables.ground_irradiance);
}

TEST(HalfSource, ChangesTheSkyByThreeDigitsDownToTheEndOfTwilight) {
  const atmosphere::Medium medium = green_medium();
  const Tables tables = precompute_twin(medium, settings_for(Level::draft, medium));
  const Twin exact(std::make_shared<const Tables>(tables));
  const Twin half(std::make_shared<const Tables>(rounded_to_half(tables)));
  // 2^-11, halved where many samples are averaged; nothing is lost in the dark.
  for (const double sun : {0.0, 60.0, 90.0, 98.0, 108.0})
    EXPECT_LT(distance(slice_of(half, 0 * km, sun * deg), slice_of(exact, 0 * km, sun * deg)),
              4.9e-4)
        << sun;
}

TEST(Components, AirWithoutAerosolNeedsHarmonicsOfDegreeTwoAlone) {
  atmosphere::Medium medium = green_medium();
  medium.bands[0].aerosol_scattering_per_km = medium.bands[0].aerosol_extinction_per_km = 0;
  const Settings settings = settings_for(Level::draft, medium);
  EXPECT_EQ(settings.harmonics, 2);
  Settings more = settings;
  more.harmonics = 8;
  for (const double sun : {30.0, 94.0})
    EXPECT_LT(distance(slice_of(twin_of(medium, settings), 1 * km, sun * deg),
                       slice_of(twin_of(medium, more), 1 * km, sun * deg)),
              1e-6);  // tables are rounded to float
}

TEST(Components, OfNoneTheProfileDoesNotMatter) {
  atmosphere::Medium none = green_medium();
  none.bands[0].aerosol_scattering_per_km = none.bands[0].aerosol_extinction_per_km = 0;
  none.bands[0].ozone_absorption_per_km = 0;
  atmosphere::Medium bare = none;
  bare.aerosol = bare.ozone = {};
  EXPECT_EQ(slice_of(single_scattering_twin(none), 1 * km, 60 * deg).smooth,
            slice_of(single_scattering_twin(bare), 1 * km, 60 * deg).smooth);
}

TEST(AerialPerspective, LeftOutLeavesTheGroundAloneBelowTheHorizon) {
  const Twin twin = make_twin(green_medium());
  const SliceGrid grid = slice_grid(twin.medium(), 3 * km, 5, 16);
  const SkySlice with = twin.slice(3 * km, 50 * deg, grid, {.ground = true});
  const SkySlice without =
      twin.slice(3 * km, 50 * deg, grid, {.ground = true, .aerial_perspective = false});
  const size_t half = size_t(grid.azimuths) * grid.zeniths / 2;
  for (size_t i = 0; i < half; ++i) EXPECT_EQ(with.smooth[i], without.smooth[i]);
  // The nadir: a Lambert ground in sun and sky, its radiance known from the irradiance on it.
  const Twin::Irradiance light = twin.irradiance(0 * km, 50 * deg);
  const double ground = (light.sun[0] + light.sky[0]) * twin.medium().bands[0].ground_albedo / kPi *
                        twin.medium().bands[0].xyz_weight.y;
  EXPECT_NEAR(without.smooth.back().y, ground, 0.005 * ground);
  for (size_t i = half; i < without.smooth.size(); ++i) EXPECT_EQ(without.aerosol[i].y, 0);
}

TEST(IrradianceSlice, IsEnoughForTheIrradianceOfTheSky) {
  const Twin twin = make_twin(green_medium());
  for (const Length height : {0.002 * km, 11 * km})
    for (const double sun : {0.0, 50.0, 88.0, 94.0, 99.0}) {
      const auto light = [&](const SliceGrid& grid) {
        return horizontal_irradiance_xyz(refined(twin.slice(height, sun * deg, grid,
                                                            {.window = irradiance_window(grid)})))
            .y;
      };
      const double small = light(irradiance_grid(twin.medium(), height));
      const double large = light(slice_grid(twin.medium(), height, 64, 192));
      EXPECT_NEAR(small / large, 1, kIrradianceSliceError) << height.in(km) << ", " << sun;
    }
}

}  // namespace
}  // namespace skylapse::sky::bruneton
