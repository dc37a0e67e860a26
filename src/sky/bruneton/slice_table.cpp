#include "sky/bruneton/slice_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace skylapse::sky::bruneton {
namespace {

constexpr double kPi = std::numbers::pi;

/// Of the Cornette-Shanks phase function (Bruneton and Neyret 2008, Eq. 4) what depends on g alone.
double phase_constant(double g) { return 3 / (8 * kPi) * (1 - g * g) / (2 + g * g); }

kernel::RowPlaces row_places(int half, double span, double bend) {
  return {.factor = float(2 * (half - 1.0) * (half - 1.0) / span),
          .bend = float(bend),
          .slope = float(4 * (1 - bend) / span)};
}

}  // namespace

SliceTable::SliceTable(const SliceImageInputs& inputs) : grid_(inputs.slice->grid) {
  const SkySlice& slice = *inputs.slice;
  const int half = grid_.zeniths / 2;
  assert(grid_.azimuths >= 2 && half >= 2 && grid_.zeniths == 2 * half);
  assert(slice.smooth.size() == size_t(grid_.azimuths) * grid_.zeniths);
  assert(slice.aerosol.size() == slice.smooth.size());
  const double g = slice.aerosol_g;
  // Only outside the air does the sky half end before the zenith.
  open_ = grid_.sky_span_rad < grid_.horizon_zenith_rad * (1 - 1e-9);
  shape_ = {.horizon_sine = std::sin(grid_.horizon_zenith_rad),
            .horizon_cosine = std::cos(grid_.horizon_zenith_rad),
            .sun_sine = std::sin(slice.sun_zenith_rad),
            .sun_cosine = std::cos(slice.sun_zenith_rad),
            .phase_a = 1 + g * g,
            .phase_b = 2 * g,
            .sky = row_places(half, grid_.sky_span_rad, grid_.sky_bend),
            .ground = row_places(half, grid_.ground_span_rad, grid_.ground_bend),
            .top = open_ ? float(grid_.sky_span_rad) : std::numeric_limits<float>::infinity(),
            .columns = float(grid_.azimuths - 1),
            .half = half,
            .azimuths = grid_.azimuths,
            .black_row = grid_.zeniths};

  const glm::dmat3 to_rgb = inputs.scale * inputs.xyz_to_rgb;
  const glm::dmat3 aerosol_to_rgb = phase_constant(g) * to_rgb;
  nodes_.assign((slice.smooth.size() + 2 * size_t(grid_.azimuths)) * kernel::kNodeFloats, 0);
  for (size_t i = 0; i < slice.smooth.size(); ++i) {
    const glm::dvec3 smooth = to_rgb * glm::dvec3(slice.smooth[i]);
    const glm::dvec3 aerosol = aerosol_to_rgb * glm::dvec3(slice.aerosol[i]);
    float* node = nodes_.data() + kernel::kNodeFloats * i;
    for (int c = 0; c < 3; ++c) node[c] = float(smooth[c]), node[4 + c] = float(aerosol[c]);
  }
}

RowWeights SliceTable::rows_at(double over) const {
  const int half = shape_.half;
  if (open_ && over > grid_.sky_span_rad) return {};
  const double t = grid_.share(over) * (half - 1);
  const int row = std::min(int(t), half - 2);
  return {row + (over < 0 ? half : 0), {1 - (t - row), t - row}};
}

RowWeights SliceTable::mean_rows(double low, double high) const {
  assert(low <= high && (low >= 0 || high <= 0));
  const bool ground = low < 0;
  const double near = ground ? -high : low, far = ground ? -low : high;
  const double span = ground ? grid_.ground_span_rad : grid_.sky_span_rad;
  const double bend = ground ? grid_.ground_bend : grid_.sky_bend;
  const int half = shape_.half;
  const double rows = half - 1;
  const double t_near = grid_.share(ground ? -near : near) * rows;
  const double t_far = grid_.share(ground ? -far : far) * rows;
  // What lies beyond the last row counts too where that is space; beyond the zenith and the nadir
  // there is nothing to count.
  const double end = !ground && open_ ? far : std::min(far, span);
  const double whole = (end - near) / span;
  if (!(whole > 1e-15)) return rows_at(ground ? -near : near);
  // The mean over e = span (b s^2 + (1 - b) s^4), s = t / rows, is one over de/dt dt; linear
  // between two rows, it is a quartic in t there, so that three Gauss nodes each are exact.
  constexpr double kNode = 0.7745966692414834;  // sqrt(3 / 5)
  const int first = std::min(int(t_near), half - 2), last = std::min(int(t_far), half - 2);
  RowWeights mean{first + (ground ? half : 0), std::vector<double>(last - first + 2)};
  for (int row = first; row <= last; ++row) {
    const double a = std::max(t_near, double(row)), b = std::min(t_far, double(row + 1));
    if (b <= a) continue;
    for (const double side : {-1.0, 0.0, 1.0}) {
      const double t = 0.5 * (a + b) + 0.5 * side * kNode * (b - a);
      const double s = t / rows, slope = s * (2 * bend + 4 * (1 - bend) * s * s) / rows;
      const double w = 0.5 * (b - a) * (side == 0 ? 8.0 / 9 : 5.0 / 9) * slope / whole;
      mean.weight[row - first] += w * (1 - (t - row));
      mean.weight[row - first + 1] += w * (t - row);
    }
  }
  return mean;
}

SliceTable::Column SliceTable::column_at(double azimuth) const {
  const double c = std::pow(std::clamp(azimuth / kPi, 0.0, 1.0), 2.0 / 3) * (grid_.azimuths - 1);
  const int index = std::min(int(c), grid_.azimuths - 2);
  return {index, c - index};
}

std::array<double, kernel::kNodeFloats> SliceTable::blend(const RowWeights& rows,
                                                          Column column) const {
  std::array<double, kernel::kNodeFloats> sum{};
  for (size_t r = 0; r < rows.weight.size(); ++r) {
    const float* a =
        nodes() + (size_t(rows.first + r) * grid_.azimuths + column.index) * kernel::kNodeFloats;
    const float* b = a + kernel::kNodeFloats;
    for (int k = 0; k < kernel::kNodeFloats; ++k)
      sum[k] += rows.weight[r] * (a[k] + column.fraction * (b[k] - a[k]));
  }
  return sum;
}

std::vector<float> SliceTable::blend(const RowWeights& rows) const {
  const size_t count = size_t(grid_.azimuths) * kernel::kNodeFloats;
  std::vector<float> sum(count);
  for (size_t r = 0; r < rows.weight.size(); ++r) {
    const float* row = nodes() + (rows.first + r) * count;
    const float weight = float(rows.weight[r]);
    for (size_t k = 0; k < count; ++k) sum[k] += weight * row[k];
  }
  return sum;
}

}  // namespace skylapse::sky::bruneton
