#pragma once
// What the page's viewer gets of a pair: packed pixels, and what it must know to show them.
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "diff/evidence.h"

namespace skylapse::diff {

/// Pixels that stand in elements of their own, so that a browser parses them only when asked to.
struct PackedPictures {
  nlohmann::ordered_json facts;                               // of the pictures, for the viewer
  std::vector<std::pair<std::string, std::string>> elements;  // "a", "b", "e", "f": base64
};

/// Mantissa bits of pixels (0.024 %, finer than half floats) and of errors (1.6 %: no bands in
/// the colours).
inline constexpr int kPixelMantissa = 11, kErrorMantissa = 5;

/// Channels of a picture that the page shows, the first ones.
inline constexpr int kPageChannels = 8;

PackedPictures packed_pictures(const PairEvidence& evidence, int max_width);

/// Directions of a camera at the corners of a grid over its picture, which the viewer interpolates:
/// one way for all projections. Equal cameras share one entry.
class CameraGrids {
 public:
  /// Number of the camera's entry.
  int add(const image::Camera& camera);
  /// A list of {w, h, gw, gh, bits, d: base64}: x, y, z of ENU as 1 + 32767 (1 + v), 0: no
  /// direction.
  [[nodiscard]] const nlohmann::ordered_json& list() const { return list_; }

 private:
  std::map<std::string, int> known_;
  nlohmann::ordered_json list_ = nlohmann::ordered_json::array();
};

}  // namespace skylapse::diff
