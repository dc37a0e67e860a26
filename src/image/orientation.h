#pragma once
// How renderers lay the world into environment maps.
#include <glm/glm.hpp>
#include <string_view>

#include "core/quantity.h"
#include "image/camera/camera.h"

namespace skylapse::image {

/// A renderer's convention: which axes it has, which direction of its axes a lat-long map shows in
/// its centre, how its cubes are laid out, and where we put north in its world.
enum class Orientation { openexr, usd, blender, three, gltf, unreal, unity, pbrt, mitsuba };

}  // namespace skylapse::image
