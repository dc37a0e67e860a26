#include "output/metadata.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace skylapse::output {
namespace {

using namespace std::chrono_literals;

FrameMetadata solstice() {
  FrameMetadata f;
  f.utc = std::chrono::sys_days(std::chrono::year(2026) / 6 / 20) + 22h + 30min + 15s + 250ms;
  f.utc_offset = 2h;
  f.zone = "Europe/Prague";
  f.position = {50.0755 * deg, 14.4378 * deg, 235.0 * metre};
  f.sun = enu_direction(300.0 * deg, 5.0 * deg);
  return f;
}

const Attribute* find(const std::vector<Attribute>& all, const std::string& name) {
  for (const Attribute& a : all)
    if (a.name == name) return &a;
  return nullptr;
}

template <class T>
T get(const std::vector<Attribute>& all, const std::string& name) {
  const Attribute* const a = find(all, name);
  if (a == nullptr || !std::holds_alternative<T>(a->value)) {
    ADD_FAILURE() << name << " is missing or of another type";
    return T{};
  }
  return std::get<T>(a->value);
}

TEST(FrameAttributes, CapDateIsLocalAndCrossesMidnight) {
  const auto all = frame_attributes(solstice());
  EXPECT_EQ(get<std::string>(all, "capDate"), "2026:06:21 00:30:15");
  EXPECT_EQ(get<std::string>(all, "skylapse:utc"), "2026-06-20T22:30:15.250000Z");
}

TEST(FrameAttributes, UtcOffsetHasOpenExrsSign) {
  EXPECT_EQ(get<float>(frame_attributes(solstice()), "utcOffset"), -7200.0f);
  FrameMetadata west = solstice();
  west.utc_offset = -(3h + 30min);
  EXPECT_EQ(get<float>(frame_attributes(west), "utcOffset"), 12600.0f);
}

TEST(FrameAttributes, TimesBefore1970AreFlooredNotTruncated) {
  FrameMetadata old = solstice();
  old.utc = std::chrono::sys_days(std::chrono::year(1950) / 1 / 1) - 1us;
  old.utc_offset = 0s;
  const auto all = frame_attributes(old);
  EXPECT_EQ(get<std::string>(all, "capDate"), "1949:12:31 23:59:59");
  EXPECT_EQ(get<std::string>(all, "skylapse:utc"), "1949-12-31T23:59:59.999999Z");
}

TEST(FrameAttributes, PlaceIsInDegreesEastAndNorthAndMetres) {
  FrameMetadata f = solstice();
  f.position = {-33.8688 * deg, 511.2093 * deg, -2.5 * metre};  // one turn too far east
  const auto all = frame_attributes(f);
  EXPECT_FLOAT_EQ(get<float>(all, "latitude"), -33.8688f);
  EXPECT_FLOAT_EQ(get<float>(all, "longitude"), 151.2093f);
  EXPECT_FLOAT_EQ(get<float>(all, "altitude"), -2.5f);
}

TEST(FrameAttributes, WhiteLuminanceFollowsTheScale) {
  FrameMetadata f = solstice();
  EXPECT_EQ(get<float>(frame_attributes(f), "whiteLuminance"), 683.0f);
  f.sun_policy = SunPolicyRecord{.policy = SunPolicy::scale, .scale = 1.0 / 32768};
  EXPECT_EQ(get<float>(frame_attributes(f), "whiteLuminance"), 683.0f * 32768);
  EXPECT_EQ(get<double>(frame_attributes(f), "skylapse:scale"), 1.0 / 32768);
}

TEST(FrameAttributes, ExposedAndDisplayPixelsClaimNoLuminance) {
  FrameMetadata f = solstice();
  f.encoding = PixelEncoding::exposed;
  EXPECT_EQ(find(frame_attributes(f), "whiteLuminance"), nullptr);
  EXPECT_NE(find(frame_attributes(f), "chromaticities"), nullptr);
  f.encoding = PixelEncoding::display;
  f.display = "sRGB";
  f.view = "ACES SDR";
  const auto all = frame_attributes(f);
  EXPECT_EQ(find(all, "whiteLuminance"), nullptr);
  EXPECT_EQ(find(all, "chromaticities"), nullptr);
  EXPECT_EQ(get<std::string>(all, "skylapse:view"), "ACES SDR");
  EXPECT_EQ(get<std::string>(all, "oiio:ColorSpace"), "sRGB");
  f.display = "P3-D65";
  EXPECT_EQ(find(frame_attributes(f), "oiio:ColorSpace"), nullptr);
}

TEST(FrameAttributes, ExposureTimeMatchesTheEvAtItsAperture) {
  FrameMetadata f = solstice();
  f.exposure_ev100 = 15.0;
  const auto all = frame_attributes(f);
  const double n = static_cast<double>(get<float>(all, "aperture"));
  const double t = static_cast<double>(get<float>(all, "expTime"));
  EXPECT_NEAR(std::log2(n * n / t), 15.0, 1e-6);
  EXPECT_EQ(get<float>(all, "isoSpeed"), 100.0f);
}

TEST(FrameAttributes, SunDirectionAndFlags) {
  FrameMetadata f = solstice();
  f.extrapolated = true;
  f.environment = EnvironmentMap::lat_long;
  const auto all = frame_attributes(f);
  EXPECT_NEAR(get<double>(all, "skylapse:sunAzimuth"), 300.0, 1e-12);
  EXPECT_NEAR(get<double>(all, "skylapse:sunElevation"), 5.0, 1e-12);
  EXPECT_EQ(get<int>(all, "skylapse:extrapolated"), 1);
  EXPECT_EQ(get<std::string>(all, "textureformat"), "LatLong Environment");
  EXPECT_EQ(find(all, "skylapse:moonAzimuth"), nullptr) << "nothing is claimed about no moon";
}

TEST(FrameAttributes, TheSunPolicyIsNamedOnlyWhereThereIsADiscToTreat) {
  FrameMetadata f = solstice();
  f.sun_policy = SunPolicyRecord{.policy = SunPolicy::clip};
  f.content = PictureContent::radiance;
  auto all = frame_attributes(f);
  EXPECT_EQ(get<std::string>(all, "skylapse:content"), "radiance");
  EXPECT_EQ(get<std::string>(all, "skylapse:sunPolicy"), "clip");
  f.content = PictureContent::sky_without_disc;
  f.disc_treated = false;
  all = frame_attributes(f);
  EXPECT_EQ(get<std::string>(all, "skylapse:content"), "sky without disc");
  EXPECT_EQ(find(all, "skylapse:sunPolicy"), nullptr);
  EXPECT_EQ(get<double>(all, "skylapse:scale"), 1.0) << "of the file, with a disc or without";
  f.content = PictureContent::standard_error;
  EXPECT_EQ(get<std::string>(frame_attributes(f), "skylapse:content"), "standard error");
}

TEST(FrameAttributes, AMapSaysHowItLies) {
  FrameMetadata f = solstice();
  for (const char* name : {"skylapse:orientation", "skylapse:heading", "skylapse:projection"})
    EXPECT_EQ(find(frame_attributes(f), name), nullptr) << name << " of no map";
  f.projection = "octahedral";
  f.orientation = "pbrt";
  f.heading = 0 * deg;
  const auto all = frame_attributes(f);
  EXPECT_EQ(get<std::string>(all, "skylapse:projection"), "octahedral");
  EXPECT_EQ(get<std::string>(all, "skylapse:orientation"), "pbrt");
  EXPECT_EQ(get<double>(all, "skylapse:heading"), 0.0) << "north is a heading too";
}

TEST(FrameAttributes, SayHowTheCameraStood) {
  FrameMetadata f = solstice();
  f.projection = "fisheye-equisolid";
  f.look = image::Look{200 * deg, -33 * deg, 17 * deg};
  f.field_of_view = 180 * deg;
  const auto all = frame_attributes(f);
  EXPECT_NEAR(get<double>(all, "skylapse:lookAzimuth"), 200, 1e-12);
  EXPECT_NEAR(get<double>(all, "skylapse:lookElevation"), -33, 1e-12);
  EXPECT_NEAR(get<double>(all, "skylapse:roll"), 17, 1e-12);
  EXPECT_NEAR(get<double>(all, "skylapse:fieldOfView"), 180, 1e-12);
  EXPECT_EQ(find(all, "skylapse:cubeLayout"), nullptr);
  EXPECT_EQ(find(frame_attributes(solstice()), "skylapse:roll"), nullptr);
}

}  // namespace
}  // namespace skylapse::output
