#pragma once
#include <OpenColorIO/OpenColorIO.h>

#include <array>
#include <cstddef>
#include <memory>
#include <variant>
#include <vector>

namespace skylapse::output::imageio {

/// Per-channel curves over all 32-bit floats: values at the 65536 floats whose lower 16 bits are
/// zero (128 to the octave, both signs), straight lines between. A curve that is smooth in log x is
/// met within about 1e-5 of its value, wherever it has its action.
class CurveTable {
 public:
  /// Samples `curve` (which must not mix channels).
  explicit CurveTable(const OCIO_NAMESPACE::CPUProcessor& curve);
  void apply(float* rgb, size_t pixels) const;

 private:
  std::array<size_t, 3> start_{};  // of each channel's samples; equal channels share them
  std::vector<float> samples_;
};

/// A processor cut into stages, in which each run of operations that do not mix channels
/// (logarithms, tone curves, gamma) is one CurveTable. The ACES output transform spends three
/// quarters of its time in such a run.
class StagedProcessor {
 public:
  /// Null if nothing can be gained, or if the stages differ anywhere on a sample of colours from
  /// the unsimplified processor by more than `tolerance` (for results within 0..1).
  static std::unique_ptr<StagedProcessor> build(const OCIO_NAMESPACE::ConstConfigRcPtr& config,
                                                const OCIO_NAMESPACE::ConstProcessorRcPtr& whole,
                                                float tolerance);
  void apply(float* rgb, size_t pixels) const;

 private:
  using Stage = std::variant<OCIO_NAMESPACE::ConstCPUProcessorRcPtr, CurveTable>;
  std::vector<Stage> stages_;
};

/// Applies `processor` in place to `pixels` interleaved RGB pixels.
void apply_processor(const OCIO_NAMESPACE::CPUProcessor& processor, float* rgb, size_t pixels);

}  // namespace skylapse::output::imageio
