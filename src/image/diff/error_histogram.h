#pragma once
#include <cstdint>
#include <vector>

namespace skylapse::image {

/// Counts of pixels' errors, small enough for one of every part of a picture (FloatHistogram is
/// finer and two hundred times as large), in bins of a 32nd of an octave, from 2^-40; below: bin 0.
class ErrorHistogram {
 public:
  void add(float error);
  void add(const ErrorHistogram& other);
  /// The error that a share of the pixels does not exceed: the upper end of its bin, at most 2.2 %
  /// too large; 0 where the bin is the lowest. NaN without pixels.
  [[nodiscard]] double percentile(double share) const;

 private:
  std::vector<uint32_t> bins_;
  uint64_t count_ = 0;
};

}  // namespace skylapse::image
