#pragma once
// The sun as a light of its own, for maps that leave its disc out.
#include <glm/glm.hpp>
#include <string>

#include "pipeline/products/product.h"

namespace skylapse::pipeline {

/// Where the disc stands to the camera's horizon.
enum class SunState { above, on_horizon, below };

struct SunLight {
  SunState state = SunState::below;
  /// Where the light comes from: the disc's apparent centre. Below 5 deg, where the air dims the
  /// lower limb and the horizon cuts it off: the place in the centre's azimuth from which `normal`
  /// gives level ground its irradiance. Of a disc cut by a horizon that lies below elevation 0: the
  /// middle between that and the upper limb.
  Direction<Enu> from;
  /// Irradiance of a surface facing `from`, and of level ground, by the disc: W m^-2 in XYZ (683 Y
  /// is lux), and in the job's space as the pictures hold it. 0 where the disc is below the
  /// horizon.
  glm::dvec3 normal_xyz{0}, horizontal_xyz{0}, normal_rgb{0}, horizontal_rgb{0};
};

/// The frame's disc, whether the pictures show it or not.
SunLight sun_light_of(const FrameLight& light);

/// A prim "Sun": a DistantLight that shines down its -Z axis, as wide as the disc. By UsdLux,
/// normalised (inputs:normalize) intensity times colour is the irradiance of a surface that faces
/// it, in the maps' unit. A sun below the horizon has intensity 0.
std::string distant_light_usda(const ProductRequest& request, const SunLight& sun,
                               const std::string& indent);

/// JSON ("json") or a USD layer with the light alone ("usda").
Result<std::vector<ProductFile>> make_sun(const ProductRequest& request);

}  // namespace skylapse::pipeline
