#include "diff/page.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "diff/sample_pictures.h"
#include "diff/sample_result.h"
#include "support/temporary_folder.h"

namespace skylapse::diff {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

Result<PairEvidence> nothing(const PairResult&) {
  return Error{ErrorCode::missing_input, "the file has gone", {}, {}};
}

Json data_of(const std::string& page) {
  const std::string mark = R"(id="data">)";
  const size_t begin = page.find(mark) + mark.size();
  return Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

/// One pair of everything, for the browser.
class Sample {
 public:
  Sample() {
    result_ = {"golden", "out", {}, {}, Verdict::different, true, 0, 1.25};
    result_.findings.push_back(
        {Verdict::different, "sequence.missing", "f.0009.exr is missing in B", {}});
    add_moved_sun();
    add_odd_samples();
    add_size();
    add_display();
    add_warning();
    PairResult cut = unreadable_pair("site/f.0005.exr");
    result_.pairs.push_back(cut);
    add("site/f.0006.exr", sample_sky(180), sample_sky(180));
    PairResult gone = sample_pair("gone.exr");
    result_.pairs.push_back(gone);
  }

  [[nodiscard]] const DiffResult& result() const { return result_; }
  [[nodiscard]] EvidenceSource evidence() const {
    return [this](const PairResult& pair) -> Result<PairEvidence> {
      const auto found = evidence_.find(pair.name);
      if (found == evidence_.end()) return nothing(pair);
      return found->second;
    };
  }

 private:
  PairResult& add(const std::string& name, image::Picture a, image::Picture b) {
    PairResult pair = sample_pair(name);
    pair.a.width = a.width, pair.a.height = a.height;
    pair.b.width = b.width, pair.b.height = b.height;
    evidence_[name] = evidence_of(std::move(a), std::move(b));
    result_.pairs.push_back(pair);
    return result_.pairs.back();
  }
  void add_moved_sun() {
    PairResult& p = add("site/f.0001.exr", sample_sky(180), sample_sky(184));
    p.view.camera = sample_camera();
    const auto seen = direction_at(*p.view.camera, {180.5, 40.5});
    p.view.sun = seen;
    const Place place =
        place_at(180, 40, azimuth(*seen).in(deg), elevation(*seen).in(deg), "sun's disc");
    fail_measure(p, "relative.max", 0.998, place);
    fail_measure(p, "sun.shift_deg", 4.3, place);
  }
  void add_odd_samples() {
    const auto b = changed(sample_sky(180), [](float* rgb, int x, int y) {
      if (x == 200 && y == 100) rgb[1] = std::numeric_limits<float>::quiet_NaN();
      if (x == 20 && y == 20) rgb[0] = std::numeric_limits<float>::infinity();
      if (x == 60 && y == 60) rgb[0] = rgb[1] = rgb[2] = -1;
    });
    PairResult& p = add("site/<b>\"f&.0002'.exr", sample_sky(180), b);
    p.verdict = Verdict::different;
    p.findings.push_back({Verdict::different, "nan", "one sample is NaN in B alone",
                          place_at(200, 100, 0, 0, "ground")});
    p.findings.push_back({Verdict::different, "inf", "one sample is infinite in B alone",
                          place_at(20, 20, 0, 0, "zenith")});
    p.findings.push_back({Verdict::different, "negative", "one pixel has become negative",
                          place_at(60, 60, 0, 0, "")});
    fail_measure(p, "relative.max", std::numeric_limits<double>::infinity());
  }
  void add_size() {
    PairResult& p = add("site/f.0003.exr", sample_sky(180), sample_sky(180, 5000, 256, 127));
    p.measures.clear();
    p.verdict = Verdict::different;
    p.findings.push_back({Verdict::different, "size", "256 x 128 against 256 x 127", {}});
  }
  void add_display() {
    image::Picture a = changed(sample_sky(180), [](float* rgb, int, int) {
      for (int c = 0; c < 3; ++c) rgb[c] = std::floor(255 * rgb[c] / (1 + rgb[c])) / 255;
    });
    a.display_referred = true;
    const auto b = changed(a, [](float* rgb, int x, int) {
      if (x > 128) rgb[2] = std::min(1.f, rgb[2] + 3 / 255.f);
    });
    PairResult& p = add("shown.png", a, b);
    p.measures = {
        measured("display.max", "code values", 3, 1, 2, place_at(129, 0, 0, 0, "zenith"))};
    p.verdict = Verdict::different;
  }
  void add_warning() {
    PairResult& p =
        add("site/f.0004.exr", sample_sky(180), changed(sample_sky(180), [](float* rgb, int, int) {
              for (int c = 0; c < 3; ++c) rgb[c] *= 1.006f;
            }));
    measure_of(p, "relative.max") =
        measured("relative.max", "%", 0.006, 0.005, 0.01, place_at(3, 4, 0, 0, "sky"));
    p.findings.push_back({Verdict::warning, "stored-type", "float became half", {}});
    p.verdict = Verdict::warning;
  }

  DiffResult result_;
  std::map<std::string, PairEvidence> evidence_;
};

DiffResult many(size_t count) {
  DiffResult result{"golden", "out", {}, {}, Verdict::different, false, 0, 60};
  for (size_t i = 0; i < count; ++i) {
    PairResult pair = sample_pair("site_of_a_sequence/frame." + std::to_string(10000 + i) + ".exr");
    pair.b.renderer = "llvmpipe (LLVM 15.0.6, 256 bits)";
    for (int m = 0; m < 46; ++m)
      pair.measures.push_back(measured("region." + std::to_string(m) + ".rms", "%",
                                       1e-6 * double(i + m), 0.001, 0.002,
                                       place_at(int(i), m, 12.345678, 45.678912, "horizon ring")));
    if (i % 50 == 7) fail_measure(pair, "relative.max", 0.01 * double(i + 2));
    result.pairs.push_back(pair);
  }
  return result;
}

/// Where the browser's tests look for a page; else a folder that goes away.
std::filesystem::path page_folder(const TemporaryFolder& folder) {
  const char* named = std::getenv("SKYLAPSE_DIFF_PAGE");
  return named != nullptr ? named : folder.path();
}

TEST(DiffPage, HoldsThePixelsOfTheWorstPairsAlone) {
  const Sample sample;
  PageOptions options;
  options.pictures = 4;
  const std::string page = page_of(sample.result(), sample.evidence(), options);
  const Json data = data_of(page);
  ASSERT_EQ(data["pairs"].size(), 8u);
  EXPECT_EQ(data["pairs"][0]["v"], 3) << "what cannot be read comes first";
  EXPECT_EQ(data["pairs"][0]["pic"]["note"], "out/site/f.0005.exr: the file is cut short");
  EXPECT_TRUE(data["pairs"][3].contains("pic"));
  EXPECT_FALSE(data["pairs"][4].contains("pic"));
  EXPECT_THAT(page, HasSubstr("id=\"a1\">"));
  EXPECT_THAT(page, Not(HasSubstr("id=\"a4\">")));
}

TEST(DiffPage, LeavesOutThePicturesThatWouldMakeItTooLarge) {
  const Sample sample;
  PageOptions options;
  options.max_bytes = 80'000;
  const std::string page = page_of(sample.result(), sample.evidence(), options);
  EXPECT_THAT(page, HasSubstr("id=\"a1\">"));
  EXPECT_THAT(page, HasSubstr("those of worse pairs fill this page"));
  EXPECT_LT(page.size(), 80'000 + page_of(sample.result(), nothing, options).size());
}

TEST(DiffPage, NeedsNoNetworkAndHoldsNamesAsText) {
  const Sample sample;
  const std::string page = page_of(sample.result(), sample.evidence(), {});
  for (const char* link : {"http://", "https://", "src=", "@import", "<link rel=\"stylesheet"})
    EXPECT_THAT(page, Not(HasSubstr(link)));
  EXPECT_THAT(page, Not(HasSubstr("<b>\"f&")));
}

TEST(DiffPage, NumbersThatAreNotFiniteSurvive) {
  const Sample sample;
  const Json pairs = data_of(page_of(sample.result(), sample.evidence(), {}))["pairs"];
  EXPECT_EQ(pairs[1]["m"][0][1], "Infinity");
}

TEST(DiffPage, IsWholeWithoutPairsAndWithoutPictures) {
  const std::string empty = page_of({}, nothing, {});
  EXPECT_THAT(empty, HasSubstr("</html>"));
  EXPECT_TRUE(data_of(empty)["pairs"].empty());
  const Sample sample;
  const Json pairs = data_of(page_of(sample.result(), nothing, {}))["pairs"];
  EXPECT_EQ(pairs[7]["pic"]["note"], "the file has gone");
}

TEST(DiffPage, OfFiveThousandPairsTakesLessThanTwentyMegabytes) {
  const TemporaryFolder folder;
  const std::string page = page_of(many(5000), nothing, {});
  EXPECT_LT(page.size(), 20e6);
  EXPECT_GT(page.size(), 5000 * 100);
  EXPECT_TRUE(write_report((page_folder(folder) / "many.html").string(), page).ok());
}

TEST(DiffPage, WritesItsFiles) {
  const TemporaryFolder folder;
  const Sample sample;
  for (const auto& [name, page] :
       {std::pair("index.html", page_of(sample.result(), sample.evidence(), {})),
        {"empty.html", page_of({}, nothing, {})}})
    EXPECT_TRUE(write_report((page_folder(folder) / name).string(), page).ok());
}

}  // namespace
}  // namespace skylapse::diff
