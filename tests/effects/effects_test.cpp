#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "effects/drawn_scenes.h"
#include "effects/proof.h"

using namespace skylapse;
using namespace skylapse::effects_proof;
using plan::Effect;

namespace {

constexpr uint64_t kSeed = 1;
constexpr int kScenes = 24;       // of the proof; bench_effects takes hundreds
constexpr int kWrongScenes = 60;  // until one must have shown that a rule is wrong

Picture rendered(const std::string& scene, const std::string& effects,
                 const plan::EffectRules& rules = plan::standard_rules()) {
  auto picture = picture_of(scene, effects, rules);
  if (!picture) {
    for (const Error& error : picture.error()) ADD_FAILURE() << format_error(error) << scene;
    throw std::runtime_error("no picture");
  }
  return *std::move(picture);
}

/// `all` of a scene, made once however many rules are tried on it.
const Picture& whole(int number) {
  static std::map<int, Picture> made;
  const auto found = made.find(number);
  if (found != made.end()) return found->second;
  return made.emplace(number, rendered(drawn_scene(kSeed, number, {}), "all")).first->second;
}

TEST(Effects, AutoShowsWhatAllShowsWithinTheStatedBounds) {
  for (int i = 0; i < kScenes; ++i) {
    const std::string scene = drawn_scene(kSeed, i, {});
    const Change change = change_of(rendered(scene, "auto"), whole(i));
    EXPECT_TRUE(change.holds()) << i << ": " << change.text() << "\n" << scene;
  }
}

plan::Verdict never(const plan::Plan&, const plan::Frame&) {
  return {false, "a rule that is wrong", 0, 0};
}

class WrongRule : public testing::TestWithParam<Effect> {};

TEST_P(WrongRule, IsFoundByTheProof) {
  plan::EffectRules rules = plan::standard_rules();
  for (plan::EffectRule& rule : rules)
    if (rule.effect == GetParam()) rule.judge = never;
  for (int i = 0; i < kWrongScenes; ++i)
    if (!change_of(rendered(drawn_scene(kSeed, i, {}), "auto", rules), whole(i)).holds()) return;
  FAIL() << "no scene shows that a rule which always leaves out " << name_of(GetParam())
         << " is wrong";
}

INSTANTIATE_TEST_SUITE_P(Of, WrongRule,
                         testing::Values(Effect::sun_disc, Effect::limb_darkening,
                                         Effect::refraction, Effect::flattening, Effect::ozone,
                                         Effect::aerosol, Effect::multiple_scattering,
                                         Effect::ground, Effect::aerial_perspective),
                         [](const auto& info) {
                           std::string name = name_of(info.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
