// What each format keeps of an image, through the loaded module.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>

#include "output/image_fixture.h"

namespace skylapse::output {
namespace {

using testing::HasSubstr;

std::vector<std::byte> encoded(const EncodeRequest& r) {
  auto bytes = image_io().encode(r);
  if (!bytes) {
    ADD_FAILURE() << r.format << ": " << format_error(bytes.error());
    return {};
  }
  return std::move(bytes).value();
}

DecodedImage round_trip(const EncodeRequest& r) {
  auto image = decode_bytes(encoded(r), r.format);
  if (!image) {
    ADD_FAILURE() << format_error(image.error());
    return {};
  }
  EXPECT_EQ(image->pixels.width(), r.width);
  EXPECT_EQ(image->pixels.height(), r.height);
  return std::move(image).value();
}

TEST(ImageFiles, FloatFormatsKeepEveryBit) {
  auto rgb = gradient();
  rgb[5] = 1.5e6f;  // the sun
  rgb[7] = -0.25f;
  for (const std::string compression : {"none", "zip", "zips", "piz"}) {
    auto r = request("exr", SampleType::float32, rgb.data());
    r.compression = compression;
    EXPECT_EQ(round_trip(r).pixels.data(), rgb) << compression;
  }
  EXPECT_EQ(round_trip(request("tif", SampleType::float32, rgb.data())).pixels.data(), rgb);
}

TEST(ImageFiles, NanAndInfinitySurviveInFloatExr) {
  auto rgb = gradient();
  rgb[0] = std::nanf("");
  rgb[1] = std::numeric_limits<float>::infinity();
  const auto back = round_trip(request("exr", SampleType::float32, rgb.data())).pixels.data();
  EXPECT_TRUE(std::isnan(back[0]));
  EXPECT_TRUE(std::isinf(back[1]));
  EXPECT_EQ(back[2], rgb[2]);
}

TEST(ImageFiles, HalfFloatsKeepElevenBits) {
  const auto rgb = gradient();
  for (const std::string format : {"exr", "tif"}) {
    const auto image = round_trip(request(format, SampleType::half_float, rgb.data()));
    EXPECT_EQ(image.stored_bits, 16);
    for (size_t i = 0; i < rgb.size(); ++i)  // rounding to nearest: half of 2^-10
      ASSERT_NEAR(image.pixels.data()[i], rgb[i], std::ldexp(rgb[i], -11)) << format;
  }
}

TEST(ImageFiles, HalfFloatNeverTurnsIntoInfinityUnasked) {
  auto rgb = gradient();
  rgb[100] = 65504.0f;
  EXPECT_EQ(round_trip(request("exr", SampleType::half_float, rgb.data())).pixels.data()[100],
            65504.0f);
  for (const float beyond : {65505.0f, -1e6f, std::numeric_limits<float>::infinity()}) {
    rgb[100] = beyond;
    const auto refused = image_io().encode(request("exr", SampleType::half_float, rgb.data()));
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::invalid_input);
    EXPECT_THAT(refused.error().hint, HasSubstr("sun policy"));
  }
  rgb[100] = std::nanf("");
  EXPECT_TRUE(std::isnan(
      round_trip(request("exr", SampleType::half_float, rgb.data())).pixels.data()[100]));
}

TEST(ImageFiles, IntegerFormatsKeepEveryCode) {
  const auto c8 = codes<uint8_t>();
  const auto c16 = codes<uint16_t>();
  for (const std::string format : {"png", "tif"}) {
    const auto eight = round_trip(request(format, SampleType::u8, c8.data()));
    const auto sixteen = round_trip(request(format, SampleType::u16, c16.data()));
    EXPECT_EQ(eight.stored_bits, 8);
    EXPECT_EQ(sixteen.stored_bits, 16);
    for (size_t i = 0; i < c8.size(); ++i) {
      ASSERT_EQ(std::lround(eight.pixels.data()[i] * 255.0f), c8[i]) << format;
      ASSERT_EQ(std::lround(sixteen.pixels.data()[i] * 65535.0f), c16[i]) << format;
    }
  }
}

TEST(ImageFiles, RadianceHdrKeepsEightBitsBelowTheBrightestChannel) {
  const auto rgb = gradient();
  const auto back = round_trip(request("hdr", SampleType::float32, rgb.data())).pixels.data();
  for (size_t i = 0; i < rgb.size(); i += 3) {
    const float brightest = std::max({rgb[i], rgb[i + 1], rgb[i + 2]});
    // Mantissas of 8 bits share an exponent and are cut, not rounded: one step is 2^-7 at worst.
    for (size_t c = 0; c < 3; ++c) ASSERT_NEAR(back[i + c], rgb[i + c], brightest / 128.0f);
  }
}

TEST(ImageFiles, JpegIsCloseInAllThreeChannels) {
  std::vector<uint8_t> smooth;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (const int v : {6 * x, 10 * y, 255 - 6 * x}) smooth.push_back(static_cast<uint8_t>(v));
  auto r = request("jpg", SampleType::u8, smooth.data());
  r.quality = 98;
  const auto back = round_trip(r).pixels.data();
  // Full chroma resolution: with 4:2:0 the red and blue ramps would be off by more.
  for (size_t i = 0; i < smooth.size(); ++i)
    ASSERT_NEAR(back[i] * 255.0f, static_cast<float>(smooth[i]), 6.0f);
  r.quality = 40;
  EXPECT_LT(encoded(r).size(), encoded(request("jpg", SampleType::u8, smooth.data())).size());
}

TEST(ImageFiles, SameRequestSameBytesASecondLater) {
  const auto rgb = gradient();
  const auto c8 = codes<uint8_t>();
  std::vector<EncodeRequest> all{
      request("exr", SampleType::half_float, rgb.data()),
      request("exr", SampleType::float32, rgb.data()),
      request("hdr", SampleType::float32, rgb.data()),
      request("png", SampleType::u8, c8.data()),
      request("jpg", SampleType::u8, c8.data()),
      request("tif", SampleType::u8, c8.data()),
      request("tif", SampleType::float32, rgb.data()),
  };
  for (size_t i = all.size(); i-- > 0;) {
    all.push_back(all[i]);
    all.back().attributes = {{"capDate", std::string("2026:06:21 12:00:00")},
                             {"skylapse:model", std::string("hosek-wilkie")}};
  }
  std::vector<std::vector<std::byte>> first;
  for (const auto& r : all) first.push_back(encoded(r));
  // Writers that stamp the present time differ once the second has changed.
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  for (size_t i = 0; i < all.size(); ++i)
    EXPECT_EQ(encoded(all[i]), first[i]) << all[i].format << " number " << i;
}

TEST(ImageFiles, ThreadsEncodeAtOnce) {
  const auto rgb = gradient();
  const auto r = request("exr", SampleType::half_float, rgb.data());
  const auto expected = encoded(r);
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 20; ++i) EXPECT_EQ(encoded(r), expected);
    });
}

