#pragma once
// Cubes for glossy surfaces: image/lighting/specular.h, as files.
//
// Level i of n is filtered for the roughness i / (n - 1), alpha = roughness^2; the first is the sky
// itself. Files hold L'(R), the first half of the split sum; the second, the table of the surface's
// own scale and bias, is the renderer's.
//
// The disc is filtered as what it is, a small source in closed form, apart from the sky. The first
// level shows it pixel by pixel where numbers reach that far (float, hdr). Half floats end at
// 65504: there the disc is wider, with all its light, by the factor that the manifest has as
// "sun_spread": 6 at noon, 1 on the horizon. Levels that are blurred more than that are not touched
// by it.
#include "pipeline/products/product.h"

namespace skylapse::pipeline {

/// One KTX 2 file, or for each level one strip or six faces.
Result<std::vector<ProductFile>> make_specular(const ProductRequest& request, StageTimes& times);

}  // namespace skylapse::pipeline
