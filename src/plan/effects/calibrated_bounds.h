#pragma once
// Errors that no formula bounds, as measured over hard scenes; the commands that measure them are
// in docs/effects.md.
#include "core/quantity.h"

namespace skylapse::plan {

/// Wavelengths that count as all of them.
inline constexpr int kFullSpectrum = 32;
/// Error of a pixel by 16 wavelengths instead of 32, over grounds without structure in the spectrum
/// and under air of at most kSpectrumPressure (docs/effects.md).
inline constexpr double kSpectrumError = 1e-2;
/// Under heavier air the light of a low sun turns more within a band than was measured: 2.2e-2
/// under 3000 hPa.
inline constexpr Pressure kSpectrumPressure{1500, hPa};
/// An order that adds less than this to the sources is the last that `further-orders` computes.
inline constexpr double kFurtherOrdersStop = 1e-3;
/// Error of a pixel by the geometric tail in place of those orders: 6e-3 is the greatest of 140
/// drawn scenes, in haze without air under a sun that has just set (docs/effects.md).
inline constexpr double kTailError = 1e-2;

/// Error of a pixel by tables of those suns alone that a job's frames read (bench_economies).
inline constexpr double kPartialTablesError = 1e-3;

}  // namespace skylapse::plan
