#pragma once
// Frames that cases start from, in closed form: skies as rough sketches, 256 x 128 in lat-long.
#include "diff_cases/image.h"

namespace skylapse::diff_cases {

inline constexpr int kSunRow = 40;
inline constexpr int kSunColumn = 180;
inline constexpr int kGroundRow = 100;

/// What a sketch of a day is made of.
struct DaySketch {
  int width = 256, height = 128;
  int sun_column = kSunColumn, sun_row = kSunRow;
  double gain = 1;
  double disc = 5000;  // radiance of the sun's disc in red
};

/// A bright aureole and disc over a blue gradient; the ground is 0.15 times that.
Image day_sketch(const DaySketch& sketch = {});

/// A faint glow with stars in a fixed pattern; rows from `dark_from` on are exactly 0.
Image night_sketch(int dark_from = kGroundRow);

/// 8-bit sRGB code values of a / (1 + a).
Image display_of(const Image& linear);

/// Frame i = 1..8 of a sun that moves and brightens.
Image sequence_frame(int i);

/// (x - sun column)^2 + (y - sun row)^2.
inline int sun_distance_squared(int x, int y) {
  return (x - kSunColumn) * (x - kSunColumn) + (y - kSunRow) * (y - kSunRow);
}

/// Rows and columns that are left of an image.
Image cropped(const Image& image, int x, int y, int width, int height);

}  // namespace skylapse::diff_cases
