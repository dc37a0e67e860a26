#include "core/result.h"

#include <gtest/gtest.h>

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
