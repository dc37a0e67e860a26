#include "image/diff/measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/parallel.h"
#include "image/diff/sky_rows.h"
#include "image/irradiance.h"
#include "image/lighting/harmonics.h"
#include "image/sample_cameras.h"

namespace skylapse::image {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

using Colour = std::function<glm::vec3(int x, int y)>;

Picture picture_of(int width, int height, const Colour& colour) {
  Picture p;
  p.width = width, p.height = height, p.channels = {"R", "G", "B"};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const glm::vec3 c = colour(x, y);
      p.samples.insert(p.samples.end(), {c.r, c.g, c.b});
    }
  return p;
}

/// A sky with a blue gradient, an aureole and a disc.
Picture sky(int width = 128, int height = 64, double sun_x = 90.5, double sun_y = 20.5) {
  return picture_of(width, height, [&](int x, int y) {
    const double d = std::pow(x + 0.5 - sun_x, 2) + std::pow(y + 0.5 - sun_y, 2);
    const double disc = 5000 * std::clamp(3.5 - std::sqrt(d), 0.0, 1.0);
    const double glow = 5 / (1 + d / 60), v = double(y) / height;
    return glm::vec3(0.2 + 0.5 * v * v + glow + disc, 0.35 + 0.45 * v + glow + 0.95 * disc,
                     0.8 + 0.2 * v + glow + 0.85 * disc);
  });
}

Picture changed(Picture p, const std::function<void(float* rgb, int x, int y)>& change) {
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x)
      change(p.samples.data() + (size_t(y) * p.width + x) * p.channels.size(), x, y);
  return p;
}

double value(const Comparison& c, const std::string& name) {
  for (const Measure& m : c.measures)
    if (m.name == name) return m.value;
  return std::numeric_limits<double>::quiet_NaN();
}

SkyView map_view(const Picture& p, double sun_x, double sun_y) {
  SkyView view;
  view.camera = make_camera(Projection::lat_long, p.width, p.height, {});
  view.sun = direction_at(*view.camera, {sun_x, sun_y});
  return view;
}

TEST(Compare, TheSamePictureHasNoErrorAnywhere) {
  const Picture a = sky();
  const Comparison c = compare(a, a, map_view(a, 90.5, 20.5));
  EXPECT_TRUE(c.identical);
  EXPECT_EQ(c.hash_a, c.hash_b);
  for (const Measure& m : c.measures) EXPECT_EQ(m.value, 0) << m.name;
  EXPECT_EQ(*std::max_element(c.error.begin(), c.error.end()), 0);
}

TEST(Compare, AGainIsTheErrorOfEveryMeasure) {
  const Picture a = sky();
  const double gain = 0.02;
  const Picture b = changed(a, [&](float* p, int, int) {
    for (int c = 0; c < 3; ++c) p[c] = float(p[c] * (1 + gain));
  });
  const CompareOptions options{.rgb_to_xyz = glm::dmat3(1), .psnr_peak = {}};
  const Comparison c = compare(a, b, map_view(a, 90.5, 20.5), options);
  // (b - a) / b, to the rounding of float; percentiles to the width of a bin.
  const double e = gain / (1 + gain);
  for (const char* name :
       {"relative.max", "relative.rms", "relative.bias", "relative.block_rms", "relative.row_rms",
        "relative.column_rms", "relative.weighted_rms", "relative.region.sky.bias",
        "relative.region.horizon.rms", "irradiance", "harmonics"})
    EXPECT_NEAR(value(c, name), e, 2e-6) << name;
  EXPECT_NEAR(value(c, "relative.p50"), e, 0.023 * e);
  EXPECT_NEAR(value(c, "sun.flux"), e, 1e-5);
  EXPECT_LT(value(c, "sun.shift_px"), 1e-3);
  EXPECT_LT(value(c, "chromaticity"), 1e-6);
  EXPECT_TRUE(std::isnan(value(c, "position.shift_px"))) << "a gain is no move";
  EXPECT_NEAR(value(c, "exposure.shift_ev"), std::log2(1 + gain), 1e-5);
  EXPECT_NEAR(value(compare(b, a, {}), "exposure.shift_ev"), -std::log2(1 + gain), 1e-5);
}

TEST(Compare, IsSymmetric) {
  const Picture a = sky(), b = sky(128, 64, 91.0, 20.2);
  const SkyView view = map_view(a, 90.5, 20.5);
  const Comparison ab = compare(a, b, view), ba = compare(b, a, view);
  for (const char* name : {"relative.max", "relative.rms", "relative.bias", "relative.block_rms",
                           "irradiance", "harmonics", "absolute.max"})
    EXPECT_NEAR(value(ab, name), value(ba, name), 1e-9 + 1e-6 * value(ab, name)) << name;
}

