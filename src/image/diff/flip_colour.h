#pragma once
// Colour differences of FLIP (Andersson et al. 2020, section 4.1): from opponent colours, through
// the limits of the display, to Hunt-adjusted L*a*b* and the HyAB distance. Free of branches;
// everything that is a difference is computed as one, never by taking two results apart.
#include <cmath>

#include "core/vector_kernel.h"
#include "image/diff/flip_math.h"

namespace skylapse::image::flip_internal {

struct Rgb {
  float r, g, b;
};

/// As shares of white's X, Y, Z (D65).
struct Xyz {
  float x, y, z;
};

/// Linear sRGB. The primaries' and white's chromaticities give ratios of whole numbers: X / Xn is
/// (10135552 R + 8788810 G + 4435075 B) over their sum, and so on; each row sums to 1.
SKYLAPSE_INLINE Xyz xyz_of(Rgb c) {
  return {0.433895389f * c.r + 0.376242373f * c.g + 0.189862239f * c.b,
          0.212636822f * c.r + 0.715182982f * c.g + 0.0721801965f * c.b,
          0.0177524232f * c.r + 0.109465629f * c.g + 0.872781948f * c.b};
}

SKYLAPSE_INLINE Rgb rgb_of(Xyz c) {
  return {3.08034199f * c.x - 1.53739897f * c.y - 0.542943019f * c.z,
          -0.921178396f * c.x + 1.87592998f * c.y + 0.0452484125f * c.z,
          0.0528812929f * c.x - 0.204011206f * c.y + 1.15112991f * c.z};
}

/// The cube root of L*a*b*, made straight below (6/29)^3, for t in [0, 10].
SKYLAPSE_INLINE float lab_curve(float t) {
  constexpr float kStraightBelow = 0.00885645168f, kSlope = 7.78703704f, kAtZero = 0.137931034f;
  const float root = cube_root(t > kStraightBelow ? t : kStraightBelow);
  return t > kStraightBelow ? root : t * kSlope + kAtZero;
}

/// lab_curve(b) - lab_curve(a) with f its values: for cube roots (b - a) / (fa^2 + fa fb + fb^2).
SKYLAPSE_INLINE float lab_curve_change(float a, float b, float difference, float fa, float fb) {
  constexpr float kStraightBelow = 0.00885645168f, kSlope = 7.78703704f;
  const float sum = fa + fb;
  const float of_roots = difference / (sum * sum - fa * fb);
  const float lower = a < b ? a : b, upper = a < b ? b : a;
  const float straight = upper > kStraightBelow ? fb - fa : difference * kSlope;
  return lower > kStraightBelow ? of_roots : straight;
}

/// One channel, as the display shows it in both pictures.
struct Channel {
  float a, b, difference;
};

SKYLAPSE_INLINE Channel shown_channel(float mean, float difference) {
  const float a = mean - 0.5f * difference, b = mean + 0.5f * difference;
  float shown_a = a > 0.0f ? a : 0.0f, shown_b = b > 0.0f ? b : 0.0f;
  shown_a = shown_a < 1.0f ? shown_a : 1.0f;
  shown_b = shown_b < 1.0f ? shown_b : 1.0f;
  const float outside = std::fabs(a - shown_a) + std::fabs(b - shown_b);
  const float between = shown_b - shown_a;
  return {shown_a, shown_b, outside > 0.0f ? between : difference};
}

/// HyAB(green, blue) of the Hunt-adjusted primaries, to the power 0.7.
inline constexpr float kLargestColourPower = 41.2760980f;
inline constexpr float kColourExponent = 0.7f;  // q_c

/// 0..1: the distance to the power q_c, its lower part (p_c of it) spread over p_t of the range.
SKYLAPSE_INLINE float spread_colour_error(float distance) {
  constexpr float kPc = 0.4f, kPt = 0.95f, kKnee = kPc * kLargestColourPower;
  const float d = power_of(distance, kColourExponent);
  const float low = d * (kPt / kKnee);
  const float high = kPt + (d - kKnee) * ((1.0f - kPt) / (kLargestColourPower - kKnee));
  const float error = d < kKnee ? low : high;
  return error < 1.0f ? error : 1.0f;
}

/// Filtered Y, X - Y, Y - Z.
struct Opponent {
  float y, x_less_y, y_less_z;
};

/// dE_c of two colours given by their mean and difference.
SKYLAPSE_INLINE float colour_error(Opponent mean, Opponent change) {
  const Rgb m = rgb_of({mean.y + mean.x_less_y, mean.y, mean.y - mean.y_less_z});
  const Rgb d = rgb_of({change.y + change.x_less_y, change.y, change.y - change.y_less_z});
  const Channel r = shown_channel(m.r, d.r), g = shown_channel(m.g, d.g),
                b = shown_channel(m.b, d.b);
  const Xyz t1 = xyz_of({r.a, g.a, b.a}), t2 = xyz_of({r.b, g.b, b.b});
  const Xyz dt = xyz_of({r.difference, g.difference, b.difference});
  const Xyz f1{lab_curve(t1.x), lab_curve(t1.y), lab_curve(t1.z)};
  const Xyz f2{lab_curve(t2.x), lab_curve(t2.y), lab_curve(t2.z)};
  const float dx = lab_curve_change(t1.x, t2.x, dt.x, f1.x, f2.x);
  const float dy = lab_curve_change(t1.y, t2.y, dt.y, f1.y, f2.y);
  const float dz = lab_curve_change(t1.z, t2.z, dt.z, f1.z, f2.z);
  const float mx = f1.x + f2.x, my = f1.y + f2.y, mz = f1.z + f2.z;  // twice the means
  const float lightness = 58.0f * my - 16.0f, lightness_change = 116.0f * dy;
  const float a_mean = 250.0f * (mx - my), a_change = 500.0f * (dx - dy);
  const float b_mean = 100.0f * (my - mz), b_change = 200.0f * (dy - dz);
  // Hunt: a' = 0.01 L a, so that da' = 0.01 (L da + a dL) with L and a the means.
  const float hunt_a = 0.01f * (lightness * a_change + a_mean * lightness_change);
  const float hunt_b = 0.01f * (lightness * b_change + b_mean * lightness_change);
  return spread_colour_error(std::fabs(lightness_change) +
                             std::sqrt(hunt_a * hunt_a + hunt_b * hunt_b));
}

}  // namespace skylapse::image::flip_internal
