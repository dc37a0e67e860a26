#include "output/imageio/orientation.h"

#include <utility>

namespace skylapse::output::imageio {

void put_upright(int orientation, ReadImage& image) {
  if (orientation < 2 || orientation > 8) return;
  // 2 mirrored, 3 half a turn, 4 upside down, 5 transposed, 6 and 8 quarter turns, 7 transposed
  // the other way.
  const bool transposed = is_transposed(orientation);
  const bool from_right =
      orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool from_below =
      orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  const int width = transposed ? image.height : image.width;
  const int height = transposed ? image.width : image.height;
  const size_t channels = image.channels.size();
  std::vector<float> turned(image.samples.size());
  float* to = turned.data();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int column = transposed ? y : x;
      int row = transposed ? x : y;
      if (from_right) column = image.width - 1 - column;
      if (from_below) row = image.height - 1 - row;
      const float* from =
          image.samples.data() + channels * (size_t(row) * size_t(image.width) + size_t(column));
      for (size_t c = 0; c < channels; ++c) *to++ = *from++;
    }
  }
  image.samples = std::move(turned);
  image.width = width;
  image.height = height;
}

}  // namespace skylapse::output::imageio
