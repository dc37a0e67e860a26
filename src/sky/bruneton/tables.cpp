#include "sky/bruneton/tables.h"

#include <cassert>

namespace skylapse::sky::bruneton {
namespace {

void mix(std::vector<std::vector<float>>& result, const std::vector<std::vector<float>>& other,
         double w) {
  assert(result.size() == other.size());
  for (size_t g = 0; g < result.size(); ++g) {
    assert(result[g].size() == other[g].size());
    for (size_t i = 0; i < result[g].size(); ++i)
      result[g][i] = float((1 - w) * result[g][i] + w * other[g][i]);
  }
}

}  // namespace

size_t Tables::bytes() const {
  size_t numbers = 0;
  for (const std::vector<float>& group : source) numbers += group.size();
  for (const std::vector<float>& group : ground_irradiance) numbers += group.size();
  return numbers * sizeof(float);
}

Tables blend(const Tables& a, const Tables& b, double w, const atmosphere::Medium& medium) {
  assert(canonical_text(a.settings) == canonical_text(b.settings));
  assert(w >= 0 && w <= 1);
  Tables result = a;
  result.medium = medium;
  mix(result.source, b.source, w);
  mix(result.ground_irradiance, b.ground_irradiance, w);
  result.orders = std::max(a.orders, b.orders);
  for (size_t i = 0; i < result.tail_ratio.size(); ++i) {
    result.last_addition[i] = std::max(a.last_addition[i], b.last_addition[i]);
    result.tail_ratio[i] = std::max(a.tail_ratio[i], b.tail_ratio[i]);
  }
  return result;
}

}  // namespace skylapse::sky::bruneton
