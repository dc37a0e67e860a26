#pragma once
// The two inner loops of the path tracer, compiled for each instruction set.
#include <array>

#include "sky/monte_carlo/shells.h"

namespace skylapse::sky::monte_carlo {

inline constexpr int kMaxBands = 64;
/// One number for each band; entries past the bands hold copies of the last.
using PerBand = std::array<double, kMaxBands>;

namespace kernel {

/// Rows of band arrays are padded to a multiple of this; the spare entries are computed, not used.
inline constexpr int kLanes = 4;

/// out[i] = exp(-(a[i] * columns.rayleigh + b[i] * columns.aerosol + c[i] * columns.ozone)) for
/// i < count, a multiple of kLanes. Relative error 2e-11.
void transmittances(int count, const double* a, const double* b, const double* c,
                    const Columns& columns, double* out);

}  // namespace kernel
}  // namespace skylapse::sky::monte_carlo
