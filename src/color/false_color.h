#pragma once
// Numbers shown as colours.
#include <glm/glm.hpp>

namespace skylapse::color {

/// From black over purple, red and yellow to light yellow, in 8-bit sRGB code values: perceived
/// steps are even, brightness grows throughout, so that it reads in grey and for colour-blind
/// eyes too. t is held to [0, 1]; NaN as 0.
/// Source: matplotlib's "inferno" (van der Walt & Smith 2015, CC0), every eighth of its length,
/// straight between.
glm::dvec3 inferno(double t);

}  // namespace skylapse::color