TEST(ImageFiles, PngKeepsNumbersAsText) {
  const auto c8 = codes<uint8_t>();
  auto r = request("png", SampleType::u8, c8.data());
  r.attributes = {{"longitude", 14.4378f}, {"skylapse:exposureEv100", 14.125}, {"isoSpeed", 100}};
  const auto back = round_trip(r).attributes;
  const auto has = [&](const std::string& name, const std::string& text) {
    return std::any_of(back.begin(), back.end(), [&](const Attribute& a) {
      return a.name == name && a.value == decltype(a.value)(text);
    });
  };
  EXPECT_TRUE(has("longitude", "14.4378"));
  EXPECT_TRUE(has("skylapse:exposureEv100", "14.125"));
  EXPECT_TRUE(has("isoSpeed", "100"));
}

TEST(ImageFiles, PngOfAnSrgbDisplayHasTheSrgbChunkAndNoTimeChunk) {
  const auto c8 = codes<uint8_t>();
  auto r = request("png", SampleType::u8, c8.data());
  r.attributes = {{"oiio:ColorSpace", std::string("sRGB")},
                  {"capDate", std::string("2026:06:21 12:00:00")}};
  const auto bytes = encoded(r);
  const std::string file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  EXPECT_NE(file.find("sRGB"), std::string::npos);
  EXPECT_EQ(file.find("tIME"), std::string::npos);
  EXPECT_NE(file.find("2026:06:21 12:00:00"), std::string::npos);
}

TEST(ImageFiles, WrongRequestsAreRefusedWithWhatIsPossible) {
  const auto rgb = gradient();
  const auto refused = [](const EncodeRequest& r) {
    const auto result = image_io().encode(r);
    EXPECT_FALSE(result.ok());
    if (result.ok()) return std::string();
    EXPECT_EQ(result.error().code, ErrorCode::invalid_input);
    return result.error().message + " " + result.error().hint;
  };
  EXPECT_THAT(refused(request("bmp", SampleType::u8, rgb.data())), HasSubstr("exr, hdr, png"));
  EXPECT_THAT(refused(request("png", SampleType::float32, rgb.data())), HasSubstr("uint8, uint16"));
  EXPECT_THAT(refused(request("hdr", SampleType::u8, rgb.data())), HasSubstr("float"));
  auto r = request("exr", SampleType::float32, rgb.data());
  r.compression = "zipp";
  EXPECT_THAT(refused(r), HasSubstr("none, zip, zips, piz, dwaa"));
  r = request("jpg", SampleType::u8, rgb.data());
  r.quality = 101;
  EXPECT_THAT(refused(r), HasSubstr("1 to 100"));
  r = request("exr", SampleType::float32, nullptr);
  EXPECT_THAT(refused(r), HasSubstr("without pixels"));
}

TEST(ImageFiles, MissingAndDamagedFilesAreNamed) {
  const auto missing = image_io().decode("/nonexistent/frame.exr");
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, ErrorCode::missing_input);
  EXPECT_THAT(missing.error().message, HasSubstr("/nonexistent/frame.exr"));
  const auto rgb = gradient();
  const auto c8 = codes<uint8_t>();
  for (const auto& r :
       {request("exr", SampleType::float32, rgb.data()), request("tif", SampleType::u8, c8.data()),
        request("hdr", SampleType::float32, rgb.data()), request("png", SampleType::u8, c8.data()),
        request("jpg", SampleType::u8, c8.data())}) {
    auto bytes = encoded(r);
    bytes.resize(bytes.size() / 2);
    const auto cut = decode_bytes(bytes, r.format);
    ASSERT_FALSE(cut.ok()) << r.format;
    EXPECT_EQ(cut.error().code, ErrorCode::missing_input);
  }
}

}  // namespace
}  // namespace skylapse::output