TEST(Compare, DoesNotDependOnTheNumberOfThreads) {
  const Picture a = sky(300, 150), b = sky(300, 150, 91, 20.6);
  const SkyView view = map_view(a, 90.5, 20.5);
  const Comparison many = compare(a, b, view);
  const ThreadLimit limit(1);
  const Comparison one = compare(a, b, view);
  ASSERT_EQ(one.measures.size(), many.measures.size());
  for (size_t i = 0; i < one.measures.size(); ++i)
    EXPECT_EQ(one.measures[i].value, many.measures[i].value) << one.measures[i].name;
  EXPECT_EQ(one.error, many.error);
}

TEST(Compare, SaysWhereTheWorstPixelIs) {
  const Picture a = sky();
  const Picture b = changed(a, [](float* p, int x, int y) {
    if (x == 17 && y == 41) p[1] *= 1.1F;
  });
  const Comparison c = compare(a, b, {});
  const auto worst = std::find_if(c.measures.begin(), c.measures.end(),
                                  [](const Measure& m) { return m.name == "relative.max"; });
  ASSERT_TRUE(worst != c.measures.end() && worst->place);
  EXPECT_EQ(worst->place->x, 17);
  EXPECT_EQ(worst->place->y, 41);
  EXPECT_EQ(worst->place->channel, 1);
}

TEST(Compare, GroupsSeeWhatTheWholeDoesNot) {
  const Picture a = sky();
  const auto seam = [&](auto where) {
    return compare(a,
                   changed(a,
                           [&](float* p, int x, int y) {
                             if (where(x, y))
                               for (int c = 0; c < 3; ++c) p[c] *= 1.01F;
                           }),
                   {});
  };
  const Comparison column = seam([](int x, int) { return x == 0; });
  EXPECT_NEAR(value(column, "relative.column_rms"), 0.0099, 1e-4);
  EXPECT_LT(value(column, "relative.rms"), 0.001);
  const Comparison row = seam([](int, int y) { return y == 33; });
  EXPECT_NEAR(value(row, "relative.row_rms"), 0.0099, 1e-4);
  const Comparison tile = seam([](int x, int y) { return x / 8 == 3 && y / 8 == 5; });
  EXPECT_NEAR(value(tile, "relative.block_rms"), 0.0099, 1e-4);
  EXPECT_LT(value(tile, "relative.rms"), 0.001);
}

TEST(Compare, NotANumberIsCountedAndSpoilsNothingElse) {
  const Picture a = sky();
  const Picture b = changed(a, [](float* p, int x, int y) {
    if (x == 5 && y == 7) p[0] = kNan;
    if (x == 6 && y == 7) p[2] = kInf;
    if (x == 7 && y == 7) p[1] = -1;
  });
  const Comparison c = compare(a, b, map_view(a, 90.5, 20.5));
  EXPECT_EQ(c.odd.nan_b, 1u);
  EXPECT_EQ(c.odd.nan_only_one, 1u);
  EXPECT_EQ(c.odd.infinite_only_one, 1u);
  EXPECT_EQ(c.odd.new_negative, 1u);
  ASSERT_TRUE(c.odd.first_nan);
  EXPECT_EQ(c.odd.first_nan->x, 5);
  EXPECT_EQ(c.odd.first_nan->channel, 0);
  EXPECT_EQ(c.error[size_t(7) * 128 + 5], kInf);
  EXPECT_FALSE(c.identical);
  for (const Measure& m : c.measures) EXPECT_TRUE(std::isfinite(m.value)) << m.name;
}

TEST(Compare, NotANumberInBothIsNoDifference) {
  const Picture a = changed(sky(), [](float* p, int x, int) {
    if (x == 3) p[0] = kNan, p[1] = -kInf;
  });
  const Comparison c = compare(a, a, {});
  EXPECT_TRUE(c.identical);
  EXPECT_EQ(c.odd.nan_only_one, 0u);
  EXPECT_EQ(c.odd.infinite_only_one, 0u);
  EXPECT_EQ(c.odd.nan_a, 64u);
}

TEST(Compare, ChannelsBesideAnInfiniteOneAreCompared) {
  const Picture a = changed(sky(), [](float* p, int, int) {
    if (p[0] > 1000) p[0] = kInf;
  });
  const Picture b = changed(a, [](float* p, int, int) {
    if (p[0] == kInf) p[1] = p[2] = 6.5F;
  });
  const Comparison c = compare(a, b, {});
  EXPECT_FALSE(c.identical);
  EXPECT_GT(value(c, "relative.max"), 0.99);
}

