#pragma once
// Maps for diffuse surfaces: image/lighting/irradiance_map.h, as files.
//
// A pixel is the irradiance E of a surface whose normal is the pixel's direction; 1.0 stands for
// 683 lux. A surface of the albedo a sends out the radiance a E / pi in every direction, in the
// unit of the sky's own maps. The disc's light is summed over its area.
//
// The pixels about the zenith are scaled so that their mean is the irradiance of level ground. Read
// between pixels, a map of a sun on the horizon would give it 4 to 10 % too much (cubes of 64 to 16
// pixels; nothing of the kind from 4 deg on), since half of the pixels face away from the sun.
#include "pipeline/products/product.h"

namespace skylapse::pipeline {

/// A lat-long map, or a cube: a strip, six faces, or a KTX 2 file of one level.
Result<std::vector<ProductFile>> make_irradiance(const ProductRequest& request, StageTimes& times);

}  // namespace skylapse::pipeline
