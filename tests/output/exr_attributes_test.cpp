// OpenEXR's standard attributes arrive under their names with their types.
#include <gtest/gtest.h>

#include "output/exr_header.h"
#include "output/image_fixture.h"
#include "output/metadata.h"

namespace skylapse::output {
namespace {

using namespace std::chrono_literals;

FrameMetadata lat_long_frame() {
  FrameMetadata f;
  f.utc = std::chrono::sys_days(std::chrono::year(2026) / 6 / 21) + 10h;
  f.utc_offset = 2h;
  f.zone = "Europe/Prague";
  f.position = {50.0755 * deg, 14.4378 * deg, 235.0 * metre};
  f.sun = enu_direction(180.0 * deg, 63.0 * deg);
  f.environment = EnvironmentMap::lat_long;
  f.exposure_ev100 = 15.0;
  f.model = "hosek-wilkie";
  f.fingerprint = "0123abcd";
  f.sun_policy = SunPolicyRecord{};
  return f;
}

std::map<std::string, ExrAttribute> header_of(const FrameMetadata& f, SampleType type) {
  const auto rgb = gradient();
  auto r = request("exr", type, rgb.data());
  r.attributes = frame_attributes(f);
  const auto bytes = image_io().encode(r);
  if (!bytes) throw std::runtime_error(bytes.error().message);
  return read_exr_header(*bytes);
}

TEST(ExrAttributes, StandardOnesHaveTheirNamesAndTypes) {
  const auto h = header_of(lat_long_frame(), SampleType::half_float);
  const auto number = [&](const char* name) {
    EXPECT_EQ(h.at(name).type, "float") << name;
    return h.at(name).as<float>();
  };
  EXPECT_EQ(h.at("capDate").type, "string");
  EXPECT_EQ(h.at("capDate").text(), "2026:06:21 12:00:00");
  EXPECT_EQ(number("utcOffset"), -7200.0f);
  EXPECT_EQ(number("longitude"), 14.4378f);
  EXPECT_EQ(number("latitude"), 50.0755f);
  EXPECT_EQ(number("altitude"), 235.0f);
  EXPECT_EQ(number("whiteLuminance"), 683.0f);
  EXPECT_EQ(number("isoSpeed"), 100.0f);
  EXPECT_EQ(number("aperture"), 8.0f);
  EXPECT_EQ(number("expTime"), 64.0f / 32768.0f);
  EXPECT_EQ(h.at("chromaticities").type, "chromaticities");
  EXPECT_EQ((h.at("chromaticities").as<std::array<float, 8>>()),
            color::exr_chromaticities(color::RgbSpace::rec709));
}

TEST(ExrAttributes, EnvmapSaysLatLongOrCubeOrNothing) {
  FrameMetadata f = lat_long_frame();
  auto h = header_of(f, SampleType::float32);
  ASSERT_TRUE(h.contains("envmap"));
  EXPECT_EQ(h.at("envmap").type, "envmap");
  EXPECT_EQ(h.at("envmap").as<uint8_t>(), 0);  // ENVMAP_LATLONG
  f.environment = EnvironmentMap::cube;
  h = header_of(f, SampleType::float32);
  ASSERT_TRUE(h.contains("envmap"));
  EXPECT_EQ(h.at("envmap").as<uint8_t>(), 1);  // ENVMAP_CUBE
  f.environment = EnvironmentMap::none;
  EXPECT_FALSE(header_of(f, SampleType::float32).contains("envmap"));
}

TEST(ExrAttributes, OursAreDoublesAndStrings) {
  const auto h = header_of(lat_long_frame(), SampleType::half_float);
  EXPECT_EQ(h.at("skylapse:sunElevation").type, "double");
  EXPECT_NEAR(h.at("skylapse:sunElevation").as<double>(), 63.0, 1e-12);
  EXPECT_EQ(h.at("skylapse:exposureEv100").as<double>(), 15.0);
  EXPECT_EQ(h.at("skylapse:model").text(), "hosek-wilkie");
  EXPECT_EQ(h.at("skylapse:fingerprint").text(), "0123abcd");
  EXPECT_EQ(h.at("skylapse:extrapolated").type, "int");
  EXPECT_EQ(h.at("skylapse:sunPolicy").text(), "clip");
}

TEST(ExrAttributes, NoTimeIsInventedWhenNoneIsGiven) {
  const auto rgb = gradient();
  const auto bytes = image_io().encode(request("exr", SampleType::float32, rgb.data()));
  ASSERT_TRUE(bytes.ok());
  EXPECT_FALSE(read_exr_header(*bytes).contains("capDate"));
}

TEST(ExrAttributes, DecodingGivesTheNamesBack) {
  const auto rgb = gradient();
  auto r = request("exr", SampleType::float32, rgb.data());
  r.attributes = frame_attributes(lat_long_frame());
  const auto bytes = image_io().encode(r);
  ASSERT_TRUE(bytes.ok());
  const auto image = decode_bytes(*bytes, "exr");
  ASSERT_TRUE(image.ok());
  for (const char* name :
       {"capDate", "utcOffset", "longitude", "latitude", "altitude", "expTime", "aperture",
        "isoSpeed", "whiteLuminance", "chromaticities", "skylapse:model", "skylapse:sunAzimuth"})
    EXPECT_TRUE(std::any_of(image->attributes.begin(), image->attributes.end(),
                            [&](const Attribute& a) { return a.name == name; }))
        << name;
}

}  // namespace
}  // namespace skylapse::output
