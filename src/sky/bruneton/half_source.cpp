#include "sky/bruneton/half_source.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "core/parallel.h"

namespace skylapse::sky::bruneton {
namespace {

constexpr size_t kGrain = 1 << 16;
/// Exponent of the brightest entry: half of what half floats reach, for sums of neighbours.
constexpr int kTopExponent = 14;

std::array<float, 4> brightest(const std::vector<float>& source) {
  std::array<float, 4> most{};
  for (size_t i = 0; i < source.size(); ++i) most[i % 4] = std::max(most[i % 4], source[i]);
  return most;
}

}  // namespace

HalfSource half_source(const std::vector<float>& source) {
  HalfSource result;
  result.halves.resize(source.size());
  const std::array<float, 4> most = brightest(source);
  std::array<float, 4> factor{};
  for (int c = 0; c < 4; ++c) {
    const int exponent = most[c] > 0 ? kTopExponent - std::ilogb(most[c]) : 0;
    factor[c] = std::ldexp(1.0f, exponent);
    result.scale[c] = std::ldexp(1.0, -exponent);
  }
  parallel_for_ranges(source.size(), kGrain, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      result.halves[i] = glm::packHalf1x16(source[i] * factor[i % 4]);
  });
  return result;
}

Tables rounded_to_half(Tables tables) {
  for (std::vector<float>& group : tables.source) {
    const HalfSource half = half_source(group);
    for (size_t i = 0; i < group.size(); ++i)
      group[i] = float(glm::unpackHalf1x16(half.halves[i]) * half.scale[int(i % 4)]);
  }
  return tables;
}

}  // namespace skylapse::sky::bruneton
