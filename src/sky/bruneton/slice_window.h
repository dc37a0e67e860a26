#pragma once
// Which nodes of a slice the pixels of a camera read.
#include "core/frames.h"
#include "image/camera/camera.h"
#include "sky/bruneton/sky_slice.h"

namespace skylapse::sky::bruneton {

/// A window of `grid` from which refined() and render_slice() make the camera's picture to the bit
/// as from the whole slice: every direction that a pixel may look along, two pixels more all
/// around, and the neighbours that the refinement's curves reach for. `sun` as SliceImageInputs.
/// Empty where no pixel meets the air: a camera in space that looks away. All of the grid for
/// lat-long maps and cubes.
SliceWindow window_of(const image::Camera& camera, const SliceGrid& grid,
                      const Direction<Enu>& sun);

}  // namespace skylapse::sky::bruneton
