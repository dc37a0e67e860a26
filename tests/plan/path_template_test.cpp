#include "plan/path_template.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "config/path_template.h"

using namespace skylapse::plan;

TEST(PathTemplate, NumbersArePaddedToTheRunOfHashes) {
  EXPECT_EQ(expand_number("a.####.png", 7), "a.0007.png");
  EXPECT_EQ(expand_number("a.##.png", 12345), "a.12345.png");
  EXPECT_EQ(expand_number("a.png", 7), "a.png");
}

TEST(PathTemplate, ValuesNeverBringFoldersOrSpacesIntoAName) {
  PathValues values;
  values.site = "Sao Paulo/../x";
  EXPECT_EQ(expand_tokens("{site}.png", values), "Sao-Paulo-..-x.png");
}

TEST(PathTemplate, TokensWithoutAValueStay) {
  PathValues values;
  values.date = "2026-06-21";
  EXPECT_EQ(expand_tokens("{date}_{face}.png", values), "2026-06-21_{face}.png");
}

TEST(PathTemplate, AValueThatLooksLikeATokenIsNotExpandedAgain) {
  PathValues values;
  values.site = "{date}";
  values.date = "2026-06-21";
  EXPECT_EQ(expand_tokens("{site}", values), "-date-");
}

TEST(PathTemplate, EveryTokenThatAConfigMayUseIsFilled) {
  const PathValues values{"s", "d", "t", "c", "2", "a", "+1", "morning", "2k", "px", "0"};
  for (const std::string& token : skylapse::config::path_token_names())
    EXPECT_EQ(expand_tokens(fmt::format("{{{}}}", token), values).find('{'), std::string::npos)
        << token;
}
