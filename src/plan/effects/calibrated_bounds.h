#pragma once
// Errors that no formula bounds, as measured over hard scenes; the commands that measure them are
// in docs/effects.md.
namespace skylapse::plan {

/// Wavelengths that count as all of them.
inline constexpr int kFullSpectrum = 32;
/// Error of a pixel by 16 wavelengths instead of 32: 9e-3 is the greatest of 14 drawn scenes, the
/// few orders and suns in it (docs/effects.md).
inline constexpr double kSpectrumError = 1e-2;
/// An order that adds less than this to the sources is the last that `further-orders` computes.
inline constexpr double kFurtherOrdersStop = 1e-3;
/// Error of a pixel by the geometric tail in place of those orders: 6e-3 is the greatest of 140
/// drawn scenes, in haze without air under a sun that has just set (docs/effects.md).
inline constexpr double kTailError = 1e-2;

/// Error of a pixel by tables of those suns alone that a job's frames read (bench_economies).
inline constexpr double kPartialTablesError = 1e-3;

}  // namespace skylapse::plan
