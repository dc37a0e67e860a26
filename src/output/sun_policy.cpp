#include "output/sun_policy.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "output/stored_numbers.h"

namespace skylapse::output {
namespace {

bool beyond_half(const float* pixel) {
  return std::fabs(pixel[0]) > kLargestHalf || std::fabs(pixel[1]) > kLargestHalf ||
         std::fabs(pixel[2]) > kLargestHalf;
}

float cut(float v) {  // NaN fails both comparisons and stays
  return v > kLargestHalf ? kLargestHalf : (v < -kLargestHalf ? -kLargestHalf : v);
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

Error too_dark() {
  return {.code = ErrorCode::invalid_input,
          .message = "the image is too dark for half floats, which end at 6e-8",
          .hint = "write 32-bit floats, or choose the sun policy float or scale"};
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

void RangeSurvey::add(std::span<const float> rgb, std::span<const float> kept, int width) {
  assert(rgb.size() == kept.size() && rgb.size() % (size_t{3} * width) == 0);
  const size_t samples = size_t{3} * width, rows = rgb.size() / samples;
  const bool same = rgb.data() == kept.data();
  std::vector<RangeSurvey> of_row(rows);
  parallel_for_ranges(rows, 16, [&](size_t begin, size_t end) {
    for (size_t y = begin; y < end; ++y) {
      RangeSurvey& row = of_row[y];
      for (size_t i = y * samples; i < (y + 1) * samples; i += 3) {
        row.pixels_beyond_half += beyond_half(&rgb[i]) ? 1 : 0;
        if (!same) row.kept_beyond_half += beyond_half(&kept[i]) ? 1 : 0;
        for (size_t c = i; c < i + 3; ++c) {
          const float v = rgb[c], k = cut(kept[c]);
          if (std::fabs(v) > row.largest) row.largest = std::fabs(v);
          row.sum += std::isnan(v) ? 0.0 : double(v);
          row.kept_sum += std::isnan(k) ? 0.0 : double(k);
          row.half_sum += std::isnan(k) ? 0.0 : double(rounded_to_half(k));
        }
      }
      if (same) row.kept_beyond_half = row.pixels_beyond_half;
    }
  });
  for (const RangeSurvey& row : of_row) {  // in order: the same sum for any pieces
    largest = std::max(largest, row.largest);
    pixels_beyond_half += row.pixels_beyond_half;
    kept_beyond_half += row.kept_beyond_half;
    sum += row.sum;
    kept_sum += row.kept_sum;
    half_sum += row.half_sum;
  }
}

bool RangeSurvey::underflows_half() const {
  return kept_sum > 0 && std::fabs(half_sum / kept_sum - 1) > kLargestHalfLoss;
}

Result<SunPolicyRecord> decide_sun_policy(const RangeSurvey& survey, SunPolicy policy, bool half) {
  SunPolicyRecord record{.policy = policy, .pixels_beyond_half = survey.pixels_beyond_half};
  const bool fits = survey.pixels_beyond_half == 0;
  switch (policy) {
    case SunPolicy::float32:
      return record;
    case SunPolicy::refuse:
      if (!fits) return refused(survey.largest);
      if (half && survey.underflows_half()) return too_dark();
      return record;
    case SunPolicy::clip:
      if (!fits) record.lost_fraction = lost_share(survey.sum, survey.kept_sum);
      return record;
    case SunPolicy::scale:
      if (std::isinf(survey.largest)) return refused(survey.largest);
      if (!fits || (half && survey.underflows_half())) record.scale = fitting_scale(survey.largest);
      return record;
    case SunPolicy::split:
      record.pixels_beyond_half = survey.kept_beyond_half;
      record.lost_fraction = lost_share(survey.sum, survey.kept_sum);
      return record;
  }
  return record;
}

void apply_sun_policy(std::span<float> rgb, const SunPolicyRecord& decided) {
  if (decided.policy == SunPolicy::scale && decided.scale != 1.0) {
    const auto scale = float(decided.scale);
    for (float& v : rgb) v *= scale;
  }
  const bool cuts = decided.policy == SunPolicy::clip || decided.policy == SunPolicy::split;
  if (!cuts || decided.pixels_beyond_half == 0) return;
  for (float& v : rgb) v = cut(v);
}

Result<SunPolicyRecord> apply_sun_policy(image::FrameBuffer& frame, SunPolicy policy,
                                         const image::FrameBuffer* sky_only) {
  assert(policy != SunPolicy::split || (sky_only != nullptr && sky_only->width() == frame.width() &&
                                        sky_only->height() == frame.height()));
  const image::FrameBuffer& kept = policy == SunPolicy::split ? *sky_only : frame;
  RangeSurvey survey;
  survey.add(frame.data(), kept.data(), frame.width());
  const auto decided = decide_sun_policy(survey, policy);
  if (!decided) return decided;
  if (policy == SunPolicy::split) frame = *sky_only;
  apply_sun_policy(frame.data(), *decided);
  return decided;
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
