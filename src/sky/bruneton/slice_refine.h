#pragma once
// Slices with more nodes than were marched. Light over the sky falls nearly exponentially towards
// dusk's edge, at the limb and along the terminator, which a curve through logarithms follows.
#include "sky/bruneton/sky_slice.h"

namespace skylapse::sky::bruneton {

/// Nodes per interval of the slice that was marched.
struct Refinement {
  int azimuths = 2;
  int zeniths = 3;
};

/// The slice on a grid of `by` (each >= 1) times as many intervals, whose nodes include those of
/// `slice` unchanged. Between them, along one axis after the other and for each of X, Y, Z by
/// itself: a cubic through the logarithms whose slopes are central differences, capped where
/// neighbouring steps differ much; through the values with monotone slopes (0 at an extremum, at
/// most 3 x the smaller step) where one is not positive or a step exceeds a factor of e^4. The two
/// halves do not mix. Of a slice with a window, what lies between nodes with all their neighbours
/// inside it is the same to the bit as of the whole slice, and is the window of the result; the
/// rest is 0 or means nothing. Uses all cores; the result does not depend on their number.
SkySlice refined(const SkySlice& slice, Refinement by = {});

}  // namespace skylapse::sky::bruneton
