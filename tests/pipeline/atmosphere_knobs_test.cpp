// The keys that trade accuracy for time, through to the picture.
#include <cmath>
#include <set>

#include "pipeline/fingerprint.h"
#include "pipeline/job_fixture.h"
#include "pipeline/render_frame.h"

using namespace skylapse;
using namespace skylapse::pipeline;
using namespace skylapse::pipeline::testing;

namespace {

constexpr const char* kMap = "projection: lat-long, size: 32x16";

std::string scene(const std::string& sky, const std::string& camera = kMap,
                  const std::string& height = "235 m", const std::string& time = "solar_noon") {
  return "location: {name: Prague, latitude: 50.0755, longitude: 14.4378, height: " + height +
         "}\ntime: {zone: Europe/Prague, date: 2026-06-21, at: [" + time + "]}\ncamera: {" +
         camera + "}\nsky: {sun_disc: off, " + sky + "}\noutputs: [{image: \"p.####.exr\"}]\n";
}

constexpr const char* kDraft = "model: bruneton, level: draft, wavelengths: 3";

struct Rendered {
  RenderedFrame frame;
  std::optional<AtmosphereRecord> record;
};

/// The first frame of a scene, with the tables in memory alone.
Rendered render(const std::string& text) {
  const auto plan = plan_of_text(text);
  AtmosphereService atmospheres(plan, gpu::Backend::automatic, {}, sky::bruneton::TableCache({}));
  StageTimes times;
  auto rendered = render_frame(plan, plan.frames.front(), atmospheres, false, times);
  EXPECT_TRUE(rendered.ok()) << format_error(rendered.error());
  if (!rendered) return {};
  return {*std::move(rendered), atmospheres.record()};
}

/// Greatest difference of a pixel, relative to the picture's brightest.
double difference(const RenderedFrame& a, const RenderedFrame& b) {
  const auto &x = a.scene.data(), &y = b.scene.data();
  EXPECT_EQ(x.size(), y.size());
  const float brightest = *std::max_element(y.begin(), y.end());
  double worst = 0;
  for (size_t i = 0; i < y.size(); ++i) worst = std::max(worst, double(std::abs(x[i] - y[i])));
  return worst / brightest;
}

const Rendered& draft() {
  static const Rendered made = render(scene(kDraft));
  return made;
}

TEST(AtmosphereKnobs, OneOrderIsSingleScatteringToTheBitAndMakesNoTables) {
  const Rendered one = render(scene(std::string(kDraft) + ", orders: 1"));
  const Rendered single = render(scene("model: single-scattering, wavelengths: 3"));
  EXPECT_EQ(one.frame.scene.data(), single.frame.scene.data());
  EXPECT_TRUE(one.record->tables.empty());
}

TEST(AtmosphereKnobs, OrdersAreComputedAsAskedAndApproachAllFromBelow) {
  double before = 0;
  for (const int orders : {1, 2, 4}) {
    const Rendered some =
        render(scene(std::string(kDraft) + ", orders: " + std::to_string(orders)));
    EXPECT_EQ(some.record->tables.size(), orders > 1 ? 1u : 0u);
    for (const auto& tables : some.record->tables) EXPECT_EQ(tables.orders, orders);
    const double light = some.frame.sky_irradiance_xyz.y;
    EXPECT_GT(light, before);
    EXPECT_LT(light, draft().frame.sky_irradiance_xyz.y);
    before = light;
  }
  EXPECT_GT(before, 0.97 * draft().frame.sky_irradiance_xyz.y);
}

TEST(AtmosphereKnobs, DoubleNeedsNoGlAndAgreesWithFloat) {
  const Rendered exact = render(scene(std::string(kDraft) + ", precision: double"));
  EXPECT_EQ(exact.record->context.backend, "processor");
  ASSERT_EQ(exact.record->tables.size(), 1u);
  // The parity tests' bound of slices, which is that of the view's columns in the twin.
  EXPECT_LT(difference(draft().frame, exact.frame), 2e-3);
  EXPECT_GT(difference(draft().frame, exact.frame), 0);
}

TEST(AtmosphereKnobs, HalfFloatsChangeThreeDigitsAtMost) {
  const Rendered half = render(scene(std::string(kDraft) + ", precision: half"));
  EXPECT_LT(difference(half.frame, draft().frame), 4.9e-4);  // half_source.h
  EXPECT_GT(difference(half.frame, draft().frame), 0);
}

TEST(AtmosphereKnobs, StepsAndSliceAreObeyed) {
  // 8 steps are up to 3.3 % off, 16 x 32 directions some percent (docs/atmosphere.md).
  for (const char* knob : {"steps: 8", "slice: 16x32"}) {
    const Rendered rough = render(scene(std::string(kDraft) + ", " + knob));
    EXPECT_GT(difference(rough.frame, draft().frame), 1e-6) << knob;
    EXPECT_LT(difference(rough.frame, draft().frame), 0.05) << knob;
  }
}

TEST(AtmosphereKnobs, TheRecordedIrradianceDependsOnNoCamera) {
  const Rendered narrow = render(scene(
      kDraft,
      "projection: perspective, look_at: {azimuth: 10 deg, elevation: 50 deg}, fov: 20 deg, size: "
      "32x16"));
  EXPECT_EQ(narrow.frame.sky_irradiance_xyz, draft().frame.sky_irradiance_xyz);
  EXPECT_GT(narrow.frame.scene.data()[0], 0);
}

TEST(AtmosphereKnobs, PartialTablesAndSlicesAreThePicturesOfFullOnes) {
  const Rendered full = render(scene(std::string(kDraft) + ", effects: all, orders: 4"));
  const Rendered part = render(scene(std::string(kDraft) + ", orders: 4"));
  EXPECT_LT(part.record->tables.at(0).bytes, full.record->tables.at(0).bytes / 2);
  EXPECT_LT(difference(part.frame, full.frame), 1e-4);
}

TEST(AtmosphereKnobs, ACameraInSpaceThatLooksAwayFromTheAirMakesNothing) {
  const Rendered dark = render(scene(
      kDraft,
      "projection: perspective, look_at: {azimuth: 10 deg, elevation: 60 deg}, fov: 30 deg, size: "
      "16x9",
      "400 km"));
  EXPECT_FALSE(dark.record.has_value());
  for (const float v : dark.frame.scene.data()) EXPECT_EQ(v, 0);
}

TEST(AtmosphereKnobs, EachIsInTheFingerprint) {
  std::set<std::string> prints;
  const std::vector<std::string> knobs{"",
                                       ", orders: 1",
                                       ", orders: 4",
                                       ", steps: 8",
                                       ", slice: 32x64",
                                       ", precision: half",
                                       ", precision: double",
                                       ", effects: all"};
  for (const std::string& knob : knobs) {
    const auto plan = plan_of_text(scene(kDraft + knob));
    prints.insert(scene_fingerprint(plan, plan.frames.front()));
  }
  EXPECT_EQ(prints.size(), knobs.size());
}

TEST(AtmosphereKnobs, AnotherFramesSunThatWidensTheTablesIsInTheFingerprint) {
  const auto print = [](const std::string& times) {
    const auto plan = plan_of_text(scene(kDraft, kMap, "235 m", times));
    return scene_fingerprint(plan, plan.frames.front());
  };
  EXPECT_NE(print("solar_noon"), print("solar_noon, '21:30'"));
}

}  // namespace