TEST(Compare, AllNotANumberHasNoMeasuresOfErrors) {
  const Picture a = picture_of(9, 5, [](int, int) { return glm::vec3(0.5F); });
  const Picture b = picture_of(9, 5, [](int, int) { return glm::vec3(kNan); });
  const Comparison c = compare(a, b, {});
  EXPECT_EQ(c.odd.nan_only_one, 9u * 5 * 3);
  EXPECT_TRUE(std::isnan(value(c, "relative.max")));
}

TEST(Compare, BlackZerosAndDenormalsAreTheSameDark) {
  const Picture black = picture_of(32, 16, [](int, int) { return glm::vec3(0); });
  const Picture minus = picture_of(32, 16, [](int, int) { return glm::vec3(-0.0F); });
  const Picture denormal = picture_of(32, 16, [](int, int) { return glm::vec3(1e-39F); });
  EXPECT_TRUE(compare(black, minus, {}).identical);
  EXPECT_LT(value(compare(black, denormal, {}), "relative.max"), 1e-4);
  for (const Measure& m : compare(black, denormal, map_view(black, 20.5, 5.5)).measures)
    EXPECT_LT(m.value, 1e-4) << m.name;
  const Picture lit = picture_of(32, 16, [](int, int) { return glm::vec3(1e-6F); });
  EXPECT_EQ(value(compare(black, lit, {}), "relative.max"), 1) << "light where there was none";
}

TEST(Compare, UnitsDoNotMatter) {
  const Picture a = sky();
  const auto scaled = [&](float unit, float gain) {
    return changed(a, [&](float* p, int, int) {
      for (int c = 0; c < 3; ++c) p[c] *= unit * gain;
    });
  };
  for (const float unit : {1e-20F, 1e-6F, 1e6F, 1e30F}) {
    const Comparison c = compare(scaled(unit, 1), scaled(unit, 1.02F), {});
    EXPECT_NEAR(value(c, "relative.rms"), 0.02 / 1.02, 1e-5) << unit;
  }
}

TEST(Compare, AMissingStarIsSeenOnABlackSky) {
  const auto stars = [](int x, int y, bool all) {
    const bool star = (x * 37 + y * 59) % 97 == 0 && (all || !(x == 0 && y == 0));
    return glm::vec3(star ? 0.1F : 0.0F);
  };
  const Picture a = picture_of(64, 64, [&](int x, int y) { return stars(x, y, true); });
  const Picture b = picture_of(64, 64, [&](int x, int y) { return stars(x, y, false); });
  EXPECT_EQ(value(compare(a, b, {}), "relative.max"), 1);
}

TEST(Compare, AFaintChannelDoesNotCountByItself) {
  // Out of gamut by a rounding error: red is nearly nothing beside blue.
  const Picture a = picture_of(16, 16, [](int, int) { return glm::vec3(1e-6F, 0.3F, 0.9F); });
  const Picture b = picture_of(16, 16, [](int, int) { return glm::vec3(-1e-6F, 0.3F, 0.9F); });
  const Comparison c = compare(a, b, {});
  EXPECT_LT(value(c, "relative.max"), 3e-5);
  EXPECT_EQ(c.odd.new_negative, 0u);
}

TEST(Compare, TwoHugeSunsOfOtherSignAreFinite) {
  const Picture a = picture_of(4, 4, [](int, int) { return glm::vec3(3e38F); });
  const Picture b = picture_of(4, 4, [](int, int) { return glm::vec3(-3e38F); });
  const Comparison c = compare(a, b, {});
  EXPECT_EQ(value(c, "relative.max"), 2);
  for (const Measure& m : c.measures) EXPECT_TRUE(std::isfinite(m.value)) << m.name;
}

TEST(Compare, OnePixelAndThinPicturesHaveAnswers) {
  for (const auto& [w, h] :
       {std::pair(1, 1), std::pair(1, 40), std::pair(40, 1), std::pair(5, 3)}) {
    const Picture a = picture_of(w, h, [](int, int) { return glm::vec3(0.5F); });
    const Picture b = picture_of(w, h, [](int, int) { return glm::vec3(0.501F); });
    const Comparison c = compare(a, b, {});
    EXPECT_NEAR(value(c, "relative.max"), 0.001 / 0.501, 1e-6);
    EXPECT_NEAR(value(c, "relative.rms"), 0.001 / 0.501, 1e-6);
  }
}

