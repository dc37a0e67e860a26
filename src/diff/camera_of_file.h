#pragma once
// The camera that made a picture, from what its file tells.
#include <optional>
#include <string>

#include "diff/told_values.h"
#include "image/camera/camera.h"

namespace skylapse::diff {

/// Lat-long maps, cubes and octahedral maps need their heading, cubes their layout (if it is not
/// told, the shape of the picture tells it), all others field of view, look direction and roll.
/// Maps of other programs that say no more than OpenEXR's `envmap` have heading 0.
/// Nothing where the file does not tell enough, where the picture's size does not fit, and where a
/// camera of ours cannot express it: mirrored maps (lat-long with orientation pbrt) and strips of
/// faces in OpenGL's order.
std::optional<image::Camera> camera_of_file(const ToldValues& told, int width, int height);

/// "lat-long", "fisheye-equisolid"...; of other programs' maps "lat-long" or "cube"; empty: not
/// told.
std::string projection_of_file(const ToldValues& told);

}  // namespace skylapse::diff
