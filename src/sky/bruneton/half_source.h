#pragma once
// Source tables in half floats: half the memory, three digits.
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "sky/bruneton/tables.h"

namespace skylapse::sky::bruneton {

/// One group of Tables::source: number = half * scale of its channel. The scale is the power of two
/// that puts the channel's brightest entry between 2^14 and 2^15, so that an entry is rounded by at
/// most 2^-11 (4.9e-4) of itself down to 4e-9 of the brightest, and by at most 2^-39 (1.9e-12) of
/// the brightest below: the sky at sun -18 deg is 1e-8 of noon.
struct HalfSource {
  std::vector<std::uint16_t> halves;
  glm::dvec4 scale{1};
};
/// Uses all cores. The numbers are finite and not negative.
HalfSource half_source(const std::vector<float>& source);

/// The tables as a model of half floats reads them: what judges it.
Tables rounded_to_half(Tables tables);

}  // namespace skylapse::sky::bruneton
