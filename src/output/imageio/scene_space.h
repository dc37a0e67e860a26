#pragma once
#include <OpenColorIO/OpenColorIO.h>

#include <string>

#include "color/rgb_space.h"
#include "core/result.h"

namespace skylapse::output::imageio {

/// How pixels of one of our scene spaces enter a config: through `matrix` into its space `name`.
struct SceneEntry {
  std::string name;
  glm::dmat3 matrix{1.0};
};

/// Looks for `space` under the names that ACES, colour-science, Blender and OpenColorIO configs
/// give it (roles and aliases count), then for the aces_interchange role, then for another of the
/// spaces we know, reached by a matrix. None: invalid_input that lists what was looked for.
Result<SceneEntry> find_scene_space(const OCIO_NAMESPACE::Config& config, color::RgbSpace space);

}  // namespace skylapse::output::imageio
