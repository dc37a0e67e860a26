#pragma once
// Spherical harmonics of a frame's light: image/lighting/harmonics.h, as JSON.
#include "pipeline/products/product.h"

namespace skylapse::pipeline {

/// One JSON file: radiance coefficients L_lm of the sky, of the disc and of both, and those of the
/// irradiance, each an RGB of the job's space in the maps' unit, with order, basis, axes and unit
/// stated. "horizontal_lux" is what nine terms say of level ground; "true_horizontal_lux" what the
/// model says; by theory they differ by up to 9.4 % of the disc's normal illuminance.
Result<std::vector<ProductFile>> make_harmonics(const ProductRequest& request, StageTimes& times);

}  // namespace skylapse::pipeline
