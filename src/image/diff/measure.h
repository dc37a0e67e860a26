#pragma once
// How far two pictures are apart, in numbers: everything but the perceptual measure (flip.h).
//
// Error of a sample. Scene-linear pictures: the difference as a share of the light,
//   e = (b - a) / max(|a|, |b|, 0.1 m, f),
// m the strongest colour channel of the pixel in either picture (a faint red beside a strong blue
// does not count as much as the blue), f 1e-4 of the median of the picture's positive light (1e-34
// if there is none): light that no exposure of the picture shows. In [-2, 2], symmetric, defined
// for zeros. Display pictures: the difference in 8-bit code values, 255 (b - a).
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "image/diff/picture.h"

namespace skylapse::image {

struct PixelPlace {
  int x = 0, y = 0;
  int channel = -1;  // number in Picture::channels, -1: all of them
};

/// One number. Names are those of docs/diff.md, "relative.rms", "relative.region.zenith.bias";
/// values are fractions (0.01 is 1 %), code values under "display.", degrees or pixels where the
/// name says so.
struct Measure {
  std::string name;
  double value = 0;
  std::optional<PixelPlace> place;  // where it is reached, if it is reached anywhere
};

/// Samples that are no numbers to measure with.
struct OddSamples {
  uint64_t nan_a = 0, nan_b = 0, nan_only_one = 0;
  uint64_t infinite_a = 0, infinite_b = 0, infinite_only_one = 0;  // of other sign: only one
  uint64_t negative_a = 0, negative_b = 0;  // below -0.1 % of the pixel's strongest channel
  uint64_t new_negative = 0;                // negative in b, not in a
  std::optional<PixelPlace> first_nan, first_infinite, first_negative;  // of only one
};

/// Sizes of the small picture that stands for a frame in measures over time.
inline constexpr int kThumbnailColumns = 32, kThumbnailRows = 16;

struct CompareOptions {
  std::optional<glm::dmat3> rgb_to_xyz;  // of scene-linear pictures; nothing: no chromaticity
  /// Rounding in the files is taken off errors (error_scale.h); not if every difference counts.
  bool forgive_rounding = true;
  std::optional<double> psnr_peak;  // nothing: 255 code values; linear: the brightest 0.1 % of a
};

struct Comparison {
  OddSamples odd;
  bool identical = false;  // every sample equal (0 and -0 are, NaN is NaN)
  std::vector<Measure> measures;
  std::vector<float> error;  // per pixel the largest |e| of its channels; NaN or Inf in one: +Inf
  uint64_t hash_a = 0, hash_b = 0;  // of the samples
  /// Mean light of the cells of a grid of kThumbnailRows by kThumbnailColumns (of colour channels
  /// together: their mean), row by row; 0 where a small picture has no pixel for a cell.
  std::vector<float> thumbnail_a, thumbnail_b;
  /// Regions of the sky that the picture shows, with their mean light in both.
  struct RegionLight {
    std::string region;
    double a = 0, b = 0;
  };
  std::vector<RegionLight> regions;
};

/// Both pictures have one size and the same channels (asserted).
Comparison compare(const Picture& a, const Picture& b, const SkyView& view,
                   const CompareOptions& options = {});

}  // namespace skylapse::image
