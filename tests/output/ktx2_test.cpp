#include "output/ktx2.h"

#include <gtest/gtest.h>

#include "core/version.h"
#include "image/lighting/cube_mips.h"
#include "image/orientation.h"
#include "ktx2_reader.h"
#include "output/stored_numbers.h"

namespace skylapse::output {
namespace {

/// Each texel tells its face, column, row and level.
std::vector<image::FrameBuffer> numbered(int side, int levels) {
  std::vector<image::FrameBuffer> all;
  for (int level = 0; level < levels; ++level) {
    const int n = image::level_side(side, level);
    image::FrameBuffer strip(n, 6 * n);
    for (int y = 0; y < 6 * n; ++y)
      for (int x = 0; x < n; ++x) {
        strip.pixel(x, y)[0] = float(y / n + 10 * level);
        strip.pixel(x, y)[1] = float(x);
        strip.pixel(x, y)[2] = float(y % n);
      }
    all.push_back(std::move(strip));
  }
  return all;
}

TEST(Ktx2, EveryFieldIsAsTheSpecificationHasIt) {
  for (const auto& [side, levels] :
       {std::pair{1, 1}, {4, 3}, {4, 1}, {37, 6}, {64, 7}, {48, 4}, {300, 7}})
    for (const SampleType type : {SampleType::half_float, SampleType::float32}) {
      const auto mips = numbered(side, levels);
      const auto bytes = ktx2_file({.levels = mips, .type = type});
      ASSERT_TRUE(bytes);
      const KtxFile file = read_ktx2(*bytes);
      ASSERT_EQ(file.problem, "") << side << ' ' << levels;
      EXPECT_EQ(file.side, uint32_t(side));
      EXPECT_EQ(file.levels, uint32_t(levels));
      EXPECT_EQ(file.vk_format, type == SampleType::half_float ? 97U : 109U);
      EXPECT_EQ(file.transfer, 1);
      EXPECT_EQ(file.key_values.at("KTXorientation"), "rd");
      EXPECT_EQ(file.key_values.at("KTXwriter"), std::string("skylapse ") + kVersion);
    }
}

TEST(Ktx2, HoldsEveryTexelInItsPlace) {
  const auto mips = numbered(12, 3);
  const auto faces = image::faces_in(image::CubeOrder::opengl);
  for (const SampleType type : {SampleType::half_float, SampleType::float32}) {
    const KtxFile file = read_ktx2(*ktx2_file({.levels = mips, .faces = faces, .type = type}));
    ASSERT_EQ(file.problem, "");
    for (uint32_t level = 0; level < 3; ++level)
      for (uint32_t face = 0; face < 6; ++face)
        for (uint32_t y = 0; y < file.images[level].side; ++y)
          for (uint32_t x = 0; x < file.images[level].side; ++x) {
            const float* rgba = file.images[level].texel(face, x, y);
            ASSERT_EQ(rgba[0], float(int(faces[face]) + 10 * int(level)));
            ASSERT_EQ(rgba[1], float(x));
            ASSERT_EQ(rgba[2], float(y));
            ASSERT_EQ(rgba[3], 1.0F);
          }
  }
}

TEST(Ktx2, HalvesAreRoundedToTheNearest) {
  image::FrameBuffer strip(1, 6);
  const float values[] = {1.0003F, 65503.9F,   6e-8F, 3.1e-5F, -2.71828F, 0.0F,
                          1e-9F,   6.1035e-5F, 0.1F,  2048.9F, 12345.6F,  7.7e-6F};
  std::copy(std::begin(values), std::end(values), strip.data().begin());
  const KtxFile file = read_ktx2(*ktx2_file({.levels = {&strip, 1}}));
  ASSERT_EQ(file.problem, "");
  for (size_t i = 0; i < std::size(values); ++i)
    EXPECT_EQ(file.images[0].rgba[i / 3 * 4 + i % 3], rounded_to_half(values[i])) << values[i];
}

TEST(Ktx2, NamesThePrimariesAndKeepsNotesInOrder) {
  const auto mips = numbered(2, 1);
  const std::pair<color::RgbSpace, int> primaries[] = {{color::RgbSpace::rec709, 1},
                                                       {color::RgbSpace::rec2020, 4},
                                                       {color::RgbSpace::aces2065_1, 6},
                                                       {color::RgbSpace::acescg, 7}};
  for (const auto& [space, number] : primaries) {
    const KtxFile file = read_ktx2(*ktx2_file(
        {.levels = mips, .space = space, .notes = {{"skylapse:b", "2"}, {"Alpha", "žluť"}}}));
    ASSERT_EQ(file.problem, "");
    EXPECT_EQ(file.primaries, number);
    EXPECT_EQ(file.key_values.at("skylapse:b"), "2");
    EXPECT_EQ(file.key_values.at("Alpha"), "žluť");
    EXPECT_EQ(file.key_values.size(), 4U);
  }
}

TEST(Ktx2, RefusesWhatItsNumbersCannotHold) {
  image::FrameBuffer strip(1, 6);
  strip.data()[4] = 1e6F;
  const auto half = ktx2_file({.levels = {&strip, 1}});
  ASSERT_FALSE(half);
  EXPECT_EQ(half.error().code, ErrorCode::invalid_input);
  EXPECT_NE(half.error().message.find("1000000"), std::string::npos);
  EXPECT_TRUE(ktx2_file({.levels = {&strip, 1}, .type = SampleType::float32}));
  strip.data()[4] = std::nanf("");
  EXPECT_FALSE(ktx2_file({.levels = {&strip, 1}, .type = SampleType::float32}));
}

// The reader is no judge unless it finds what is wrong.
TEST(Ktx2Reader, FindsEveryChangedByteOfTheFilesStructure) {
  const auto mips = numbered(4, 2);
  const auto bytes = *ktx2_file({.levels = mips});
  const size_t structure = 80 + 2 * 24 + 92;  // header, index, descriptor
  const auto unchecked = [&](size_t i) {      // a colour space and a transfer are data
    return i == 80 + 48 + 13 || i == 80 + 48 + 14;
  };
  for (size_t i = 0; i < structure; ++i) {
    if (unchecked(i)) continue;
    auto changed = bytes;
    changed[i] ^= std::byte{0x11};
    EXPECT_NE(read_ktx2(changed).problem, "") << "byte " << i;
  }
  for (const size_t cut : {size_t{1}, size_t{8}, bytes.size() - 100}) {
    auto shorter = bytes;
    shorter.resize(bytes.size() - cut);
    EXPECT_NE(read_ktx2(shorter).problem, "") << cut;
  }
}

}  // namespace
}  // namespace skylapse::output
