// OpenColorIO displays and views through the loaded module.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <thread>

#include "color/rgb_space.h"
#include "output/image_fixture.h"

namespace skylapse::output {
namespace {

using testing::HasSubstr;

std::array<float, 3> shown(const DisplayRequest& request, std::array<float, 3> rgb) {
  const auto transform = image_io().display(request);
  if (!transform) {
    ADD_FAILURE() << format_error(transform.error());
    return {};
  }
  (*transform)->apply(rgb.data(), 1);
  return rgb;
}

float srgb_code(double linear) {  // IEC 61966-2-1
  return static_cast<float>(linear <= 0.0031308 ? 12.92 * linear
                                                : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

constexpr float kQuarterCode = 0.25f / 255.0f;

class Display : public testing::Test {
 protected:
  void SetUp() override { ::unsetenv("OCIO"); }
};

TEST_F(Display, DefaultIsAcesSdrOnSrgb) {
  const auto views = image_io().views("");
  ASSERT_TRUE(views.ok());
  EXPECT_EQ(views->front(), "sRGB/ACES SDR");
  EXPECT_THAT(*views, testing::IsSupersetOf({"sRGB/Un-tone-mapped", "sRGB/Log", "P3-D65/ACES SDR",
                                             "Rec.1886 Rec.709/ACES SDR",
                                             "Rec.2100-PQ/ACES HDR 1000 nits"}));
}

// The RRT and 48-nit ODT put 18 % grey at 4.8 of 48 cd/m^2 (Academy, ODT.Academy.RGBmonitor);
// the dim-surround power 0.9811 on luminance follows.
TEST_F(Display, AcesPutsMiddleGreyAtTenPercent) {
  const float expected = srgb_code(std::pow(0.1, 0.9811));
  for (const char* space : {"rec709", "rec2020", "acescg", "aces2065-1"})
    for (const float v : shown({"", space, "sRGB", "ACES SDR"}, {0.18f, 0.18f, 0.18f}))
      EXPECT_NEAR(v, expected, kQuarterCode) << space;
}

TEST_F(Display, AcesEndsAreBlackAndWhite) {
  for (const float v : shown({"", "rec709", "", ""}, {0, 0, 0})) EXPECT_NEAR(v, 0.0f, kQuarterCode);
  // The tone curve still climbs a little beyond the display's white; quantising ends it at 1.
  for (const float v : shown({"", "rec709", "", ""}, {1e5f, 1e5f, 1e5f})) EXPECT_GE(v, 1.0f);
}

TEST_F(Display, UnToneMappedIsThePlainSrgbCurve) {
  for (const double linear : {0.0, 0.002, 0.18, 0.5, 1.0}) {
    const auto v = static_cast<float>(linear);
    for (const float code : shown({"", "rec709", "sRGB", "Un-tone-mapped"}, {v, v, v}))
      EXPECT_NEAR(code, srgb_code(linear), 2e-5f);  // float rounding of two matrices
  }
}

TEST_F(Display, SpacesOfTheSameColourLookTheSame) {
  const glm::dvec3 rec709(0.20, 0.35, 0.70);
  const auto reference = shown({"", "rec709", "sRGB", "ACES SDR"}, {0.20f, 0.35f, 0.70f});
  for (const auto space :
       {color::RgbSpace::rec2020, color::RgbSpace::acescg, color::RgbSpace::aces2065_1}) {
    const glm::vec3 same(color::rgb_to_rgb(color::RgbSpace::rec709, space) * rec709);
    const auto got = shown({"", std::string(color::rgb_space_name(space)), "sRGB", "ACES SDR"},
                           {same.x, same.y, same.z});
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(got[c], reference[c], kQuarterCode);
  }
}

TEST_F(Display, PiecesAndThreadsDoNotChangeTheResult) {
  const auto transform = image_io().display({"", "rec709", "", ""});
  ASSERT_TRUE(transform.ok());
  const auto source = gradient();
  auto whole = source;
  (*transform)->apply(whole.data(), whole.size() / 3);
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      auto pieces = source;
      const size_t step = 3 * (7 + static_cast<size_t>(t));
      for (size_t i = 0; i < pieces.size(); i += step)
        (*transform)->apply(pieces.data() + i, std::min(step, pieces.size() - i) / 3);
      EXPECT_EQ(pieces, whole);
    });
}

TEST_F(Display, BrightestAndInvalidPixelsStayDisplayable) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  for (const float v : {1.6e9f, 3e38f, kInf})
    for (const float code : shown({"", "rec709", "", ""}, {v, v, v})) EXPECT_GE(code, 1.0f) << v;
  for (const float v : {-1.0f, -1e30f, -kInf})
    for (const float code : shown({"", "rec709", "", ""}, {v, v, v}))
      EXPECT_NEAR(code, 0.0f, kQuarterCode) << v;
}

TEST_F(Display, UnknownNamesListWhatThereIs) {
  const auto refused = [](const DisplayRequest& r) {
    const auto result = image_io().display(r);
    EXPECT_FALSE(result.ok());
    if (result.ok()) return std::string();
    EXPECT_EQ(result.error().code, ErrorCode::invalid_input);
    return result.error().message + " " + result.error().hint;
  };
  EXPECT_THAT(refused({"", "rec709", "sRGB", "ACES SDX"}),
              testing::AllOf(HasSubstr("Un-tone-mapped"), HasSubstr("did you mean ACES SDR?")));
  EXPECT_THAT(refused({"", "rec709", "P3-D56", ""}), HasSubstr("did you mean P3-D65?"));
  EXPECT_THAT(refused({"", "rec710", "", ""}), HasSubstr("did you mean rec709?"));
}

/// A user's config with one linear space under the given YAML names.
std::string user_config(const std::string& space_lines, const std::string& roles = "") {
  return "ocio_profile_version: 2\nroles:\n  default: raw\n" + roles +
         "displays:\n  Monitor:\n    - !<View> {name: Film, colorspace: out}\n"
         "    - !<View> {name: Plain, colorspace: raw}\n"
         "colorspaces:\n" +
         space_lines +
         "  - !<ColorSpace>\n    name: out\n    from_scene_reference: !<ExponentTransform> "
         "{value: 2, direction: inverse}\n"
         "  - !<ColorSpace>\n    name: raw\n    isdata: true\n";
}

class UserConfig : public Display {
 protected:
  std::string write(const std::string& text) {
    const auto path = folder_ / "config.ocio";
    std::ofstream(path) << text;
    return path.string();
  }
  TemporaryFolder folder_;
};

TEST_F(UserConfig, ExactNameAliasOrMatrixAllReachTheSameReference) {
  // The reference of this config is linear Rec. 709; 0.25 comes out as its square root.
  const auto named = write(user_config("  - !<ColorSpace>\n    name: Linear Rec.709 (sRGB)\n"));
  EXPECT_NEAR(shown({named, "rec709", "", ""}, {0.25f, 0.25f, 0.25f})[1], 0.5f, 1e-5f);
  const auto alias =
      write(user_config("  - !<ColorSpace>\n    name: scene\n    aliases: [lin_rec709]\n"));
  EXPECT_NEAR(shown({alias, "rec709", "", ""}, {0.25f, 0.25f, 0.25f})[1], 0.5f, 1e-5f);
  // Another of our spaces is led through the matrix between the two.
  const glm::vec3 ap1(color::rgb_to_rgb(color::RgbSpace::rec709, color::RgbSpace::acescg) *
                      glm::dvec3(0.25, 0.36, 0.49));
  const auto got = shown({alias, "acescg", "Monitor", "Film"}, {ap1.x, ap1.y, ap1.z});
  EXPECT_NEAR(got[0], 0.5f, 1e-5f);
  EXPECT_NEAR(got[1], 0.6f, 1e-5f);
  EXPECT_NEAR(got[2], 0.7f, 1e-5f);
}

TEST_F(UserConfig, InterchangeRoleIsEnough) {
  const auto path = write(user_config("  - !<ColorSpace>\n    name: house_reference\n",
                                      "  aces_interchange: house_reference\n"));
  EXPECT_NEAR(shown({path, "rec709", "", ""}, {0.25f, 0.25f, 0.25f})[0], 0.5f, 1e-5f);
}

TEST_F(UserConfig, WithoutAnyKnownSpaceTheErrorSaysHowToNameOne) {
  const auto path = write(user_config("  - !<ColorSpace>\n    name: house_reference\n"));
  const auto result = image_io().display({path, "rec709", "", ""});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::invalid_input);
  EXPECT_THAT(result.error().hint, HasSubstr("lin_rec709"));
  EXPECT_THAT(result.error().hint, HasSubstr("house_reference"));
}

TEST_F(UserConfig, EnvironmentVariableIsHonouredAndTheFileWins) {
  const auto path = write(user_config("  - !<ColorSpace>\n    name: lin_rec709\n"));
  ::setenv("OCIO", path.c_str(), 1);
  EXPECT_THAT(*image_io().views(""), testing::ElementsAre("Monitor/Film", "Monitor/Plain"));
  ::setenv("OCIO", "/nonexistent/config.ocio", 1);
  EXPECT_THAT(*image_io().views(path), testing::ElementsAre("Monitor/Film", "Monitor/Plain"));
  const auto missing = image_io().views("");
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, ErrorCode::missing_input);
  EXPECT_THAT(missing.error().message, HasSubstr("$OCIO"));
  ::unsetenv("OCIO");
}

TEST_F(UserConfig, BrokenConfigIsInvalidInputWithItsName) {
  const auto path = write("ocio_profile_version: 2\ncolorspaces: {");
  const auto result = image_io().views(path);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::invalid_input);
  EXPECT_THAT(result.error().message, HasSubstr("config.ocio"));
}

}  // namespace
}  // namespace skylapse::output
