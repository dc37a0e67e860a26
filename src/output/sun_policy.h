#pragma once
// What a half-float file does with the sun's disc, and what that cost.
#include <string>

#include "core/result.h"
#include "image/frame_buffer.h"
#include "output/image_writer.h"

namespace skylapse::output {

/// Largest finite half float (IEEE 754-2008, binary16).
inline constexpr float kLargestHalf = 65504.0f;

/// What became of a frame on its way into a half-float file; written to metadata and manifest.
struct SunPolicyRecord {
  SunPolicy policy = SunPolicy::clip;
  /// Stored = radiance * scale; a power of two, 1 unless the policy is `scale`. Value 1 in the file
  /// then stands for 683 / scale cd/m^2.
  double scale = 1.0;
  /// Pixels with a channel beyond 65504 before the policy acted.
  long pixels_beyond_half = 0;
  /// Share of the sum of all samples (of the whole image) that the file does not hold: the part cut
  /// off by `clip`, or the disc left out by `split`. 0 for the others.
  double lost_fraction = 0.0;
};

/// True if some finite or infinite sample lies outside +-65504. NaN does not count.
bool exceeds_half(const image::FrameBuffer& frame);

/// Makes `frame` fit a half-float file, in place.
///   float32 leaves it as it is: the file's type follows
///   refuse  error (invalid_input) naming the brightest sample, if there is one beyond 65504
///   clip    limits samples to +-65504
///   scale   multiplies all samples by the largest power of two that makes them fit (exact but for
///           numbers that fall below the smallest half, 6e-8)
///   split   replaces the frame by `sky_only`, the same frame rendered without the disc; whatever
///           of that still exceeds 65504 is clipped and counted
/// Precondition: with `split`, `sky_only` is given and has the frame's size (asserted).
Result<SunPolicyRecord> apply_sun_policy(image::FrameBuffer& frame, SunPolicy policy,
                                         const image::FrameBuffer* sky_only = nullptr);

/// "float", "refuse", "clip", "scale", "split".
std::string sun_policy_name(SunPolicy policy);

}  // namespace skylapse::output
