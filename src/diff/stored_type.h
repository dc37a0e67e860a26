#pragma once
// Words and weights for how samples are stored.
#include <string>

#include "image/diff/picture.h"

namespace skylapse::diff {

/// Bits of a sample that tell neighbours apart: all of an integer, the mantissa of a float.
int precision_bits(const image::SampleStorage& storage);

/// "uint8", "half", "float", "double", "rgbe".
std::string type_name(const image::SampleStorage& storage);

}  // namespace skylapse::diff
