#pragma once
// When to stop counting orders of scattering, and what the orders not counted add.
#include <glm/glm.hpp>
#include <vector>

#include "sky/bruneton/settings.h"

namespace skylapse::sky::bruneton {

/// How bright one order's source is at each height under each sun row: sums over zeniths and
/// azimuths. [height][sun row], four bands at once.
using OrderSums = std::vector<glm::dvec4>;

/// Watches the orders of one group of bands go by.
class OrderTail {
 public:
  explicit OrderTail(const Settings& settings) : settings_(settings) {}

  /// The next order, starting with the second (the first that has a source).
  void add(const OrderSums& order);

  /// True when the last order added less than settings.stop_below, or settings.max_orders is
  /// reached; where settings.orders is given, when it is reached.
  [[nodiscard]] bool done() const;
  /// What the last order added to the sum over all heights and suns, relative; per channel.
  [[nodiscard]] glm::dvec4 last_addition() const;
  /// Ratio of the last order to the one before, over all heights and suns; per channel.
  [[nodiscard]] glm::dvec4 ratio() const;
  /// What the orders not counted add to the sources, as multiples of the last order:
  /// r / (1 - r) at [height][sun row], r being the ratio there. Each place has its own:
  /// light lingers in thick layers. 0 where the ratio is 0.98 or more: such a series is not
  /// geometric yet. 0 everywhere where settings.orders is given.
  [[nodiscard]] OrderSums tail_factors() const;
  /// The same for the light on the ground, per sun row: that of the lowest height.
  [[nodiscard]] OrderSums ground_tail_factors() const;
  [[nodiscard]] int orders() const { return orders_; }

 private:
  Settings settings_;
  OrderSums last_, before_;
  glm::dvec4 last_sum_{0}, before_sum_{0}, total_{0};
  int orders_ = 1;
};

}  // namespace skylapse::sky::bruneton
