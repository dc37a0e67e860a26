#pragma once
// One frame's sky in the coordinates of sky_kernel.h, made in double, rounded to float last.
#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "sky/hosek_wilkie/sky.h"
#include "sky/hosek_wilkie/sky_kernel.h"

namespace skylapse::sky::hosek_wilkie {

/// Floats on cache lines.
class AlignedFloats {
 public:
  AlignedFloats() = default;
  explicit AlignedFloats(size_t count);
  [[nodiscard]] float* data() { return floats_.get(); }
  [[nodiscard]] const float* data() const { return floats_.get(); }

 private:
  struct Free {
    void operator()(float* p) const;
  };
  std::unique_ptr<float[], Free> floats_;
};

/// The lobes of all bands as polynomials of q, with colour matrix and level folded in.
class FrameTable {
 public:
  /// `scale_to_rgb` takes the sky's XYZ to the image, level included.
  FrameTable(const Sky& sky, const glm::dmat3& scale_to_rgb);

  /// The row of cubic polynomials at w = sqrt(cos theta) in [0, 1]: kernel::kRowFloats floats.
  void make_row(double w, float* row) const;

  /// Rows at w = 0, 1/kRowSteps, ..., 1; made on all cores.
  [[nodiscard]] AlignedFloats make_rows() const;

 private:
  const Sky& sky_;
  std::array<glm::dvec3, kBandCount> colours_{};
  AlignedFloats coefficients_;
  std::vector<double> constants_;
};

/// Reads rows made by make_rows at one direction; negative values become 0.
glm::vec3 look_up_one(const AlignedFloats& rows, double q, double w);

}  // namespace skylapse::sky::hosek_wilkie
