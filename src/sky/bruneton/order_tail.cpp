#include "sky/bruneton/order_tail.h"

#include <algorithm>

namespace skylapse::sky::bruneton {
namespace {

constexpr double kGreatestRatio = 0.98;

glm::dvec4 quotient(const glm::dvec4& a, const glm::dvec4& b) {
  glm::dvec4 result(0);
  for (int c = 0; c < 4; ++c)
    if (b[c] > 0) result[c] = a[c] / b[c];
  return result;
}

}  // namespace

void OrderTail::add(const OrderSums& order) {
  before_ = std::move(last_);
  last_ = order;
  before_sum_ = last_sum_;
  last_sum_ = glm::dvec4(0);
  for (const glm::dvec4& place : order) last_sum_ += place;
  total_ += last_sum_;
  ++orders_;
}

bool OrderTail::done() const {
  if (settings_.orders > 0) return orders_ >= settings_.orders;
  if (orders_ >= settings_.max_orders) return true;
  const glm::dvec4 addition = last_addition();
  // Two orders at least: without two there is no ratio.
  return orders_ >= 3 &&
         std::max({addition.x, addition.y, addition.z, addition.w}) < settings_.stop_below;
}

glm::dvec4 OrderTail::last_addition() const { return quotient(last_sum_, total_); }
glm::dvec4 OrderTail::ratio() const { return quotient(last_sum_, before_sum_); }

OrderSums OrderTail::tail_factors() const {
  OrderSums factors(last_.size(), glm::dvec4(0));
  if (before_.empty() || settings_.orders > 0) return factors;
  for (size_t i = 0; i < factors.size(); ++i) {
    const glm::dvec4 r = quotient(last_[i], before_[i]);
    for (int c = 0; c < 4; ++c)
      if (r[c] < kGreatestRatio) factors[i][c] = r[c] / (1 - r[c]);
  }
  return factors;
}

OrderSums OrderTail::ground_tail_factors() const {
  OrderSums all = tail_factors();
  all.resize(settings_.sun_rows());
  return all;
}

}  // namespace skylapse::sky::bruneton
