// Tables, their settings and their mixtures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bruneton/twins.h"

namespace skylapse::sky::bruneton {
namespace {

TEST(Precomputation, IsDeterministic) {
  const atmosphere::Medium medium = green_medium();
  const Settings settings = settings_for(Level::draft, medium);
  const Tables a = precompute_twin(medium, settings), b = precompute_twin(medium, settings);
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.ground_irradiance, b.ground_irradiance);
}

TEST(Precomputation, DoesNotDependOnTheOrderOfTheBands) {
  atmosphere::Medium medium = atmosphere::reference_medium();
  medium.bands.insert(medium.bands.end(), {medium.bands[2], medium.bands[0]});
  medium.bands[3].ground_albedo = 0.4;
  medium.bands[4].aerosol_scattering_per_km *= 0.5;
  atmosphere::Medium reversed = medium;
  std::reverse(reversed.bands.begin(), reversed.bands.end());
  const Settings settings = settings_for(Level::draft, medium);
  const Tables a = precompute_twin(medium, settings), b = precompute_twin(reversed, settings);
  ASSERT_EQ(a.source.size(), 2u);
  for (size_t band = 0; band < 5; ++band) {
    const std::vector<float>&there = a.source[band / 4], &back = b.source[(4 - band) / 4];
    for (size_t i = 0; i < there.size(); i += 4)
      ASSERT_NEAR(there[i + band % 4], back[i + (4 - band) % 4], 1e-6f * there[i + band % 4])
          << band;
  }
}

TEST(Precomputation, SourcesAreNeverNegativeAndEndInDarkness) {
  const atmosphere::Medium medium = atmosphere::reference_medium();
  const Tables tables = precompute_twin(medium, settings_for(Level::draft, medium));
  for (const std::vector<float>& group : tables.source)
    for (const float value : group) ASSERT_GE(value, 0);
  const size_t rows = tables.settings.sun_rows(), texels = 4 * tables.settings.table_azimuths;
  for (size_t slab = 0; slab < tables.source[0].size() / (rows * texels); ++slab)
    for (size_t i = 0; i < texels; ++i)
      ASSERT_EQ(tables.source[0][(slab * rows + rows - 1) * texels + i], 0);
}

TEST(Precomputation, OfOddSizesAgreesWithTheLevels) {
  // Sizes that no loop is made for: a slip in a stride shows.
  const atmosphere::Medium medium = green_medium();
  Settings odd = settings_for(Level::low, medium);
  odd.heights = 17, odd.suns = 41, odd.sun_rows_per_interval = 3;
  odd.directions_up = 13, odd.directions_down = 7, odd.azimuths = 11;
  odd.table_azimuths = 11, odd.table_zeniths = 23;
  const Twin twin(std::make_shared<const Tables>(precompute_twin(medium, odd)));
  const Twin low = make_twin(medium, Level::low);
  for (const double sun : {20.0, 70.0, 90.0})
    for (const double view : {0.0, 60.0, 89.0, 120.0}) {
      const Query query{1 * km, sun * deg, view * deg, 50 * deg};
      EXPECT_NEAR(twin.answer(query).radiance[0] / low.answer(query).radiance[0], 1, 0.01)
          << sun << ' ' << view;
    }
}

TEST(Blend, OfTablesIsTheirMeanAndKeepsTheEnds) {
  const atmosphere::Medium clear = green_medium();
  atmosphere::Medium hazy = clear;
  hazy.bands[0].aerosol_extinction_per_km *= 3;
  hazy.bands[0].aerosol_scattering_per_km *= 3;
  const Settings settings = settings_for(Level::draft, clear);
  const Tables a = precompute_twin(clear, settings), b = precompute_twin(hazy, settings);
  EXPECT_EQ(blend(a, b, 0, clear).source, a.source);
  EXPECT_EQ(blend(a, b, 1, hazy).source, b.source);
  const Tables half = blend(a, b, 0.5, clear);
  EXPECT_EQ(atmosphere::canonical_text(half.medium), atmosphere::canonical_text(clear));
  for (size_t i = 0; i < half.source[0].size(); i += 997)
    ASSERT_NEAR(half.source[0][i], 0.5f * (a.source[0][i] + b.source[0][i]),
                1e-6f * half.source[0][i]);
}

TEST(Settings, HaveNamesAndATextOfTheirOwn) {
  EXPECT_EQ(level_names(), (std::vector<std::string>{"draft", "low", "standard", "fine"}));
  EXPECT_EQ(name_of(Level::standard), "standard");
  Settings a, b;
  EXPECT_EQ(canonical_text(a), canonical_text(b));
  b.stop_below = std::nextafter(b.stop_below, 1);
  EXPECT_NE(canonical_text(a), canonical_text(b));
}

TEST(Settings, FollowTheMedium) {
  const atmosphere::Medium clear = green_medium();
  atmosphere::Medium forward = clear, thick = clear, white = clear;
  forward.aerosol_g = 0.95;
  thick.bands[0].aerosol_extinction_per_km *= 440;
  thick.bands[0].aerosol_scattering_per_km *= 440;
  white.bands[0].ground_albedo = 1;
  for (const Level level : {Level::low, Level::standard, Level::fine}) {
    const Settings base = settings_for(level, clear);
    EXPECT_GT(settings_for(level, forward).harmonics, base.harmonics);
    EXPECT_GT(settings_for(level, thick).heights, base.heights);
    EXPECT_LE(settings_for(level, thick).stop_below, 0.01);
    EXPECT_LE(settings_for(level, white).stop_below, 0.01);
  }
}

}  // namespace
}  // namespace skylapse::sky::bruneton
