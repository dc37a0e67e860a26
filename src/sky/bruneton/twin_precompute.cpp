#include <algorithm>

#include "sky/bruneton/order_tail.h"
#include "sky/bruneton/scattering_orders.h"
#include "sky/bruneton/twin.h"

namespace skylapse::sky::bruneton {
namespace {

OrderSums order_sums(const std::vector<glm::dvec4>& source, const Settings& size) {
  OrderSums sums(size_t(size.heights) * size.sun_rows(), glm::dvec4(0));
  size_t i = 0;
  for (int h = 0; h < size.heights; ++h)
    for (int z = 0; z < size.table_zeniths; ++z)
      for (int row = 0; row < size.sun_rows(); ++row)
        for (int a = 0; a < size.table_azimuths; ++a)
          sums[size_t(h) * size.sun_rows() + row] += source[i++];
  return sums;
}

void add(std::vector<glm::dvec4>& sum, const std::vector<glm::dvec4>& order) {
  for (size_t i = 0; i < sum.size(); ++i) sum[i] += order[i];
}

void add_tail(std::vector<glm::dvec4>& sum, const std::vector<glm::dvec4>& last,
              const OrderSums& factors, const Settings& size) {
  size_t i = 0;
  for (int h = 0; h < size.heights; ++h)
    for (int z = 0; z < size.table_zeniths; ++z)
      for (int row = 0; row < size.sun_rows(); ++row)
        for (int a = 0; a < size.table_azimuths; ++a, ++i)
          sum[i] += last[i] * factors[size_t(h) * size.sun_rows() + row];
}

std::vector<float> rounded(const std::vector<glm::dvec4>& values) {
  std::vector<float> result;
  result.reserve(4 * values.size());
  for (const glm::dvec4& value : values)
    for (int c = 0; c < 4; ++c) result.push_back(float(value[c]));
  return result;
}

}  // namespace

Tables precompute_twin(const atmosphere::Medium& medium, const Settings& settings) {
  const std::shared_ptr<const Columns> columns = make_columns(medium);
  ScatteringOrders orders(*columns, settings);
  IncidentLight incident = orders.first_order();
  Source order = orders.gather(incident);
  Source sum = order;
  std::vector<std::vector<glm::dvec4>> ground = incident.ground;
  std::vector<OrderTail> tails(orders.groups(), OrderTail(settings));
  const auto watch = [&] {
    bool done = true;
    for (int g = 0; g < orders.groups(); ++g) {
      tails[g].add(order_sums(order[g], settings));
      done &= tails[g].done();
    }
    return done;
  };
  bool done = watch();
  while (!done) {
    incident = orders.march(order, incident);
    order = orders.gather(incident);
    for (int g = 0; g < orders.groups(); ++g) {
      add(sum[g], order[g]);
      add(ground[g], incident.ground[g]);
    }
    done = watch();
  }

  Tables tables{medium, settings, {}, {}, 0, {}, {}};
  for (int g = 0; g < orders.groups(); ++g) {
    add_tail(sum[g], order[g], tails[g].tail_factors(), settings);
    const OrderSums factors = tails[g].ground_tail_factors();
    // `incident` made `order`: its light on the ground is one order behind the source.
    for (int row = 0; row < settings.sun_rows(); ++row)
      ground[g][row] += incident.ground[g][row] * factors[row];
    tables.source.push_back(rounded(sum[g]));
    tables.ground_irradiance.push_back(rounded(ground[g]));
    tables.orders = std::max(tables.orders, tails[g].orders());
  }
  for (size_t b = 0; b < medium.bands.size(); ++b) {
    tables.last_addition.push_back(tails[b / 4].last_addition()[int(b % 4)]);
    tables.tail_ratio.push_back(tails[b / 4].ratio()[int(b % 4)]);
  }
  return tables;
}

}  // namespace skylapse::sky::bruneton
