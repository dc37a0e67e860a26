#include "study/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "output/atomic_file.h"
#include "study/run_study.h"
#include "study/sample_study.h"
#include "study/svg_chart.h"

namespace skylapse::study {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// SKYLAPSE_STUDY_REPORT names the folder for the test of the page in a browser.
TEST(StudyReport, WritesItsFiles) {
  const char* wanted = std::getenv("SKYLAPSE_STUDY_REPORT");
  const std::filesystem::path folder =
      wanted != nullptr ? std::filesystem::path(wanted)
                        : std::filesystem::path(::testing::TempDir()) / "study_report";
  const Status written = write_study(sample_study(), folder);
  ASSERT_TRUE(written) << written.error().message;
  for (const char* name : {"study.csv", "report.html", "figures/pareto_noon.svg"})
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
}

TEST(StudyReport, LoadsNothingFromElsewhere) {
  const auto html = report_html(sample_study());
  ASSERT_TRUE(html) << html.error().message;
  for (const char* mark : {"http-equiv", "src=\"http", "href=\"http", "@import", "url(http"})
    EXPECT_THAT(*html, Not(HasSubstr(mark)));
  // Placeholders were all filled.
  for (const char* mark : {"<!--style", "<!--data", "<!--script", "<!--figures", "<!--multiples"})
    EXPECT_THAT(*html, Not(HasSubstr(mark)));
}

TEST(StudyReport, TextOfTheUserCannotBecomeMarkup) {
  const auto html = report_html(sample_study());
  ASSERT_TRUE(html);
  EXPECT_THAT(*html, Not(HasSubstr("--output <out>")));
}

TEST(StudyFigures, OneForEachScene) {
  const auto figures = figures_of(sample_study());
  ASSERT_GE(figures.size(), 2u);
  EXPECT_EQ(figures[0].name, "pareto_noon");
  EXPECT_THAT(figures[0].svg, HasSubstr("Rung middle"));
}

TEST(LogAxis, PutsDecadesEvenly) {
  const LogAxis axis{1, 100, 0, 10};
  EXPECT_DOUBLE_EQ(axis(10), 5);
  EXPECT_DOUBLE_EQ(axis(1000), 10);  // on the end that it lies beyond
  EXPECT_EQ(axis.ticks().size(), 7u);
}

TEST(LogAxis, HoldsAllValuesAndIsRounded) {
  const LogAxis axis = axis_for({0.013, 7.1}, 0, 100);
  EXPECT_DOUBLE_EQ(axis.low, 0.01);
  EXPECT_DOUBLE_EQ(axis.high, 10);
}

TEST(LabelPlacer, LabelsCoverNeitherEachOtherNorPoints) {
  LabelPlacer placer({0, 0, 400, 300});
  std::vector<Box> boxes;
  for (int i = 0; i < 12; ++i) {
    const double x = 150 + 8.0 * i, y = 150 + 3.0 * (i % 4);
    const auto place = placer.place(x, y, "a label of a point", 12);
    if (!place.found) continue;
    const Box box{place.x, place.y - 10, text_width("a label of a point", 12), 12};
    for (const Box& other : boxes) EXPECT_FALSE(box.meets(other));
    boxes.push_back(box);
  }
  EXPECT_GE(boxes.size(), 6u);
}

}  // namespace
}  // namespace skylapse::study
