#pragma once
// The proof that `effects: auto` shows what `all` shows: both pictures through the whole pipeline,
// compared in scene-linear light and in the values of an 8-bit display.
#include <cstdint>
#include <string>
#include <vector>

#include "core/result.h"
#include "image/frame_buffer.h"
#include "plan/effect_planner.h"

namespace skylapse::effects_proof {

struct Picture {
  image::FrameBuffer scene;
  std::vector<uint8_t> codes;
  double darkest_step = 0;
  std::vector<plan::EffectDecision> decisions;
  double core_seconds = 0;  // of plan and frame, on all threads
};

/// The one frame of a config whose "@" is replaced by `effects`. No cache of tables.
Result<Picture, Diagnostics> picture_of(const std::string& scene, const std::string& effects,
                                        const plan::EffectRules& rules);

/// What leaving effects out changed.
struct Change {
  double error = 0;       // greatest of a pixel, as kLeaveBelow says
  double bound = 0;       // sum of the stated bounds of what only `all` has
  int codes = 0;          // greatest difference of an 8-bit value
  double mean_codes = 0;  // greatest mean difference of a channel over a quarter of the picture:
                          // a difference that is structured does not average out
  std::string left;       // what only `all` has

  /// Rounding of the floats, and the dither's last bit, come on top of the bounds.
  static constexpr double kRounding = 1e-4;
  static constexpr int kVisibleCodes = 1;
  static constexpr double kVisibleMean = 0.5;
  [[nodiscard]] bool holds() const {
    return error <= bound + kRounding && codes <= kVisibleCodes && mean_codes < kVisibleMean;
  }
  [[nodiscard]] std::string text() const;
};
Change change_of(const Picture& without, const Picture& all);

}  // namespace skylapse::effects_proof
