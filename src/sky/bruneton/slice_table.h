#pragma once
// One frame's slice as the pixel loops want it: colours of the image, in float, interleaved; and
// the rows that a range of elevations falls on.
#include <array>
#include <vector>

#include "sky/bruneton/slice_image.h"
#include "sky/bruneton/slice_kernel.h"

namespace skylapse::sky::bruneton {

/// Weights of consecutive rows of the slice; they sum to at most 1.
struct RowWeights {
  int first = 0;
  std::vector<double> weight;
};

class SliceTable {
 public:
  explicit SliceTable(const SliceImageInputs& inputs);

  [[nodiscard]] const kernel::Shape& shape() const { return shape_; }
  [[nodiscard]] const float* nodes() const { return nodes_.data(); }
  [[nodiscard]] const SliceGrid& grid() const { return grid_; }

  /// The rows that the elevation `over` the horizon [rad] falls between; none above the air.
  [[nodiscard]] RowWeights rows_at(double over) const;
  /// The mean over the elevations [low, high] over the horizon, which lie on one side of it; the
  /// part above the air is black. Exact for the linear interpolation between rows.
  [[nodiscard]] RowWeights mean_rows(double low, double high) const;

  /// The column at or before the azimuth from the sun in [0, pi], and the place towards the next.
  struct Column {
    int index;
    double fraction;
  };
  [[nodiscard]] Column column_at(double azimuth) const;

  /// Sum over rows at one column, as kernel nodes are.
  [[nodiscard]] std::array<double, kernel::kNodeFloats> blend(const RowWeights& rows,
                                                              Column column) const;
  /// Sum over rows at all columns: azimuths x kNodeFloats floats.
  [[nodiscard]] std::vector<float> blend(const RowWeights& rows) const;

 private:
  SliceGrid grid_;
  kernel::Shape shape_{};
  bool open_ = false;  // the camera sees beyond the air above the limb
  std::vector<float> nodes_;
};

}  // namespace skylapse::sky::bruneton
