// What a wrong table is answered with: every bad row, at its place.
#include <gtest/gtest.h>

#include "cli/run_program.h"

using namespace skylapse::cli::testing;

namespace {

const std::string kSunHead = "utc,lat_deg,lon_deg,height_m,tt_minus_ut1_s\n";
const std::string kEventHead = "place,lat_deg,lon_deg,height_m,zone,local_date\n";

Outcome sun(const std::string& input) { return run({"sun", "--batch", "-"}, {.input = input}); }
Outcome events(const std::string& input) {
  return run({"events", "--batch", "-"}, {.input = input});
}

void expect_refused(const Outcome& outcome, const std::vector<std::string>& words) {
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  for (const auto& word : words)
    EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " in:\n" << outcome.err;
}

size_t count_of(const std::string& text, const std::string& word) {
  size_t count = 0;
  for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

TEST(SunBatch, FiniteButAbsurdNumbersAreRefusedWithTheirRange) {
  const std::string t = "2026-06-21T00:00Z,";
  expect_refused(sun(kSunHead + t + "50,14,1e300,\n"),
                 {"standard input:2:25: ", "height_m", "-500 to 100000"});
  expect_refused(sun(kSunHead + t + "50,14,0,1e15\n"),
                 {"standard input:2:27: ", "tt_minus_ut1_s", "-100000 to 100000"});
  expect_refused(sun(kSunHead + t + "50,1e9,0,\n"), {"lon_deg", "-720 to 720"});
  expect_refused(sun(kSunHead + t + "-1e200,14,0,\n"), {"lat_deg", "-90 to 90"});
  EXPECT_EQ(sun(kSunHead + t + "90,-720,100000,-1e5\n" + t + "-90,720,-500,1e5\n").exit_code, 0);
  for (const char* place : {"50,14,1e300", "1e300,14", "50,1e300", "50,14,-501", "nan,14"})
    EXPECT_EQ(run({"sun", "--at", place, "--time", "2026-06-21T00:00Z"}).exit_code, 3) << place;
}

TEST(SunBatch, AllBadRowsComeInOneRunInTheOrderOfLines) {
  const auto outcome = sun(kSunHead +
                           "2026-06-21T00:00Z,5o,14,0,\n"      // line 2
                           "2026-06-21T00:00Z,50,14,0,\n"      // good
                           "2026-06-21T00:00Z,50,14\n"         // line 4
                           "2026-13-21T00:00Z,50,14,0,\n"      // line 5
                           "2026-06-21T00:00Z,50,0x10,0,\n");  // line 6: no hexadecimal numbers
  expect_refused(outcome, {"input:2:19: ", "lat_deg = '5o'", "input:4:1: ", "3 fields",
                           "input:5:1: ", "input:6:22: ", "lon_deg = '0x10'", "4 errors"});
  EXPECT_LT(outcome.err.find("input:4:"), outcome.err.find("input:5:"));
  EXPECT_NE(outcome.err.find("2026-06-21T00:00Z,5o,14,0,\n"), std::string::npos)
      << "the row is shown:\n"
      << outcome.err;
}

TEST(SunBatch, AfterTwentyBadRowsItSaysThatThereAreMore) {
  std::string input = kSunHead;
  for (int i = 0; i < 500; ++i) input += "x,0,0,0,\n";
  const auto outcome = sun(input);
  expect_refused(outcome, {"input:21:1: ", "more rows are wrong than these 20"});
  EXPECT_EQ(count_of(outcome.err, "error:"), 21u);
}

TEST(EventsBatch, MessagesNameTheColumnAndPointAtIt) {
  const auto outcome = events(kEventHead +
                              "a,50,14,0,Europe/Praha,2026-06-21\n"
                              "\"b, c\",50,14,0,Europe/Prague,2026-02-30\n"
                              "c,50,400000,0,Europe/Prague,2026-06-21\n");
  expect_refused(outcome, {"input:2:11: error: zone: ", "input:3:30: error: local_date: ",
                           "input:4:6: error: lon_deg"});
  EXPECT_EQ(outcome.err.find("--"), std::string::npos) << outcome.err;
}

TEST(Batch, AnUnclosedQuoteIsCalledSo) {
  const auto outcome = events(kEventHead +
                              "\"a,50,14,0,Europe/Prague,2026-06-21\n"
                              "b,50,14,0,Europe/Prague,2026-06-31\n");
  expect_refused(outcome, {"input:2:1: ", "quote is opened and not closed", "input:3:25: "});
}

/// A fuzzer's finding: it was called an unclosed quote, at column 0.
TEST(Batch, ABlankLineIsPassedOver) {
  const auto outcome = sun("utc,lat_deg,lon_deg,height_m\n \t\n2026-06-21T00:00Z,50,14,0\n");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

/// A fuzzer's finding: it ended the row, and the fields after it went into the row as well.
TEST(Batch, ACarriageReturnInsideALineIsRefused) {
  expect_refused(sun(kSunHead + "2026-06-21T00:00Z,50,14\r0,\n"),
                 {"input:2:24: ", "carriage return", "CR LF"});
}

TEST(Batch, AColumnNamedTwiceIsRefused) {
  expect_refused(sun("utc,lat_deg,lon_deg,height_m,lat_deg\n"),
                 {"input:1:30: ", "'lat_deg' is named twice"});
}

TEST(Batch, AFolderIsNoFile) {
  for (const char* command : {"sun", "events"}) {
    const auto outcome = run({command, "--batch", "/tmp"});
    EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
    EXPECT_NE(outcome.err.find("cannot be read"), std::string::npos);
  }
  EXPECT_EQ(run({"probe", "--model", "hosek-wilkie", "--batch", "/tmp"}).exit_code, 4);
}

}  // namespace
