#pragma once
#include "output/image_writer.h"

namespace skylapse::output::imageio {

/// Whether width and height change places.
constexpr bool is_transposed(int orientation) { return orientation >= 5 && orientation <= 8; }

/// Turns and mirrors a picture so that it lies as viewers show it.
/// `orientation` TIFF's and Exif's tag 274: where row 0 and column 0 of the file are; 1, and what
///               is not in 1..8, leaves the picture as it is.
void put_upright(int orientation, ReadImage& image);

}  // namespace skylapse::output::imageio