TEST(Compare, DisplayPicturesCountCodeValues) {
  Picture a = picture_of(16, 16, [](int, int) { return glm::vec3(0.0F, 0.5F, 1.0F); });
  a.display_referred = true, a.storage = {SampleStorage::Kind::integer, 8, false};
  const Picture b = changed(a, [](float* p, int x, int y) {
    if (x == 3 && y == 4) p[0] += 3.0F / 255;
  });
  EXPECT_NEAR(value(compare(a, b, {}), "display.max"), 3, 1e-5);
  EXPECT_NEAR(value(compare(a, b, {}), "absolute.max"), 3, 1e-5);
}

TEST(Compare, NeighbouringHalvesAreRoundingAndFloatsAreNot) {
  const float one = 0.75F, next = one + std::ldexp(1.0F, -11);
  Picture a = picture_of(8, 8, [&](int, int) { return glm::vec3(one); });
  Picture b = picture_of(8, 8, [&](int, int) { return glm::vec3(next); });
  EXPECT_GT(value(compare(a, b, {}), "relative.max"), 6e-4);
  a.storage = b.storage = {SampleStorage::Kind::half_float, 16, false};
  const Comparison halves = compare(a, b, {});
  EXPECT_EQ(value(halves, "relative.max"), 0);
  EXPECT_GT(value(halves, "relative.bias"), 6e-4) << "all of them to one side is no rounding";
}

TEST(Compare, RoundingToRgbeIsNoBiasOfOnePixelButIsOneOfMany) {
  const float step = std::ldexp(1.0F, -8);  // last place of 0.5 .. 1
  const auto bias = [&](int size) {
    Picture a = picture_of(size, size, [](int, int) { return glm::vec3(0.75F, 0.5F, 0.06F); });
    Picture b = changed(a, [&](float* p, int, int) { p[2] += 0.49F * step; });
    b.storage = {SampleStorage::Kind::rgbe, 8, false};
    return value(compare(a, b, {}), "relative.bias");
  };
  EXPECT_EQ(bias(1), 0);
  EXPECT_GT(bias(64), 0.9 * 0.49 * step / 0.075) << "all of them to one side is no rounding";
}

TEST(Compare, ChannelsThatAreNoColoursCountByThemselves) {
  Picture a = picture_of(8, 8, [](int, int) { return glm::vec3(1); });
  a.channels = {"R", "G", "B", "Z"};
  a.samples.assign(size_t(8) * 8 * 4, 1.0F);
  Picture b = a;
  b.samples[3] = 1.5F;
  const Comparison c = compare(a, b, {});
  EXPECT_NEAR(value(c, "relative.other_channels"), 1.0 / 3, 1e-6);
  EXPECT_EQ(value(c, "absolute.max"), 0);
}

TEST(Compare, LightAgreesWithTheSumsOverTheMap) {
  const Picture a = sky(256, 128), b = sky(256, 128, 120.5, 50.5);
  const SkyView view = map_view(a, 90.5, 20.5);
  FrameBuffer fa(256, 128), fb(256, 128);
  fa.data() = a.samples, fb.data() = b.samples;
  const glm::dvec3 ea = image_irradiance(*view.camera, fa), eb = image_irradiance(*view.camera, fb);
  double expected = 0;
  for (int c = 0; c < 3; ++c)
    expected = std::max(expected, std::fabs(eb[c] - ea[c]) / std::max(ea[c], eb[c]));
  EXPECT_NEAR(value(compare(a, b, view), "irradiance"), expected, 1e-6);
}

TEST(Displacement, OfATurnedSkyIsFoundWithoutADisc) {
  const auto twilight = [](double turn) {
    return picture_of(256, 128, [&](int x, int y) {
      const double az = 2 * std::numbers::pi * (x + 0.5 + turn) / 256, v = (y + 0.5) / 128;
      const double glow = 0.3 * std::exp(2 * std::cos(az)) * std::exp(-8 * std::pow(v - 0.5, 2));
      return glm::vec3(0.01 + glow, 0.02 + 0.8 * glow, 0.05 + 0.7 * glow);
    });
  };
  const Picture a = twilight(0);
  for (const double turn : {0.1, 0.5, 1.0, -1.0}) {
    const Comparison c = compare(a, twilight(turn), map_view(a, 10, 10));
    // A straight line for the light between pixels: a few percent of the move.
    EXPECT_NEAR(value(c, "position.right_px"), -turn, 0.05 * std::fabs(turn)) << turn;
    EXPECT_NEAR(value(c, "position.down_px"), 0, 0.02);
    EXPECT_NEAR(value(c, "position.shift_deg"), std::fabs(turn) * 360 / 256,
                0.06 * std::fabs(turn) * 360 / 256);
  }
}

