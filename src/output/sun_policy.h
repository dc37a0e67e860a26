#pragma once
// What a half-float or RGBE file does with the sun's disc, and what that cost.
#include <span>
#include <string>

#include "core/result.h"
#include "image/frame_buffer.h"
#include "output/image_writer.h"

namespace skylapse::output {

/// Largest finite half float (IEEE 754-2008, binary16).
inline constexpr float kLargestHalf = 65504.0f;

/// What became of a frame on its way into such a file; written to metadata and manifest.
struct SunPolicyRecord {
  SunPolicy policy = SunPolicy::clip;
  /// Stored = radiance * scale; a power of two, above 1 for dark pictures, 1 unless the policy is
  /// `scale`. Value 1 in the file then stands for 683 / scale cd/m^2.
  double scale = 1.0;
  /// Pixels with a channel beyond 65504 before the policy acted.
  long pixels_beyond_half = 0;
  /// Share of the sum of all samples (of the whole image) that the file does not hold: the part cut
  /// off by `clip`, or the disc left out by `split`. 0 for the others.
  double lost_fraction = 0.0;
};

/// True if some finite or infinite sample lies outside +-65504. NaN does not count.
bool exceeds_half(const image::FrameBuffer& frame);

/// Share of a picture's sum of samples that may be lost or gained by half floats without a sun in
/// it, before policies that can help do. Rounding of usual skies is below 1e-5.
inline constexpr double kLargestHalfLoss = 0.001;

/// What a policy must know of a picture before any of it is written, gathered in pieces of rows.
/// The same for any pieces and any number of threads.
struct RangeSurvey {
  float largest = 0;            // magnitude of all samples; NaN is passed over
  long pixels_beyond_half = 0;  // with a channel beyond 65504
  double sum = 0;               // of all samples but NaN
  double kept_sum = 0;          // the same of what `kept` holds, cut to 65504
  long kept_beyond_half = 0;
  double half_sum = 0;  // of `kept_sum`'s samples as half floats

  /// Adds rows of `width` pixels. `kept`: the rows that will be written, of the same size: those
  /// without the disc for `split`, else `rgb` itself.
  void add(std::span<const float> rgb, std::span<const float> kept, int width);
  /// Whether half floats are too coarse for the picture: their sum is off by more than
  /// kLargestHalfLoss. Moonless nights are: below 6e-8 (4e-5 cd/m^2) there are none.
  [[nodiscard]] bool underflows_half() const;
};

/// What becomes of a picture with that range.
///   float32 it is left as it is: the file's type follows
///   refuse  error (invalid_input) naming the brightest sample, if there is one beyond 65504, or if
///           `half` and the picture is too dark for half floats
///   clip    samples are limited to +-65504
///   scale   all samples are multiplied by the largest power of two that makes them fit (exact but
///           for numbers that fall below the smallest half, 6e-8), if they do not, or if `half` and
///           they are so dark that half floats are too coarse for them
///   split   the picture without the disc is written; whatever of that still exceeds 65504 is
///           clipped and counted
Result<SunPolicyRecord> decide_sun_policy(const RangeSurvey& survey, SunPolicy policy,
                                          bool half = true);

/// Does to samples what was decided; of `split` they are those without the disc.
void apply_sun_policy(std::span<float> rgb, const SunPolicyRecord& decided);

/// All of it for a picture in memory. Precondition: with `split`, `sky_only` is given and has the
/// frame's size (asserted).
Result<SunPolicyRecord> apply_sun_policy(image::FrameBuffer& frame, SunPolicy policy,
                                         const image::FrameBuffer* sky_only = nullptr);

/// "float", "refuse", "clip", "scale", "split".
std::string sun_policy_name(SunPolicy policy);

}  // namespace skylapse::output
