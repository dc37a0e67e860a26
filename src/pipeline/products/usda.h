#pragma once
// Text of USD layers: the few pieces that lights need.
#include <glm/glm.hpp>
#include <string>

#include "core/result.h"
#include "pipeline/products/product.h"

namespace skylapse::pipeline {

/// Opens a layer: "#usda 1.0", the stage's up axis by the request's orientation, one metre a unit,
/// what the values mean, moment and place. Its default prim "Sky" is left to be written. Error
/// (invalid_input, at the output's path) for left-handed orientations: USD stages are right-handed.
Result<std::string> usda_head(const ProductRequest& request);

/// Lines of a prim that turn local axes, the columns of `axes`, into the stage's (USD writes
/// matrices for row vectors). Numbers below 1e-15 are 0.
std::string usda_transform(const glm::dmat3& axes, const std::string& indent);

/// A file as a layer in `from` names it: relative to that layer, "@./...@". Both relative to the
/// output folder.
std::string usda_asset(const std::string& file, const std::string& from);

/// OpenUSD's name of the job's space: "lin_rec709_scene".
std::string usda_color_space(const ProductRequest& request);

ProductFile text_product(const std::string& text);

}  // namespace skylapse::pipeline
