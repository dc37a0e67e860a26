#include <algorithm>

#include "sky/bruneton/order_tail.h"
#include "sky/bruneton/scattering_orders.h"
#include "sky/bruneton/twin.h"

namespace skylapse::sky::bruneton {
namespace {

/// Sums and tails live at the sun nodes; the rows between them are filled once, at the end.
Settings at_nodes(Settings settings) {
  settings.sun_rows_per_interval = 1;
  return settings;
}

/// Calls body(place in the table, height, sun node) for all entries of the rows that are nodes.
template <class Body>
void for_node_entries(const Settings& size, const Body& body) {
  const size_t azimuths = size.table_azimuths, per = size.sun_rows_per_interval;
  size_t slab = 0;
  for (int h = 0; h < size.heights; ++h)
    for (int z = 0; z < size.table_zeniths; ++z, ++slab)
      for (int j = 0; j < size.suns; ++j)
        for (size_t a = 0; a < azimuths; ++a)
          body((slab * size.sun_rows() + j * per) * azimuths + a, h, j);
}

OrderSums order_sums(const std::vector<glm::dvec4>& source, const Settings& size) {
  OrderSums sums(size_t(size.heights) * size.suns, glm::dvec4(0));
  for_node_entries(size,
                   [&](size_t i, int h, int j) { sums[size_t(h) * size.suns + j] += source[i]; });
  return sums;
}

/// What the orders add up to, and the last of them, of one group.
struct Total {
  std::vector<glm::dvec4> source, ground;
  OrderTail tail;

  Total(const std::vector<glm::dvec4>& first, const std::vector<glm::dvec4>& first_ground,
        const Settings& settings)
      : source(first), ground(first_ground), tail(at_nodes(settings)) {
    tail.add(order_sums(first, settings));
  }

  void add(const std::vector<glm::dvec4>& order, const std::vector<glm::dvec4>& order_ground,
           const Settings& settings) {
    for_node_entries(settings, [&](size_t i, int, int) { source[i] += order[i]; });
    for (size_t i = 0; i < ground.size(); ++i) ground[i] += order_ground[i];
    tail.add(order_sums(order, settings));
  }

  /// `order_ground` lit the ground for `order`: its light is one order behind the source.
  void add_tail(const std::vector<glm::dvec4>& order, const std::vector<glm::dvec4>& order_ground,
                const Settings& settings) {
    const OrderSums factors = tail.tail_factors(), ground_factors = tail.ground_tail_factors();
    for_node_entries(settings, [&](size_t i, int h, int j) {
      source[i] += order[i] * factors[size_t(h) * settings.suns + j];
    });
    for (int j = 0; j < settings.suns; ++j) {
      const size_t row = size_t(j) * settings.sun_rows_per_interval;
      ground[row] += order_ground[row] * ground_factors[j];
    }
  }
};

std::vector<float> rounded(const std::vector<glm::dvec4>& values) {
  std::vector<float> result;
  result.reserve(4 * values.size());
  for (const glm::dvec4& value : values)
    for (int c = 0; c < 4; ++c) result.push_back(float(value[c]));
  return result;
}

/// Groups whose orders are computed together and stop together.
constexpr int kGroupsAtOnce = 4;

/// False if `progress`, told the share of the orders, wants no more.
bool compute_groups(const Columns& columns, const Settings& settings, int first, int count,
                    const Progress& progress, Tables& tables) {
  ScatteringOrders orders(columns, settings, first, count);
  IncidentLight incident = orders.first_order();
  Source order = orders.gather(incident);
  std::vector<Total> totals;
  for (int g = 0; g < count; ++g) totals.emplace_back(order[g], incident.ground[g], settings);
  double share = 0;
  const auto done = [](const Total& total) { return total.tail.done(); };
  while (!std::all_of(totals.begin(), totals.end(), done)) {
    // The number of orders is known at the end alone: halfway there each time.
    share += 0.5 * (1 - share);
    if (!progress(share)) return false;
    incident = orders.march(order, incident);
    order = orders.gather(incident);
    for (int g = 0; g < count; ++g) totals[g].add(order[g], incident.ground[g], settings);
  }
  for (int g = 0; g < count; ++g) {
    Total& total = totals[g];
    total.add_tail(order[g], incident.ground[g], settings);
    orders.fill_rows(total.source, total.ground);
    tables.source.push_back(rounded(total.source));
    tables.ground_irradiance.push_back(rounded(total.ground));
    tables.orders = std::max(tables.orders, total.tail.orders());
    for (size_t c = 0; c < 4 && 4 * (first + g) + c < tables.medium.bands.size(); ++c) {
      tables.last_addition[4 * (first + g) + c] = total.tail.last_addition()[int(c)];
      tables.tail_ratio[4 * (first + g) + c] = total.tail.ratio()[int(c)];
    }
  }
  return true;
}

}  // namespace

Result<Tables> precompute_twin(const atmosphere::Medium& medium, const Settings& settings,
                               const Progress& progress) {
  const std::shared_ptr<const Columns> columns = make_columns(medium);
  Tables tables{medium, settings, {}, {}, 0, {}, {}};
  tables.last_addition.resize(medium.bands.size());
  tables.tail_ratio.resize(medium.bands.size());
  for (int first = 0; first < tables.groups(); first += kGroupsAtOnce) {
    const int count = std::min(kGroupsAtOnce, tables.groups() - first);
    const auto report = [&](double share) {
      return !progress || progress((first + share * count) / tables.groups());
    };
    if (!compute_groups(*columns, settings, first, count, report, tables))
      return Error{
          ErrorCode::interrupted, "the tables of the atmosphere were not finished", {}, {}};
  }
  return tables;
}

Tables precompute_twin(const atmosphere::Medium& medium, const Settings& settings) {
  return *precompute_twin(medium, settings, {});
}

}  // namespace skylapse::sky::bruneton
