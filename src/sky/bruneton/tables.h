#pragma once
// What precomputation leaves behind: multiple scattering at every height and sun, for all bands.
#include <cstddef>
#include <vector>

#include "sky/atmosphere/medium.h"
#include "sky/bruneton/settings.h"

namespace skylapse::sky::bruneton {

/// Source S of multiply scattered light per unit scattering coefficient [W m^-2 sr^-1 nm^-1],
/// summed over orders 2, 3, ... with the tail of the orders that were not computed: the light that
/// scattering adds to a ray is S * (b_R + b_M) ds. Bands go in groups of four (the channels of a
/// texture); spare channels of the last group repeat the last band.
///
/// source[group][height][zenith][sun row][azimuth][channel], azimuth and channel fastest: one group
/// is a 3-D texture of width table_azimuths, height sun_rows, depth table_zeniths * heights.
/// ground_irradiance[group][sun row][channel]: horizontal irradiance [W m^-2 nm^-1] on the ground
/// by scattered light of all orders, the first too, without the direct sun. Rows are those of
/// shaders/atmosphere (sun_row_of, height_coordinate...). At 1 au.
struct Tables {
  atmosphere::Medium medium;
  Settings settings;
  std::vector<std::vector<float>> source;
  std::vector<std::vector<float>> ground_irradiance;
  int orders = 0;                     // computed, of the slowest group; the tail comes on top
  std::vector<double> last_addition;  // per band: what the last order added, relative
  std::vector<double> tail_ratio;     // per band: ratio of the geometric tail

  [[nodiscard]] int groups() const { return int((medium.bands.size() + 3) / 4); }
  [[nodiscard]] size_t bytes() const;
};

/// (1 - w) * a + w * b, entry by entry, with the medium of neither: `medium` says which air the
/// result stands for. a and b have equal sizes (asserted).
Tables blend(const Tables& a, const Tables& b, double w, const atmosphere::Medium& medium);

}  // namespace skylapse::sky::bruneton
