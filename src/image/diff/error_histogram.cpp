#include "image/diff/error_histogram.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace skylapse::image {
namespace {

constexpr int kBinsPerOctave = 32, kLowestExponent = -40, kHighestExponent = 10;
constexpr uint32_t kLowestBits = uint32_t(127 + kLowestExponent) << 23;
constexpr uint32_t kBinShift = 23 - 5;
constexpr size_t kBins = size_t(kHighestExponent - kLowestExponent) * kBinsPerOctave + 2;

}  // namespace

void ErrorHistogram::add(float error) {
  if (bins_.empty()) bins_.resize(kBins);
  const auto bits = std::bit_cast<uint32_t>(error);  // never negative
  const size_t bin = bits < kLowestBits ? 0 : ((bits - kLowestBits) >> kBinShift) + 1;
  ++bins_[std::min(bin, kBins - 1)];
  ++count_;
}

void ErrorHistogram::add(const ErrorHistogram& other) {
  if (other.bins_.empty()) return;
  if (bins_.empty()) bins_.resize(kBins);
  for (size_t i = 0; i < kBins; ++i) bins_[i] += other.bins_[i];
  count_ += other.count_;
}

double ErrorHistogram::percentile(double share) const {
  if (count_ == 0) return std::numeric_limits<double>::quiet_NaN();
  const auto wanted = uint64_t(std::ceil(share * double(count_)));
  uint64_t below = 0;
  for (size_t i = 0; i < kBins; ++i) {
    below += bins_[i];
    if (below < std::max<uint64_t>(wanted, 1)) continue;
    if (i == 0) return 0;
    return double(std::bit_cast<float>(kLowestBits + (uint32_t(i) << kBinShift)));
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace skylapse::image
