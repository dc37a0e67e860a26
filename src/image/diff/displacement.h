#pragma once
// Whether one picture is the other, moved: of the whole, and of its brightest spot.
#include <optional>

#include "image/diff/picture.h"

namespace skylapse::image {

/// Least-squares fit of b(x) = (1 + g) a(x - s) over the pixels where a is smooth (Lucas & Kanade
/// 1981): s in pixels, to the right and down. The gain g keeps a brighter picture from counting as
/// a moved one.
struct Displacement {
  double x = 0, y = 0, gain = 0;
  double explained = 0;  // share of the squared difference left by the gain that the move explains
  double effect = 0;     // root mean square change of the light by the move, as a share
};

/// Nothing if the picture has no gradient to see a move by. Linear for moves
/// up to about a pixel: larger ones are found, but their size is a lower bound. `wraps`: the left
/// and right edges of a map of the whole sphere are neighbours. Not-a-number pixels are left out.
std::optional<Displacement> fit_displacement(const Picture& a, const Picture& b, bool wraps);

/// A spot that outshines its surroundings.
struct Spot {
  double x = 0, y = 0;  // centroid of the light above the surroundings, in pixels from the corner
  double light = 0;     // that light: sum over pixels (the mean of their colour channels)
};

/// The spot in the window of `reach` pixels about x, y: light beyond a tenth of the way from the
/// window's rim (its median) to its brightest pixel. Nothing if that pixel is not ten times as
/// bright as the rim (a glow is no disc), or a pixel is no number. With `wraps` the window goes on
/// behind the left and right edges, and x of the spot may lie beyond them.
std::optional<Spot> find_spot(const Picture& picture, double x, double y, double reach, bool wraps);

}  // namespace skylapse::image
