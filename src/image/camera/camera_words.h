#pragma once
// The words that files and manifests use for cameras.
#include <optional>
#include <string_view>

#include "image/camera/camera.h"
#include "image/camera/cube.h"

namespace skylapse::image {

/// "perspective", "fisheye-equidistant", "fisheye-equisolid", "fisheye-stereographic", "lat-long",
/// "cube", "octahedral", "mirror-ball".
std::string_view name_of(Projection projection);
std::optional<Projection> projection_from_name(std::string_view name);

/// "horizontal-strip", "vertical-strip", "cross", "vertical-cross".
std::string_view name_of(CubeLayout layout);
std::optional<CubeLayout> cube_layout_from_name(std::string_view name);

/// "+X", "-X", "+Y", "-Y", "+Z", "-Z", of OpenEXR's axes.
std::string_view name_of(CubeFace face);
std::optional<CubeFace> cube_face_from_name(std::string_view name);

/// The layout of cubes whose faces are files of their own.
inline constexpr std::string_view kFacesApart = "faces";

}  // namespace skylapse::image
