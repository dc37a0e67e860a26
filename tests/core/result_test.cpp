#include "core/result.h"

#include <gtest/gtest.h>

#include "core/printable.h"

using namespace skylapse;

namespace {

TEST(FormatError, PointsAtTheValueAndSaysWhatIsAllowed) {
  Error error{ErrorCode::invalid_input,
              "observer.elevation = 2500 km is above the top of the atmosphere",
              {"oslo.yaml", 14, 14, 7, "  elevation: 2500 km"},
              "allowed: -500 m to 100 km"};
  EXPECT_EQ(
      format_error(error),
      "oslo.yaml:14:14: error: observer.elevation = 2500 km is above the top of the atmosphere\n"
      "   14 |   elevation: 2500 km\n"
      "      |              ^~~~~~~  allowed: -500 m to 100 km");
}

TEST(FormatError, WithoutAPlaceGivesFileAndMessage) {
  EXPECT_EQ(format_error({ErrorCode::missing_input, "no such file", {.file = "a.yaml"}, ""}),
            "a.yaml: error: no such file");
  EXPECT_EQ(format_error({ErrorCode::internal, "boom"}), "error: boom");
}

/// A fuzzer's finding: a batch table in another encoding was printed byte by byte.
TEST(FormatError, BytesThatAreNoTextAreReplaced) {
  const std::string text = format_error({ErrorCode::invalid_input,
                                         "a = '\xff\x1b[31m' is no number",
                                         {"rows.csv", 2, 1, 1, "\xc0\x80,\t\u00e9,\x07"}});
  EXPECT_EQ(text,
            "rows.csv:2:1: error: a = '??[31m' is no number\n"
            "    2 | ??,\t\u00e9,?\n"
            "      | ^");
}

TEST(Shown, IsCutBetweenCharacters) {
  std::string text = "x";
  for (int i = 0; i < 60; ++i) text += "\u00e9";
  const std::string cut = shown(text);
  EXPECT_EQ(cut.size(), 1u + 29 * 2 + 3);
  EXPECT_EQ(printable(cut), cut);
  EXPECT_EQ(shown("short \u00e9"), "short \u00e9");
  EXPECT_EQ(beginning("\u00e9\u00e9", 3), "\u00e9");
  EXPECT_EQ(beginning("\u2212", 2), "");
}

TEST(Printable, KeepsTextAndReplacesEveryOtherByte) {
  const std::string good = "tab\t, line\n, \u00e9, \u2212, \U0001F31E";
  EXPECT_EQ(printable(good), good);
  EXPECT_EQ(printable("\xed\xa0\x80"), "???") << "a surrogate";
  EXPECT_EQ(printable("\xc0\xaf"), "??") << "an overlong form";
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "????") << "beyond U+10FFFF";
  EXPECT_EQ(printable("\xe2\x88"), "??") << "cut short";
}

TEST(NearestName, FindsATypingSlipAndRefusesAStranger) {
  const std::vector<std::string> names{"latitude", "longitude", "height"};
  EXPECT_EQ(nearest_name("lattitude", names), "latitude");
  EXPECT_EQ(nearest_name("longitud", names), "longitude");
  EXPECT_EQ(nearest_name("zzz", names), std::nullopt);
  EXPECT_EQ(nearest_name("", names), std::nullopt);
}

TEST(Result, HoldsEitherSide) {
  const Result<int> good = 4;
  const Result<int> bad = Error{ErrorCode::invalid_input, "no"};
  EXPECT_TRUE(good);
  EXPECT_EQ(*good, 4);
  EXPECT_FALSE(bad);
  EXPECT_EQ(bad.error().message, "no");
}

}  // namespace
