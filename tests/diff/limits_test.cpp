#include "diff/limits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diff/judge.h"

namespace skylapse::diff {
namespace {

TEST(Limits, EveryLimitOfEveryProfileIsOfAMeasure) {
  for (const std::string& name : profile_names()) {
    const auto profile = profile_from_name(name);
    ASSERT_TRUE(profile) << name;
    const Limits limits = profile_limits(*profile);
    for (const auto& [measure, limit] : limits.measures) {
      EXPECT_NE(kind_of(measure), nullptr) << measure;
      EXPECT_FALSE(limit.warn > limit.fail) << measure;  // one that is not set is neither
    }
    for (const std::string& check : check_names()) EXPECT_TRUE(limits.checks.contains(check));
  }
}

TEST(Limits, ALooserProfileIsNowhereTighter) {
  const Limits same = profile_limits(Profile::same_renderer);
  const Limits cross = profile_limits(Profile::cross_renderer);
  for (const auto& [measure, limit] : same.measures)
    EXPECT_LE(limit.fail, limit_of(cross, measure).fail) << measure;
}

TEST(Limits, ANameWinsOverAPattern) {
  Limits limits;
  limits.measures["relative.region.*.bias"] = {kNone, 0.1};
  limits.measures["relative.region.disc.bias"] = {kNone, 0.5};
  EXPECT_EQ(limit_of(limits, "relative.region.sky.bias").fail, 0.1);
  EXPECT_EQ(limit_of(limits, "relative.region.disc.bias").fail, 0.5);
  EXPECT_TRUE(std::isnan(limit_of(limits, "relative.bias").fail));
}

TEST(Limits, AreNumbersPercentOrOff) {
  EXPECT_EQ(parse_limit("0.25"), 0.25);
  EXPECT_DOUBLE_EQ(*parse_limit("0.5 %"), 0.005);
  EXPECT_DOUBLE_EQ(*parse_limit("3%"), 0.03);
  EXPECT_TRUE(std::isnan(*parse_limit("off")));
  for (const char* wrong : {"", "%", "-1", "nan", "inf", "1 px", "0.5 %%", "one"})
    EXPECT_FALSE(parse_limit(wrong)) << wrong;
}

TEST(Limits, RulesOfPathsWinInTheirOrder) {
  const auto rules = parse_rules(
      "profile: same-renderer\n"
      "limits: {relative.rms: 1 %}\n"
      "ignore: [\"thumbs/**\"]\n"
      "paths:\n"
      "  - path: \"*.png\"\n"
      "    profile: exact\n"
      "  - path: \"night/**\"\n"
      "    limits:\n"
      "      relative.max: {warn: 2 %, fail: 10 %}\n"
      "      flip.mean: off\n"
      "    checks: {stored-type: ignore}\n"
      "  - path: \"draft.exr\"\n"
      "    ignore: true\n",
      "rules.yaml");
  ASSERT_TRUE(rules.ok()) << format_error(rules.error().front());
  const Limits day = limits_for(*rules, "day/f.0001.exr");
  EXPECT_EQ(day.profile, Profile::same_renderer);
  EXPECT_DOUBLE_EQ(limit_of(day, "relative.rms").fail, 0.01);
  EXPECT_EQ(limits_for(*rules, "day/f.png").profile, Profile::exact);
  const Limits night = limits_for(*rules, "night/deep/f.exr");
  EXPECT_DOUBLE_EQ(limit_of(night, "relative.max").warn, 0.02);
  EXPECT_TRUE(std::isnan(limit_of(night, "flip.mean").fail));
  EXPECT_EQ(severity_of(night, "stored-type"), Severity::ignore);
  EXPECT_TRUE(is_ignored(*rules, "thumbs/1.png"));
  EXPECT_TRUE(is_ignored(*rules, "draft.exr"));
  EXPECT_FALSE(is_ignored(*rules, "day/1.png"));
}

TEST(Rules, AllErrorsAreToldWithTheirPlaces) {
  const auto rules = parse_rules(
      "profil: exact\n"
      "limits: {relative.rsm: 1 %, relative.max: -3}\n"
      "checks: {nan: never, nana: fail}\n"
      "paths:\n"
      "  - limits: {}\n"
      "  - path: a\n"
      "    profile: cross-modle\n",
      "rules.yaml");
  ASSERT_FALSE(rules.ok());
  std::string text;
  for (const Error& error : rules.error()) text += format_error(error) + "\n";
  EXPECT_EQ(rules.error().size(), 7u) << text;
  for (const char* part :
       {"rules.yaml:1:1", "did you mean profile?", "rules.yaml:2:10", "did you mean relative.rms?",
        "'-3' is no limit of relative.max", "'never' is no severity", "did you mean nan?",
        "has no path", "did you mean cross-model?", "rules.yaml:7:14"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(Rules, HalfALimitLeavesTheOtherHalf) {
  const auto rules =
      parse_rules("limits: {relative.max: {warn: 0.05 %}, relative.rms: 3 %}\n", "r");
  ASSERT_TRUE(rules.ok());
  const Limits limits = limits_for(*rules, "x");
  EXPECT_DOUBLE_EQ(limit_of(limits, "relative.max").warn, 0.0005);
  EXPECT_EQ(limit_of(limits, "relative.max").fail,
            limit_of(profile_limits(Profile::cross_renderer), "relative.max").fail);
  EXPECT_TRUE(std::isnan(limit_of(limits, "relative.rms").warn)) << "a plain value only fails";
}

TEST(Rules, APatternCoversTheNamesOfEarlierRules) {
  const auto rules = parse_rules(
      "limits: {relative.region.zenith.bias: 10 %}\n"
      "paths: [{path: \"*\", limits: {relative.region.*.bias: 1 %}}]\n",
      "r");
  ASSERT_TRUE(rules.ok());
  EXPECT_DOUBLE_EQ(limit_of(limits_for(*rules, "x"), "relative.region.zenith.bias").fail, 0.01);
}

TEST(Rules, LimitsThatMeanNothingAreRefused) {
  for (const char* text : {"limits: {relative.max: {warn: 2 %, fail: 1 %}}",
                           "limits: {display.max: 1 %}", "limits: {sun.shift_deg: {fail: 2 %}}"})
    EXPECT_FALSE(parse_rules(text, "r").ok()) << text;
}

TEST(Rules, AnEmptyFileChangesNothing) {
  const auto rules = parse_rules("# nothing\n", "rules.yaml");
  ASSERT_TRUE(rules.ok());
  EXPECT_EQ(limits_for(*rules, "x").profile, Profile::cross_renderer);
}

TEST(Judge, ValuesMeetTheirLimits) {
  Limits limits;
  limits.measures["relative.rms"] = {0.1, 0.2};
  limits.measures["psnr"] = {50, 40};
  const auto verdict = [&](const char* name, double value) {
    return judged({name, value, {}}, limits).verdict;
  };
  EXPECT_EQ(verdict("relative.rms", 0.1), Verdict::same) << "at the limit is within it";
  EXPECT_EQ(verdict("relative.rms", 0.15), Verdict::warning);
  EXPECT_EQ(verdict("relative.rms", 0.3), Verdict::different);
  EXPECT_EQ(verdict("relative.rms", kNone), Verdict::different) << "no number is no pass";
  EXPECT_EQ(verdict("psnr", 60), Verdict::same);
  EXPECT_EQ(verdict("psnr", 45), Verdict::warning);
  EXPECT_EQ(verdict("psnr", 30), Verdict::different);
  EXPECT_EQ(verdict("absolute.max", 1e9), Verdict::same) << "no limit";
}

TEST(Judge, SeverityIsThatOfTheLimits) {
  Limits limits = profile_limits(Profile::cross_renderer);
  limits.checks["nan"] = Severity::ignore;
  PairResult pair;
  pair.findings = {{Verdict::different, "nan", "", {}},
                   {Verdict::different, "stored-type", "", {}}};
  conclude(limits, pair);
  ASSERT_EQ(pair.findings.size(), 1u);
  EXPECT_EQ(pair.verdict, Verdict::warning);
  limits.checks["stored-type"] = Severity::fail;
  conclude(limits, pair);
  EXPECT_EQ(pair.verdict, Verdict::different);
}

}  // namespace
}  // namespace skylapse::diff
