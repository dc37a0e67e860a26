#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "diff/sample_result.h"
#include "diff/wording.h"

namespace skylapse::diff {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(SummaryLine, SaysWhatMovedWhereInTheSkyAndByHowMuch) {
  PairResult pair = sample_pair("f.0003.exr");
  fail_measure(pair, "relative.max", 0.94, place_at(180, 40, 182.4, 40.1, "sun's disc"));
  fail_measure(pair, "sun.shift_deg", 0.31, place_at(180, 40, 182.4, 40.1, "sun's disc"));
  EXPECT_EQ(summary_line(pair),
            "different  f.0003.exr  sun's disc 0.31 deg off (az 182.4, el 40.1); relative.max 94 % "
            "(limit 1 %) at (180, 40), sun's disc, az 182.4, el 40.1");
}

TEST(SummaryLine, FindingsOfStructureComeFirstAndAreCounted) {
  PairResult pair = sample_pair("f.exr");
  fail_measure(pair, "relative.max", 0.5);
  pair.findings.push_back({Verdict::warning, "stored-type", "float became half", std::nullopt});
  pair.findings.push_back(
      {Verdict::different, "nan", "one sample is NaN in B", place_at(200, 100, 0, 0, "")});
  EXPECT_THAT(summary_line(pair),
              StartsWith("different  f.exr  nan: one sample is NaN in B (+1 more); relative.max"));
}

TEST(SummaryLine, UnreadableFilesSayWhyAndNothingElse) {
  PairResult pair = unreadable_pair("f.exr");
  pair.error->message = "out/f.exr: cut short\nat row 5";
  EXPECT_EQ(summary_line(pair), "unreadable f.exr  out/f.exr: cut short at row 5");
}

TEST(SummaryLine, TheMeasureFarthestBeyondItsLimitIsNamed) {
  PairResult pair = sample_pair("f.exr");
  fail_measure(pair, "relative.max", 0.05);  // 5 times
  fail_measure(pair, "relative.rms", 0.04);  // 20 times
  EXPECT_THAT(summary_line(pair), HasSubstr("relative.rms 4 % (limit 0.2 %)"));
}

TEST(SummaryLine, MeasuresOfTheWholePictureBorrowAPlace) {
  PairResult pair = sample_pair("f.exr");
  fail_measure(pair, "relative.rms", 0.4);
  fail_measure(pair, "relative.max", 0.5, place_at(64, 32, 202.7, 78.6, "zenith"));
  EXPECT_THAT(summary_line(pair),
              HasSubstr("relative.rms 40 % (limit 0.2 %), worst at (64, 32), zenith, az 202.7"));
}

TEST(SummaryLine, NothingInAPairCanSteerATerminalOrBreakTheLine) {
  PairResult pair = sample_pair("a\x1b[2J\nb\xff.exr");
  pair.findings.push_back({Verdict::different, "size", "127\trows\r\n", std::nullopt});
  pair.verdict = Verdict::different;
  for (const char c : summary_line(pair)) EXPECT_GE(static_cast<unsigned char>(c), 0x20);
  EXPECT_THAT(summary_line(pair), HasSubstr("a?[2J b?.exr"));
}

TEST(SummaryLine, NumbersThatAreNotFiniteAreWords) {
  PairResult pair = sample_pair("f.exr");
  fail_measure(pair, "relative.max", std::numeric_limits<double>::quiet_NaN());
  EXPECT_THAT(summary_line(pair), HasSubstr("relative.max not a number"));
  measure_of(pair, "relative.max").value = std::numeric_limits<double>::infinity();
  EXPECT_THAT(summary_line(pair), HasSubstr("relative.max infinite"));
}

TEST(SummaryLine, EqualPairsSaySo) {
  PairResult pair = sample_pair("f.exr");
  EXPECT_EQ(summary_line(pair),
            "same       f.exr  nearest to its limit: relative.max 0.01 % (limit 1 %) at (180, 40), "
            "sun's disc, az 182.4, el 40.1");
  for (MeasuredValue& m : pair.measures) m.value = 0;
  EXPECT_EQ(summary_line(pair), "same       f.exr  no difference");
}

TEST(SummaryLine, AWarningNamesTheLimitOfWarnings) {
  PairResult pair = sample_pair("f.exr");
  pair.verdict = Verdict::warning;
  MeasuredValue& m = measure_of(pair, "relative.max");
  m.value = 0.006, m.verdict = Verdict::warning, m.place.reset();
  EXPECT_EQ(summary_line(pair), "warning    f.exr  relative.max 0.6 % (limit 0.5 %)");
}

TEST(SummaryLine, NamesTheGoldenOfAFailure) {
  PairResult pair = sample_pair("f.exr");
  pair.golden = "llvmpipe (LLVM 15.0.6, 256 bits)";
  EXPECT_THAT(summary_line(pair), Not(HasSubstr("golden")));
  fail_measure(pair, "relative.max", 0.5);
  EXPECT_THAT(summary_line(pair), HasSubstr("[golden of llvmpipe (LLVM 15.0.6, 256 bits)]"));
}

TEST(Wording, ValuesHaveThreeDigits) {
  EXPECT_EQ(value_text(0.0104, "%"), "1.04 %");
  EXPECT_EQ(value_text(0.999999, "%"), "100 %");
  EXPECT_EQ(value_text(0, "%"), "0 %");
  EXPECT_EQ(value_text(3e12, ""), "3.00e+12");
  EXPECT_EQ(value_text(1e-12, "deg"), "0 deg");
  EXPECT_EQ(value_text(123456, "px"), "123456 px");
}

TEST(Wording, RatioOfValuesThatMustNotFallTurnsRound) {
  MeasuredValue psnr{"psnr", "dB", 20, kNone, 40, true, Verdict::different, std::nullopt};
  EXPECT_DOUBLE_EQ(limit_ratio(psnr), 2);
  psnr.value = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(limit_ratio(psnr), 0);
  psnr.value = 0;
  EXPECT_TRUE(std::isinf(limit_ratio(psnr)));
  EXPECT_TRUE(std::isinf(limit_ratio(measured("relative.max", "%", 1e-9, kNone, 0))));
  EXPECT_EQ(limit_ratio(measured("relative.max", "%", 0, kNone, 0)), 0);
}

TEST(Wording, TheWorstComesFirst) {
  std::vector<PairResult> pairs{sample_pair("same"), sample_pair("ratio"), sample_pair("moved"),
                                sample_pair("nan"), unreadable_pair("cut")};
  fail_measure(pairs[1], "relative.max", 5);
  fail_measure(pairs[2], "sun.shift_deg", 0.06);
  pairs[3].verdict = Verdict::different;
  pairs[3].findings.push_back({Verdict::different, "nan", "NaN", std::nullopt});
  EXPECT_EQ(worst_first(pairs), (std::vector<size_t>{4, 3, 2, 1, 0}));
}

}  // namespace
}  // namespace skylapse::diff
