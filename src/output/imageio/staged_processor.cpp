#include "output/imageio/staged_processor.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace OCIO = OCIO_NAMESPACE;

namespace skylapse::output::imageio {
namespace {

constexpr size_t kNodes = 65536;

using Transforms = std::vector<OCIO::ConstTransformRcPtr>;

OCIO::ConstProcessorRcPtr process(const OCIO::ConstConfigRcPtr& config, const Transforms& run) {
  auto group = OCIO::GroupTransform::Create();
  for (const auto& t : run) group->appendTransform(t->createEditableCopy());
  return config->getProcessor(group);
}

/// Whether a table is quicker than the operation itself: not for a matrix or a clamp.
bool is_costly(const OCIO::Transform& t) {
  const auto type = t.getTransformType();
  return type != OCIO::TRANSFORM_TYPE_MATRIX && type != OCIO::TRANSFORM_TYPE_RANGE;
}

/// Colours from black to the sun's brightness and beyond, grey to strongly saturated, some with
/// negative channels: 17 hues x 5 saturations x 120 levels. Deterministic.
std::vector<float> probe_colours() {
  std::vector<float> rgb;
  for (int level = 0; level < 120; ++level)
    for (int hue = 0; hue < 17; ++hue)
      for (int saturation = 0; saturation < 5; ++saturation) {
        const float v = std::exp2(0.25f * static_cast<float>(level) - 20.0f);
        for (int c = 0; c < 3; ++c) {
          const float phase =
              6.2831853f * (static_cast<float>(hue) / 17.0f + static_cast<float>(c) / 3.0f);
          rgb.push_back(v * (1.0f + 0.27f * static_cast<float>(saturation) * std::cos(phase)));
        }
      }
  return rgb;
}

/// Largest difference, both sides limited to the displayable 0..1 (NaN counts as 0, as quantising
/// has it).
float displayed_difference(const std::vector<float>& a, const std::vector<float>& b) {
  const auto shown = [](float v) { return v > 0 ? std::min(v, 1.0f) : 0.0f; };
  float worst = 0;
  for (size_t i = 0; i < a.size(); ++i)
    worst = std::max(worst, std::fabs(shown(a[i]) - shown(b[i])));
  return worst;
}

}  // namespace

void apply_processor(const OCIO::CPUProcessor& processor, float* rgb, size_t pixels) {
  OCIO::PackedImageDesc line(rgb, static_cast<long>(pixels), 1, 3);
  processor.apply(line);
}

CurveTable::CurveTable(const OCIO::CPUProcessor& curve) {
  std::vector<float> grey(3 * kNodes);
  for (size_t i = 0; i < kNodes; ++i) {
    const float x = std::bit_cast<float>(static_cast<uint32_t>(i << 16));
    std::fill_n(grey.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, x);
  }
  apply_processor(curve, grey.data(), kNodes);
  for (size_t c = 0; c < 3; ++c) {
    std::vector<float> channel(kNodes + 1);
    for (size_t i = 0; i < kNodes; ++i) channel[i] = grey[3 * i + c];
    channel[kNodes] = channel[kNodes - 1];
    // The neighbour beyond the largest finite number (either sign) is never Inf or NaN.
    channel[0x7f80] = channel[0x7f7f];
    channel[0xff80] = channel[0xff7f];
    const bool again = c > 0 && std::memcmp(samples_.data() + start_[c - 1], channel.data(),
                                            channel.size() * sizeof(float)) == 0;
    start_[c] = again ? start_[c - 1] : samples_.size();
    if (!again) samples_.insert(samples_.end(), channel.begin(), channel.end());
  }
}

void CurveTable::apply(float* rgb, size_t pixels) const {
  constexpr float kMax = std::numeric_limits<float>::max();
  for (size_t c = 0; c < 3; ++c) {
    const float* const samples = samples_.data() + start_[c];
    for (size_t i = c; i < 3 * pixels; i += 3) {
      // Infinities become the largest numbers; NaN keeps its own entry.
      const float x = rgb[i] > kMax ? kMax : (rgb[i] < -kMax ? -kMax : rgb[i]);
      const auto bits = std::bit_cast<uint32_t>(x);
      const uint32_t node = bits >> 16;
      const float part = static_cast<float>(static_cast<int32_t>(bits & 0xffffU)) * 0x1p-16f;
      rgb[i] = samples[node] + part * (samples[node + 1] - samples[node]);
    }
  }
}

std::unique_ptr<StagedProcessor> StagedProcessor::build(const OCIO::ConstConfigRcPtr& config,
                                                        const OCIO::ConstProcessorRcPtr& whole,
                                                        float tolerance) {
  const auto group =
      whole->getOptimizedProcessor(OCIO::OPTIMIZATION_LOSSLESS)->createGroupTransform();
  auto staged = std::make_unique<StagedProcessor>();
  bool gained = false;
  Transforms run;
  bool run_mixes = false;
  const auto end_run = [&] {
    if (run.empty()) return;
    const auto processor = process(config, run);
    const bool table = !run_mixes && std::any_of(run.begin(), run.end(),
                                                 [](const auto& t) { return is_costly(*t); });
    if (table)
      staged->stages_.emplace_back(
          CurveTable(*processor->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_LOSSLESS)));
    else
      staged->stages_.emplace_back(
          processor->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_VERY_GOOD));
    gained = gained || table;
    run.clear();
  };
  for (int i = 0; i < group->getNumTransforms(); ++i) {
    const OCIO::ConstTransformRcPtr t = group->getTransform(i);
    const bool mixes = process(config, {t})->hasChannelCrosstalk();
    if (mixes != run_mixes) end_run();
    run_mixes = mixes;
    run.push_back(t);
  }
  end_run();
  if (!gained) return nullptr;

  std::vector<float> exact = probe_colours();
  std::vector<float> quick = exact;
  apply_processor(*whole->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_LOSSLESS), exact.data(),
                  exact.size() / 3);
  staged->apply(quick.data(), quick.size() / 3);
  if (displayed_difference(exact, quick) > tolerance) return nullptr;
  return staged;
}

void StagedProcessor::apply(float* rgb, size_t pixels) const {
  for (const Stage& stage : stages_) {
    if (const auto* table = std::get_if<CurveTable>(&stage))
      table->apply(rgb, pixels);
    else
      apply_processor(*std::get<OCIO::ConstCPUProcessorRcPtr>(stage), rgb, pixels);
  }
}

}  // namespace skylapse::output::imageio
