// Inputs made to exhaust time or memory. What is asserted is that work is bounded by count, so the
// tests mean the same on any machine; the refusals take milliseconds.
#include <gtest/gtest.h>

#include "config/job_text.h"
#include "config/yaml_reader.h"
#include "core/printable.h"

namespace skylapse::config {
namespace {

using test::errors_of;
using test::kSmallJob;
using test::with;

/// Every way to repeat a piece of text until the file is as long as allowed.
std::string repeated(const std::string& piece, size_t bytes) {
  std::string text;
  text.reserve(bytes + piece.size());
  while (text.size() + piece.size() <= bytes) text += piece;
  return text;
}

size_t count_nodes(const Node& node) {
  size_t count = 1;
  for (const Node& item : node.items) count += count_nodes(item);
  for (const MapEntry& entry : node.entries) count += count_nodes(entry.value);
  return count;
}

TEST(HostileInput, AnAliasBombStopsAtTheNodeLimit) {
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 30; ++i) {
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int j = 0; j < 9; ++j) bomb += (j ? ", *a" : "*a") + std::to_string(i - 1);
    bomb += "]\n";
  }
  const auto errors = errors_of(bomb);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].find("allowed: at most 100000"), std::string::npos) << errors[0];
}

TEST(HostileInput, AliasesOfLongTextStopAtTheTextLimit) {
  const auto errors =
      errors_of("a: &a " + std::string(4000, 'x') + "\nb: [" + repeated("*a, ", 40000) + "*a]\n");
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].find("too much text"), std::string::npos) << errors[0];
}

TEST(HostileInput, AnAliasOfItselfIsRefused) {
  for (const char* text : {"a: &a [*a]\n", "a: &a {b: *a}\n", "&a [1, *a]\n"}) {
    const auto errors = errors_of(text);
    ASSERT_EQ(errors.size(), 1u) << text;
    EXPECT_NE(errors[0].find("alias"), std::string::npos) << errors[0];
  }
}

TEST(HostileInput, NestingStopsAtTheDepthLimitHoweverItIsWritten) {
  std::string aliases = "a0: &a0 [1]\n";
  for (int i = 1; i < 2000; ++i)
    aliases += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [*a" +
               std::to_string(i - 1) + "]\n";
  std::string blocks;
  for (int i = 0; i < 400; ++i) blocks += std::string(i, ' ') + "a:\n";
  for (const std::string& text :
       {"a: " + std::string(1000, '[') + std::string(1000, ']'), aliases, blocks,
        "a: " + repeated("{a: ", 4000), repeated("- ", 100000), repeated(": ", 100000)}) {
    const auto errors = errors_of(text);
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_NE(errors[0].find("allowed: at most 24 levels"), std::string::npos) << errors[0];
  }
}

TEST(HostileInput, TreesStayWithinTheirLimits) {
  SourceSet sources;
  ErrorList errors;
  YamlLimits limits;
  limits.nodes = 1000;
  sources.add("x", "[" + repeated("a, ", 2900) + "a]");
  const auto root = read_yaml(sources, 0, errors, limits);
  ASSERT_TRUE(root.has_value());
  EXPECT_LE(count_nodes(*root), limits.nodes);
  sources.add("y", "[" + repeated("a, ", 6000) + "a]");
  EXPECT_FALSE(read_yaml(sources, 1, errors, limits).has_value());
}

TEST(HostileInput, FullLengthFilesOfOneCharacterAreRefused) {
  for (const char* piece :
       {"[",   "{",    "]",           "}",     "? ",     "\"",     "'",    "&a ",  "!",
        "!a ", "*a ",  "%YAML 1.1\n", "---\n", ",",      ":",      "|",    ">",    "@",
        "`",   "a:\n", "- a\n",       "a ",    "\"a\" ", "a: [\n", "{a, ", "[a: ", "\t",
        " ",   "\n",   "#",           "...\n", "a",      "?",      "&",    "*"})
    EXPECT_FALSE(errors_of(repeated(piece, YamlLimits{}.bytes)).empty()) << piece;
}

TEST(HostileInput, ATooLongFileIsNotParsedAtAll) {
  const auto errors = errors_of(repeated("a", YamlLimits{}.bytes + 1));
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].find("the file has 262145 bytes"), std::string::npos) << errors[0];
}

