#include "sky/hosek_wilkie/model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "sky/hosek_wilkie/csv_rows.h"
#include "sky/hosek_wilkie/probe.h"

namespace skylapse::sky::hosek_wilkie {
namespace {

using test::csv_rows;
using test::CsvRow;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

ProbeQuery query_of(const CsvRow& row) {
  return {.kind = *probe_kind_from_name(row.text("kind")),
          .turbidity = row.number("turbidity"),
          .albedo = row.number("albedo"),
          .sun_elevation = row.number("sun_elevation_rad") * rad,
          .view_zenith = row.number("view_zenith_rad") * rad,
          .gamma = row.number("gamma_rad") * rad,
          .band = row.text("band")};
}

SkyParameters grey_sky(double turbidity, double albedo, Angle elevation) {
  SkyParameters parameters{turbidity, {}, elevation};
  parameters.albedo.fill(albedo);
  return parameters;
}

// 1e-9 relative leaves room for another order of summation only: the reference and we work on the
// same doubles. At the limb a square root magnifies the rounding of gamma: 1e-7 there.
TEST(HosekWilkieModel, MatchesAllPublishedRadiances) {
  const auto rows = csv_rows("hosek_wilkie/vectors.csv");
  ASSERT_EQ(rows.size(), 426u);
  for (const CsvRow& row : rows) {
    const Result<double> value = probe(query_of(row));
    ASSERT_TRUE(value.ok()) << value.error().message;
    const double expected = row.number("radiance");
    const double relative = row.text("kind").starts_with("solar") ? 1e-7 : 1e-9;
    EXPECT_NEAR(*value, expected, relative * std::abs(expected) + 1e-12)
        << row.text("kind") << " " << row.text("band") << " " << row.text("tag");
  }
}

TEST(HosekWilkieModel, InterpolatedParametersMatchAllPublishedStates) {
  const auto rows = csv_rows("hosek_wilkie/states.csv");
  ASSERT_EQ(rows.size(), 84u);
  for (const CsvRow& row : rows) {
    const std::string& name = row.text("fit");
    const Fit fit = name == "spectral" ? Fit::spectral : name == "xyz" ? Fit::xyz : Fit::rgb;
    const int item = fit == Fit::spectral
                         ? static_cast<int>((row.number("band") - 320) / 40)
                         : static_cast<int>(std::string("XYZRGB").find(row.text("band")) % 3);
    const auto patterns = make_patterns(fit, grey_sky(row.number("turbidity"), row.number("albedo"),
                                                      row.number("sun_elevation_rad") * rad));
    ASSERT_TRUE(patterns.ok()) << patterns.error().message;
    const Pattern& p = patterns->items[item];
    const std::pair<const char*, double> ours[] = {
        {"A", p.a}, {"B", p.b}, {"C", p.c}, {"D", p.d}, {"E", p.e},
        {"F", p.f}, {"G", p.g}, {"I", p.i}, {"H", p.h}, {"scale", p.scale}};
    for (const auto& [letter, value] : ours) {
      const double expected = row.number(letter);
      EXPECT_NEAR(value, expected, 1e-11 * std::abs(expected) + 1e-14) << name << " " << letter;
    }
  }
}

TEST(HosekWilkieModel, RadianceIsLinearBetweenBands) {
  const auto patterns = make_patterns(Fit::spectral, grey_sky(3.3, 0.2, 25 * deg));
  ASSERT_TRUE(patterns.ok());
  auto at = [&](double wavelength) {
    return spectral_radiance(*patterns, wavelength * nm, 50 * deg, 40 * deg).in(W_per_m2_sr_nm);
  };
  EXPECT_NEAR(at(570), 0.75 * at(560) + 0.25 * at(600), 1e-15);
  EXPECT_NEAR(at(720), radiance(patterns->items[10], 50 * deg, 40 * deg), 1e-15);
}

TEST(HosekWilkieModel, IsContinuousInTurbidityAndFiniteToTheEndsOfItsDomain) {
  for (const double turbidity : {1.0, 2.0, 5.5, 9.999999, 10.0})
    for (const double albedo : {0.0, 0.37, 1.0})
      for (const double elevation : {0.0, 0.01, 10.0, 90.0}) {
        const auto patterns =
            make_patterns(Fit::spectral, grey_sky(turbidity, albedo, elevation * deg));
        ASSERT_TRUE(patterns.ok());
        for (const double theta : {0.0, 45.0, 89.9, 90.0})
          for (const double gamma : {0.0, 90.0, 180.0})
            for (const Pattern& p : patterns->items)
              EXPECT_TRUE(std::isfinite(radiance(p, theta * deg, gamma * deg)));
      }
  const auto below = make_patterns(Fit::xyz, grey_sky(10 - 1e-9, 0.2, 30 * deg));
  const auto top = make_patterns(Fit::xyz, grey_sky(10, 0.2, 30 * deg));
  EXPECT_NEAR(radiance(below->items[1], 45 * deg, 60 * deg),
              radiance(top->items[1], 45 * deg, 60 * deg), 1e-7);
}

TEST(HosekWilkieModel, OutsideItsDomainIsAnErrorThatNamesTheRange) {
  const SkyParameters bad[] = {
      grey_sky(0.999, 0.2, 30 * deg), grey_sky(10.001, 0.2, 30 * deg),
      grey_sky(kNaN, 0.2, 30 * deg),  grey_sky(3, -0.01, 30 * deg),
      grey_sky(3, 1.01, 30 * deg),    grey_sky(3, kNaN, 30 * deg),
      grey_sky(3, 0.2, -0.01 * deg),  grey_sky(3, 0.2, 90.01 * deg),
      grey_sky(3, 0.2, kNaN * deg),
  };
  for (const SkyParameters& parameters : bad)
    for (const Fit fit : {Fit::spectral, Fit::xyz, Fit::rgb}) {
      const auto patterns = make_patterns(fit, parameters);
      ASSERT_FALSE(patterns.ok());
      EXPECT_EQ(patterns.error().code, ErrorCode::invalid_input);
      EXPECT_NE(patterns.error().hint.find("allowed"), std::string::npos);
    }
}

TEST(HosekWilkieProbe, RefusesWhatTheReferenceAnswersWithGarbage) {
  const ProbeQuery good{.kind = ProbeKind::solar_total,
                        .turbidity = 3,
                        .albedo = 0.2,
                        .sun_elevation = 30 * deg,
                        .view_zenith = 60 * deg,
                        .gamma = 0.1 * deg,
                        .band = "550"};
  ASSERT_TRUE(probe(good).ok());
  auto refused = [&](auto change) {
    ProbeQuery query = good;
    change(query);
    return !probe(query).ok();
  };
  EXPECT_TRUE(refused([](ProbeQuery& q) { q.view_zenith = 90.1 * deg; }));
  EXPECT_TRUE(refused([](ProbeQuery& q) { q.view_zenith = kNaN * deg; }));
  EXPECT_TRUE(refused([](ProbeQuery& q) { q.gamma = 180.1 * deg; }));
  EXPECT_TRUE(refused([](ProbeQuery& q) { q.turbidity = 0.5; }));
  EXPECT_TRUE(refused([](ProbeQuery& q) { q.sun_elevation = -0.1 * deg; }));
  for (const char* band : {"319.9", "720.1", "X", "", "nan", "550nm"})
    EXPECT_TRUE(refused([&](ProbeQuery& q) { q.band = band; })) << band;
}

TEST(HosekWilkieModel, ChannelAlbedoOfAGreyGroundIsThatGrey) {
  for (const Fit fit : {Fit::xyz, Fit::rgb})
    for (const double channel : channel_albedo(fit, grey_bands(0.37)))
      EXPECT_NEAR(channel, 0.37, 1e-12);
}

}  // namespace
}  // namespace skylapse::sky::hosek_wilkie
