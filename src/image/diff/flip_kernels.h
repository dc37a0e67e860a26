#pragma once
// The loops of FLIP over rows of pixels, compiled for each instruction set.
//
// Both pictures go through them together, as their mean and their difference (second less first):
// all filters are linear, so that small differences keep their relative precision where the
// difference of two filtered pictures would be rounding noise, which the exponents 0.5 and 0.7
// would magnify. Exchanging the pictures changes nothing but the sign of differences.
#include <array>

namespace skylapse::image::flip_internal {

/// Counts of pixels are multiples of this; pictures are padded.
inline constexpr int kPixelBlock = 64;

/// Linear R, G, B of a row, first and second picture.
struct ColourRows {
  std::array<const float*, 3> first, second;
};

/// Luminance Y, X - Y, Y - Z, each as a share of white's: YCxCz without its factors and offset.
struct OpponentRows {
  std::array<float*, 3> mean, difference;
};

/// y(x) = (k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5), x limited to `limit`, where y is beyond 1.
struct RationalCurve {
  float k0, k1, k3, k4, k5;
  float limit;
};

/// What the errors of a row are made from.
struct FilteredRows {
  enum Field { luminance, red_green, blue_yellow, edge_x, edge_y, point_x, point_y, kFields };
  std::array<const float*, kFields> mean, difference;
};

struct Kernels {
  /// sRGB code values in [0, 1] to linear light, in place (IEC 61966-2-1).
  void (*decode_srgb)(float* values, int count);
  /// Opponent colours of linear colours in [0, 1].
  void (*oppose)(const ColourRows& in, int count, const OpponentRows& out);
  /// The same of colours >= 0 times `scale`, tone mapped and limited to [0, 1].
  void (*expose)(const ColourRows& in, const RationalCurve& curve, float scale, int count,
                 const OpponentRows& out);
  /// The same through RGB / (1 + luminance).
  void (*expose_reinhard)(const ColourRows& in, float scale, int count, const OpponentRows& out);
  /// out = (add: out +) sum over k of taps[|k|] rows[k], k in [-radius, radius].
  void (*filter_even)(const float* const* rows, const float* taps, int radius, int count, bool add,
                      float* out);
  /// out = sum over k in [1, radius] of taps[k] (rows[k] - rows[-k]).
  void (*filter_odd)(const float* const* rows, const float* taps, int radius, int count,
                     float* out);
  /// worst = max(worst, error).
  void (*errors)(const FilteredRows& in, int count, float* worst);
};

enum class InstructionSet { baseline, v3, v4 };

/// Null where this machine, or this build, lacks that set.
const Kernels* kernels_of(InstructionSet set);

/// Those of the widest set.
const Kernels& best_kernels();

}  // namespace skylapse::image::flip_internal