TEST(HostileInput, ReportsStayShort) {
  std::string keys;
  for (int i = 0; keys.size() < 200'000; ++i) keys += "key" + std::to_string(i) + ": 1\n";
  const auto errors = errors_of(keys);
  ASSERT_EQ(errors.size(), ErrorList::kMax + 1);
  EXPECT_NE(errors.back().find("more errors in this job are not listed"), std::string::npos);
}

TEST(HostileInput, AVeryLongLineIsCutInMessages) {
  const auto job = parse_job("title: " + std::string(4000, 'x') + "\n", "job.yaml");
  ASSERT_FALSE(job.ok());
  for (const Error& error : job.error()) {
    EXPECT_LT(error.span.source_line.size(), 300u);
    EXPECT_LT(error.message.size(), 300u);
    EXPECT_LE(error.span.length, 300);
  }
}

/// Columns in one long line once took time in proportion to the line, for every value in it.
TEST(HostileInput, ManyValuesInOneLineHaveTheirColumnsAtOnce) {
  std::string line;
  for (size_t i = 0; i < 1'000'000; ++i) line += "\u00e9";
  SourceSet sources;
  sources.add("x", line);
  for (int i = 0; i < 100'000; ++i) EXPECT_EQ(sources.span({0, 1, 2 * i + 1, 2}).column, i + 1);
}

TEST(HostileInput, TextFromTheFileCannotSteerTheTerminal) {
  const auto job =
      parse_job("\"\\e[31mkey\": 1\ntitle: \"\\x07\"\nsky: {model: \"\\e[2J\"}\n", "job.yaml");
  ASSERT_FALSE(job.ok());
  for (const Error& error : job.error())
    for (const char c : format_error(error))
      EXPECT_TRUE(c == '\n' || c == '\t' || c < 0 || c >= 0x20);
}

/// A fuzzer's finding: values were cut at a byte, and JSON cannot carry half a character.
TEST(HostileInput, ALongValueIsCutBetweenCharactersInMessages) {
  for (const char* indent : {"", "x"}) {
    std::string value = indent;
    for (int i = 0; i < 80; ++i) value += "\u00e9";
    for (const char* key : {"title", "step", "look_at", value.c_str()}) {
      const auto job = parse_job("time: {" + std::string(key) + ": \"" + value + "\"}\n", "j.yaml");
      ASSERT_FALSE(job.ok());
      for (const Error& error : job.error()) {
        EXPECT_EQ(printable(error.message), error.message);
        EXPECT_EQ(printable(error.hint), error.hint);
      }
    }
  }
}

TEST(HostileInput, AThousandMillionFramesAreRefusedByArithmetic) {
  const std::string step = with(kSmallJob, "step: 10 min", "step: 1 ms");
  const auto errors = errors_of(step);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].substr(0, errors[0].find(" |")),
            "2 [1 ms] this job asks for up to 9.36e+07 frames");
  for (const char* time : {"{zone: UTC, dates: 1900-01-01 .. 2199-12-31, step: 1 min}",
                           "{zone: UTC, dates: 1900-01-01 .. 2199-12-31, frames: 1000000}",
                           "{zone: UTC, dates: 1900-01-01 .. 2199-12-31, every: 0.01 deg}",
                           "{zone: UTC, from: 1900-01-01 00:00, to: 2199-12-31 00:00, step: 1 s}",
                           "{zone: UTC, date: 2026-06-21, frames: 1000000000}",
                           "{zone: UTC, date: 2026-06-21, frames: 99999999999999999999}"})
    EXPECT_EQ(
        errors_of(with(kSmallJob, "{zone: Europe/Prague, date: 2026-06-21, step: 10 min}", time))
            .size(),
        1u)
        << time;
}

TEST(HostileInput, DaysSearchedForEventsAreRefusedByArithmetic) {
  const auto error_at = [](const std::string& time) {
    return test::error_of(
        with(kSmallJob, "{zone: Europe/Prague, date: 2026-06-21, step: 10 min}", time));
  };
  EXPECT_EQ(error_at("{zone: UTC, dates: 1900-01-01 .. 2199-12-31, at: [sunrise]}"),
            "2 [[] the events of up to 109573 days would have to be found | allowed: at most 10000 "
            "days and locations together; use fewer, or clock times");
  for (const char* time :
       {"{zone: UTC, dates: 1900-01-01 .. 2199-12-31, from: sunrise, frames: 1}",
        "{zone: UTC, dates: 1900-01-01 .. 2019-12-31, every: 90 deg}",
        "{zone: UTC, from: 1900-01-01 00:00, to: 2199-12-31 00:00, every: 90 deg}"})
    EXPECT_NE(error_at(time).find("would have to be found"), std::string::npos) << time;
  for (const char* time : {"{zone: UTC, dates: 1900-01-01 .. 2199-12-31, at: ['12:00']}",
                           "{zone: UTC, dates: 2000-01-01 .. 2026-12-31, at: [sunrise, sunset]}"})
    EXPECT_EQ(error_at(time), "no error");
}

TEST(HostileInput, ListsMultiplyIntoTheFrameCount) {
  std::string turbidities;
  for (int i = 0; i < 900; ++i) turbidities += (i ? ", " : "") + std::to_string(1 + i * 0.01);
  std::string albedos;
  for (int i = 0; i < 900; ++i) albedos += (i ? ", " : "") + std::to_string(i * 0.001);
  const auto errors = errors_of(kSmallJob + "air: {turbidity: [" + turbidities +
                                "], ground_albedo: [" + albedos + "]}\n");
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].find("asks for up to"), std::string::npos) << errors[0];
}

TEST(HostileInput, ImagesOfAMillionPixelsASideAreRefused) {
  for (const char* size :
       {"1000000x1000000", "65537x1", "1x65537", "65536x65536", "0x10", "10x0", "-5x5",
        "99999999999999999999x1", "1e3x1e3", "x", "10x", "x10", "10x10x10"})
    EXPECT_EQ(
        errors_of(with(kSmallJob, "look_at: west", std::string("look_at: west, size: ") + size))
            .size(),
        1u)
        << size;
  EXPECT_TRUE(
      errors_of(with(kSmallJob, "look_at: west", "look_at: west, size: 32768x32768")).empty());
  EXPECT_EQ(errors_of(with(kSmallJob, "look_at: west", "projection: cube, size: 20000")).size(),
            1u);
}

TEST(HostileInput, OverridesAreBoundedToo) {
  std::string deep = "a";
  for (int i = 0; i < 100'000; ++i) deep += ".a";
  EXPECT_EQ(errors_of(kSmallJob, {{deep, "1"}}).size(), 1u);
  EXPECT_EQ(errors_of(kSmallJob, {{"title", std::string(300'000, 'x')}}).size(), 1u);
  EXPECT_EQ(errors_of(kSmallJob, {{"outputs.99999999999999999999.image", "a.png"}}).size(), 1u);
  EXPECT_EQ(errors_of(kSmallJob, {{std::string("ti\0tle", 6), "1"}}).size(), 1u);
}

}  // namespace
}  // namespace skylapse::config
