#pragma once
// Sizes and tolerances of the multiple-scattering tables: the rungs of the ladder of accuracy.
#include <string>
#include <vector>

#include "core/result.h"
#include "sky/atmosphere/medium.h"

namespace skylapse::sky::bruneton {

enum class Level { draft, low, standard, fine };
std::string name_of(Level level);
const std::vector<std::string>& level_names();

/// Everything that shapes the tables beside the medium.
struct Settings {
  int heights = 20;   // points, clustered at the ground
  int suns = 36;      // sun nodes at which points are computed
  int first_sun = 0;  // which of all nodes of the warp the first of them is
  int all_suns = 0;   // nodes of the whole warp; 0: as many as `suns`, tables of every sun
  int sun_rows_per_interval = 6;                // rows of the table between two sun nodes
  int directions_up = 16, directions_down = 6;  // quadrature nodes above and below the horizon
  int azimuths = 12;                            // quadrature nodes over half the circle
  int harmonics = 12;                           // greatest degree l
  int table_azimuths = 12, table_zeniths = 24;
  int samples = 6;  // of a march piece, orders 2 and up
  int first_order_samples = 20;
  int orders = 0;  // computed, without a tail (2 and up); 0: until they converge, with one
  int max_orders = 30;
  double stop_below = 0.03;  // an order that adds less is the last; the rest is its tail

  [[nodiscard]] int sun_rows() const { return (suns - 1) * sun_rows_per_interval + 1; }
  /// Nodes of the warp, computed or not.
  [[nodiscard]] int warp_suns() const { return all_suns > 0 ? all_suns : suns; }
};

/// The sizes of a level, raised where the medium needs it: thick air, strongly forward aerosol,
/// bright ground (rules and their measurements: docs/atmosphere.md).
Settings settings_for(Level level, const atmosphere::Medium& medium);

/// Stable text of all numbers, as canonical_text of a medium.
std::string canonical_text(const Settings& settings);

}  // namespace skylapse::sky::bruneton
