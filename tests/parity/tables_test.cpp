// Tables in float on GL against tables in double from the same physics text.
#include <gmock/gmock.h>

#include <cmath>

#include "parity/twins.h"
#include "sky/bruneton/sun_range.h"

namespace skylapse::sky::bruneton {
namespace {

/// Greatest distance relative to the brightest value under the same sun at the same height, over
/// all suns under which that is above 1e-6 of the brightest of `day`, tables of all suns: the share
/// of the night below is the limit of float, whose error of 6e-8 in an angle moves the steepest
/// twilight as much.
double source_distance(const Tables& a, const Tables& b, const Tables& day) {
  double worst = 0;
  const size_t row = size_t(4) * b.settings.table_azimuths, rows = b.settings.sun_rows();
  const size_t zeniths = b.settings.table_zeniths;
  for (size_t g = 0; g < b.source.size(); ++g) {
    const float brightest = *std::max_element(day.source[g].begin(), day.source[g].end());
    for (size_t h = 0; h < size_t(b.settings.heights); ++h)
      for (size_t j = 0; j < rows; ++j) {
        double scale = 0, distance = 0;
        for (size_t z = 0; z < zeniths; ++z)
          for (size_t i = 0; i < row; ++i) {
            const size_t at = ((h * zeniths + z) * rows + j) * row + i;
            scale = std::max(scale, double(b.source[g][at]));
            distance = std::max(distance, std::abs(double(a.source[g][at]) - b.source[g][at]));
          }
        if (scale > 1e-6 * brightest) worst = std::max(worst, distance / scale);
      }
  }
  return worst;
}

double ground_distance(const Tables& a, const Tables& b, const Tables& day) {
  double worst = 0;
  for (size_t g = 0; g < b.ground_irradiance.size(); ++g) {
    const auto& ground = b.ground_irradiance[g];
    const float brightest =
        *std::max_element(day.ground_irradiance[g].begin(), day.ground_irradiance[g].end());
    for (size_t i = 0; i < ground.size(); ++i)
      if (ground[i] > 1e-6f * brightest)
        worst = std::max(worst, std::abs(double(a.ground_irradiance[g][i]) / ground[i] - 1));
  }
  return worst;
}

void expect_alike(const Tables& gl, const Tables& twin, const Tables& day) {
  ASSERT_EQ(gl.source.size(), twin.source.size());
  ASSERT_EQ(gl.source[0].size(), twin.source[0].size());
  EXPECT_EQ(gl.orders, twin.orders);
  // Some hundred float operations lie between the medium and a texel, 6e-8 each; llvmpipe's
  // exponential and logarithm are good to about 1e-6, which moves the sun rows of twilight. Seen:
  // up to 6e-5; other drivers may round otherwise.
  EXPECT_LT(source_distance(gl, twin, day), 2e-4);
  EXPECT_LT(ground_distance(gl, twin, day), 2e-4);
  ASSERT_EQ(gl.tail_ratio.size(), twin.medium.bands.size());
  for (size_t b = 0; b < twin.tail_ratio.size(); ++b) {
    EXPECT_NEAR(gl.tail_ratio[b], twin.tail_ratio[b], 1e-4);
    EXPECT_NEAR(gl.last_addition[b], twin.last_addition[b], 1e-4);
  }
}

void expect_alike(const Tables& gl, const Tables& twin) { expect_alike(gl, twin, twin); }

using AnyTables = gpu::AnyContext;

TEST_P(AnyTables, OfTheReferenceMediumAreTheTwins) {
  const Tables& twin = *reference_tables();
  expect_alike(value_of(precompute(*context_, twin.medium, twin.settings)), twin);
}

TEST_P(AnyTables, OfOddSizesAndTwoRangesOfGroupsAreTheTwins) {
  const atmosphere::Medium medium = standard_medium(18);
  expect_alike(value_of(precompute(*context_, medium, odd_settings())),
               precompute_twin(medium, odd_settings()));
}

TEST_P(AnyTables, OfAPartOfTheSunsAreTheTwins) {
  const atmosphere::Medium medium = standard_medium(5);
  const Tables day = precompute_twin(medium, odd_settings());
  for (const auto& [low, high] : {std::pair{20, 50}, {84, 97}, {100, 180}}) {
    const Settings part = restricted_to({low * deg, high * deg}, odd_settings(), medium);
    ASSERT_LT(part.suns, odd_settings().suns);
    expect_alike(value_of(precompute(*context_, medium, part)), precompute_twin(medium, part), day);
  }
}

TEST_P(AnyTables, OfAGivenNumberOfOrdersAreTheTwins) {
  Settings settings = odd_settings();
  for (const int orders : {2, 4}) {
    settings.orders = orders;
    const Tables gl = value_of(precompute(*context_, standard_medium(3), settings));
    EXPECT_EQ(gl.orders, orders);
    expect_alike(gl, precompute_twin(standard_medium(3), settings));
  }
}

TEST_P(AnyTables, OfMoreHeightsThanATextureIsDeepAreTheTwins) {
  Settings settings = odd_settings();
  settings.heights = 43;
  settings.table_zeniths = context_->info().max_texture_3d / 40;
  ASSERT_GT(settings.heights * settings.table_zeniths, context_->info().max_texture_3d);
  const atmosphere::Medium medium = atmosphere::reference_medium();
  const Tables twin = precompute_twin(medium, settings);
  expect_alike(value_of(precompute(*context_, medium, settings)), twin);
  const auto model = GpuModel::create(context_, twin);
  ASSERT_TRUE(model.ok()) << model.error().message;
  const Query query{2 * km, 40 * deg, 70 * deg, 50 * deg};
  EXPECT_NEAR(
      value_of(model->answer({query}))[0].radiance[0],
      Twin(std::make_shared<const Tables>(twin)).answer(query, {.ground = true}).radiance[0], 1e-6);
}

TEST_P(AnyTables, OfThickAirOverAWhiteGroundAreTheTwins) {
  atmosphere::Medium medium = atmosphere::reference_medium();
  for (atmosphere::SpectralBand& band : medium.bands) {
    band.aerosol_scattering_per_km *= 40;
    band.aerosol_extinction_per_km *= 40;
    band.ground_albedo = 1;
  }
  expect_alike(value_of(precompute(*context_, medium, odd_settings())),
               precompute_twin(medium, odd_settings()));
}

TEST_P(AnyTables, OfNoAirAreDark) {
  atmosphere::Medium medium = atmosphere::reference_medium();
  for (atmosphere::SpectralBand& band : medium.bands)
    band.rayleigh_scattering_per_km = band.aerosol_scattering_per_km =
        band.aerosol_extinction_per_km = band.ozone_absorption_per_km = 0;
  const Tables tables = value_of(precompute(*context_, medium, odd_settings()));
  for (const float value : tables.source[0]) ASSERT_TRUE(std::isfinite(value) && value >= 0);
  for (const float value : tables.ground_irradiance[0]) ASSERT_EQ(value, 0);
}

TEST_P(AnyTables, ReportTheirProgress) {
  std::vector<double> shares;
  value_of(precompute(*context_, standard_medium(18), odd_settings(), [&](double share) {
    shares.push_back(share);
    return true;
  }));
  ASSERT_GE(shares.size(), 4u);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_DOUBLE_EQ(shares.back(), 1);
}

TEST_P(AnyTables, StopWhenTheProgressSaysSo) {
  const auto tables =
      precompute(*context_, standard_medium(3), odd_settings(), [](double) { return false; });
  ASSERT_FALSE(tables.ok());
  EXPECT_EQ(tables.error().code, ErrorCode::interrupted);
}

SKYLAPSE_ON_EVERY_CONTEXT(AnyTables);

TEST(TablesParity, EglAndOsMesaComputeTheSameBits) {
  const auto egl = gpu::test_context(gpu::Backend::egl),
             osmesa = gpu::test_context(gpu::Backend::osmesa);
  ASSERT_TRUE(egl && osmesa);
  const atmosphere::Medium medium = standard_medium(5);
  const Tables a = value_of(precompute(*egl, medium, odd_settings()));
  const Tables b = value_of(precompute(*osmesa, medium, odd_settings()));
  if (egl->info().renderer == osmesa->info().renderer) {
    EXPECT_EQ(a.source, b.source);
    EXPECT_EQ(a.ground_irradiance, b.ground_irradiance);
  } else {
    expect_alike(a, b);
  }
}

TEST(TablesParity, TwoRunsComputeTheSameBits) {
  const auto context = gpu::test_context(gpu::Backend::egl);
  ASSERT_TRUE(context);
  const atmosphere::Medium medium = standard_medium(4);
  EXPECT_EQ(value_of(precompute(*context, medium, odd_settings())).source,
            value_of(precompute(*context, medium, odd_settings())).source);
}

}  // namespace
}  // namespace skylapse::sky::bruneton