TEST(Displacement, IsNotFoundInNoise) {
  const Picture a = sky();
  unsigned state = 1;
  const Picture b = changed(a, [&](float* p, int, int) {
    state = state * 1664525U + 1013904223U;
    for (int c = 0; c < 3; ++c) p[c] *= 1 + 0.02F * (float(state >> 8U) / 16777216.0F - 0.5F);
  });
  EXPECT_TRUE(std::isnan(value(compare(a, b, {}), "position.shift_px")));
}

TEST(Displacement, OfTheDiscIsMeasuredInDegrees) {
  const Picture a = sky(256, 128, 90.5, 30.5), b = sky(256, 128, 91.0, 30.5);
  const SkyView view = map_view(a, 90.5, 30.5);
  const auto from = *direction_at(*view.camera, {90.5, 30.5});
  const auto to = *direction_at(*view.camera, {91.0, 30.5});
  // The centroid of a disc with soft edges on whole pixels: to a fiftieth of a pixel.
  EXPECT_NEAR(value(compare(a, b, view), "sun.shift_px"), 0.5, 0.02);
  EXPECT_NEAR(value(compare(a, b, view), "sun.shift_deg"), separation(from, to).in(deg), 0.03);
}

TEST(Displacement, OfADiscAtTheSeamOfAMapIsMeasuredAcrossIt) {
  // The disc on either side of the edge: the map is turned by half its width and two columns.
  const auto turned = [](int columns) {
    const Picture p = sky(256, 128, 128.5, 40.5);
    return picture_of(256, 128, [&](int x, int y) {
      const float* v = p.pixel((x + 128 + columns) % 256, y);
      return glm::vec3(v[0], v[1], v[2]);
    });
  };
  const Picture a = turned(1), b = turned(-1);
  EXPECT_NEAR(value(compare(a, b, map_view(a, 255.5, 40.5)), "sun.shift_px"), 2, 0.02);
}

TEST(Displacement, AGlowIsNoDisc) {
  const auto glow = [](double x0) {
    return picture_of(64, 32, [&](int x, int y) {
      return glm::vec3(float(0.1 + 0.3 / (1 + (std::pow(x - x0, 2) + std::pow(y - 20, 2)) / 9)));
    });
  };
  const Picture a = glow(30), b = glow(33);
  EXPECT_TRUE(std::isnan(value(compare(a, b, map_view(a, 30.5, 20.5)), "sun.shift_px")));
}

TEST(Displacement, ALostDiscLosesAllItsLight) {
  const Picture a = sky(256, 128, 90.5, 30.5);
  const Picture b = changed(a, [](float* p, int, int) {
    for (int c = 0; c < 3; ++c) p[c] = std::min(p[c], 6.0F);
  });
  EXPECT_GT(value(compare(a, b, map_view(a, 90.5, 30.5)), "sun.flux"), 0.99);
}

class RowsOfCamera : public ::testing::TestWithParam<NamedCamera> {};

TEST_P(RowsOfCamera, RowsLookWhereThePixelsLook) {
  SkyView view;
  view.camera = GetParam().camera;
  view.sun = enu_direction(100 * deg, 30 * deg);
  const SkyRows rows(view);
  SkyRow row;
  for (int y = 0; y < view.camera->height; ++y) {
    rows.fill(y, row);
    for (int x = 0; x < view.camera->width; ++x) {
      const auto i = size_t(x);
      const auto d = direction_at(*view.camera, {x + 0.5, y + 0.5});
      ASSERT_EQ(d.has_value(), row.solid_angle[i] > 0) << x << ' ' << y;
      if (!d) continue;
      const double omega = pixel_solid_angle(*view.camera, x, y).in(sr);
      const double off = glm::distance(d->vec(), glm::dvec3(row.east[i], row.north[i], row.up[i]));
      ASSERT_LT(off, 0.5 * std::sqrt(omega)) << x << ' ' << y;
      bool whole = true;  // pixels on the rim of a circle count as if they were
      for (const double dx : {-0.5, 1.5})
        for (const double dy : {-0.5, 1.5})
          whole = whole && direction_at(*view.camera, {x + dx, y + dy});
      if (!whole) continue;
      ASSERT_NEAR(row.solid_angle[i], omega, 0.06 * omega) << x << ' ' << y;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(SkyRows, RowsOfCamera, ::testing::ValuesIn(sample_cameras()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace skylapse::image
