// The quick form of a display transform against OpenColorIO's own, without any optimisation.
#include "output/imageio/staged_processor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "output/imageio/builtin_config.h"

namespace OCIO = OCIO_NAMESPACE;

namespace skylapse::output::imageio {
namespace {

constexpr float kQuarterCode = 0.25f / 255.0f;

OCIO::ConstProcessorRcPtr processor_of(const char* display, const char* view) {
  auto t = OCIO::DisplayViewTransform::Create();
  t->setSrc("Linear Rec.709 (sRGB)");
  t->setDisplay(display);
  t->setView(view);
  return builtin_config()->getProcessor(t);
}

/// Random colours: levels from 2^-16 to 2^16, saturation up to beyond the gamut, and plain greys.
std::vector<float> random_colours(size_t pixels) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> level(-16.0f, 16.0f);
  std::normal_distribution<float> spread(0.0f, 0.5f);
  std::vector<float> rgb;
  for (size_t i = 0; i < pixels; ++i) {
    const float v = std::exp2(level(random));
    for (int c = 0; c < 3; ++c) rgb.push_back(i % 4 == 0 ? v : v * (1.0f + spread(random)));
  }
  return rgb;
}

/// Largest difference of what an 8-bit file would hold.
float difference(const char* display, const char* view, const std::vector<float>& colours) {
  const auto whole = processor_of(display, view);
  const auto staged = StagedProcessor::build(builtin_config(), whole, kQuarterCode);
  EXPECT_NE(staged, nullptr) << display << "/" << view << " should profit";
  if (!staged) return 1;
  auto exact = colours;
  auto quick = colours;
  apply_processor(*whole->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_NONE), exact.data(),
                  exact.size() / 3);
  staged->apply(quick.data(), quick.size() / 3);
  float worst = 0;
  for (size_t i = 0; i < exact.size(); ++i)
    worst = std::max(worst,
                     std::abs(std::clamp(exact[i], 0.0f, 1.0f) - std::clamp(quick[i], 0.0f, 1.0f)));
  return worst;
}

TEST(StagedProcessor, WithinAQuarterOfACodeOfExactOnEveryDisplay) {
  const auto colours = random_colours(1 << 20);
  struct Case {
    const char* display;
    const char* view;
  };
  for (const Case& c : {Case{"sRGB", "ACES SDR"}, Case{"sRGB", "Un-tone-mapped"},
                        Case{"Rec.1886 Rec.709", "ACES SDR"}, Case{"P3-D65", "ACES SDR"},
                        Case{"Rec.2100-PQ", "ACES HDR 1000 nits"}}) {
    const float worst = difference(c.display, c.view, colours);
    RecordProperty(std::string(c.display) + "/" + c.view, std::to_string(worst * 255.0f));
    EXPECT_LT(worst, kQuarterCode) << c.display << "/" << c.view;
    std::printf("%s/%s: greatest difference %.4f of an 8-bit code\n", c.display, c.view,
                static_cast<double>(worst * 255.0f));
  }
}

TEST(StagedProcessor, TransformWithoutCurvesIsLeftToOpenColorIo) {
  auto matrix = OCIO::MatrixTransform::Create();
  const double swap[16] = {0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  matrix->setMatrix(swap);
  EXPECT_EQ(StagedProcessor::build(builtin_config(), builtin_config()->getProcessor(matrix), 1.0f),
            nullptr);
}

TEST(StagedProcessor, ToleranceThatCannotBeMetMeansNoQuickForm) {
  EXPECT_EQ(StagedProcessor::build(builtin_config(), processor_of("sRGB", "ACES SDR"), 0.0f),
            nullptr);
}

TEST(CurveTable, MeetsASmoothCurveOverThirtyOctaves) {
  auto exponent = OCIO::ExponentTransform::Create();
  const double gamma[4] = {0.45, 0.45, 0.45, 1};
  exponent->setValue(gamma);
  const auto cpu = builtin_config()->getProcessor(exponent)->getOptimizedCPUProcessor(
      OCIO::OPTIMIZATION_LOSSLESS);
  const CurveTable table(*cpu);
  std::vector<float> exact;
  for (float v = 1e-6f; v < 1e6f; v *= 1.00137f) exact.insert(exact.end(), {v, 2 * v, 3 * v});
  auto quick = exact;
  apply_processor(*cpu, exact.data(), exact.size() / 3);
  table.apply(quick.data(), quick.size() / 3);
  // Straight lines over 1/128 of an octave: |f''| h^2 / 8 = 0.45 * 0.55 / (8 * 128^2) relative.
  for (size_t i = 0; i < exact.size(); ++i) ASSERT_NEAR(quick[i], exact[i], 4e-6f * exact[i]);
}

}  // namespace
}  // namespace skylapse::output::imageio
