#include "output/sun_policy.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace skylapse::output {
namespace {

/// Largest magnitude of all samples; NaN is passed over.
float largest_magnitude(const image::FrameBuffer& frame) {
  float largest = 0;
  for (const float v : frame.data())
    if (std::fabs(v) > largest) largest = std::fabs(v);
  return largest;
}

/// Sum of the samples but for NaN, in double: a frame has millions of them.
double sum_of(const image::FrameBuffer& frame) {
  double sum = 0;
  for (const float v : frame.data()) sum += std::isnan(v) ? 0.0 : static_cast<double>(v);
  return sum;
}

long count_beyond(const image::FrameBuffer& frame) {
  long count = 0;
  for (size_t i = 0; i < frame.data().size(); i += 3) {
    const float* const p = frame.data().data() + i;
    count += std::fabs(p[0]) > kLargestHalf || std::fabs(p[1]) > kLargestHalf ||
                     std::fabs(p[2]) > kLargestHalf
                 ? 1
                 : 0;
  }
  return count;
}

void clip(image::FrameBuffer& frame) {
  for (float& v : frame.data())  // NaN fails both comparisons and stays
    v = v > kLargestHalf ? kLargestHalf : (v < -kLargestHalf ? -kLargestHalf : v);
}

double lost_share(double before, double after) {
  if (!std::isfinite(before)) return 1.0;  // something infinite was cut to something finite
  return before > 0 ? 1.0 - after / before : 0.0;
}

Error refused(float largest) {
  return {.code = ErrorCode::invalid_input,
          .message = "the image reaches " + std::to_string(std::lround(largest)) +
                     ", beyond the half-float limit of 65504",
          .hint = "write 32-bit floats, or choose the sun policy clip, scale or split"};
}

/// The largest power of two that brings `largest` to 65504 or less.
double fitting_scale(float largest) {
  int exponent = 0;
  std::frexp(largest / kLargestHalf, &exponent);  // largest <= 65504 * 2^exponent
  const double scale = std::exp2(-exponent);
  return 2.0 * scale * largest <= kLargestHalf ? 2.0 * scale : scale;
}

}  // namespace

bool exceeds_half(const image::FrameBuffer& frame) {
  return std::any_of(frame.data().begin(), frame.data().end(),
                     [](float v) { return std::fabs(v) > kLargestHalf; });
}

Result<SunPolicyRecord> apply_sun_policy(image::FrameBuffer& frame, SunPolicy policy,
                                         const image::FrameBuffer* sky_only) {
  SunPolicyRecord record{.policy = policy, .pixels_beyond_half = count_beyond(frame)};
  switch (policy) {
    case SunPolicy::float32:
      return record;
    case SunPolicy::refuse:
      if (record.pixels_beyond_half > 0) return refused(largest_magnitude(frame));
      return record;
    case SunPolicy::clip:
      if (record.pixels_beyond_half > 0) {
        const double before = sum_of(frame);
        clip(frame);
        record.lost_fraction = lost_share(before, sum_of(frame));
      }
      return record;
    case SunPolicy::scale: {
      const float largest = largest_magnitude(frame);
      if (std::isinf(largest)) return refused(largest);
      if (record.pixels_beyond_half == 0) return record;
      record.scale = fitting_scale(largest);
      for (float& v : frame.data()) v *= static_cast<float>(record.scale);
      return record;
    }
    case SunPolicy::split: {
      assert(sky_only != nullptr && sky_only->width() == frame.width() &&
             sky_only->height() == frame.height());
      const double before = sum_of(frame);
      frame = *sky_only;
      record.pixels_beyond_half = count_beyond(frame);
      if (record.pixels_beyond_half > 0) clip(frame);
      record.lost_fraction = lost_share(before, sum_of(frame));
      return record;
    }
  }
  return record;
}

std::string sun_policy_name(SunPolicy policy) {
  switch (policy) {
    case SunPolicy::float32:
      return "float";
    case SunPolicy::refuse:
      return "refuse";
    case SunPolicy::clip:
      return "clip";
    case SunPolicy::scale:
      return "scale";
    case SunPolicy::split:
      return "split";
  }
  return "";
}

}  // namespace skylapse::output
