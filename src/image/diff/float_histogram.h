#pragma once
// Order and sums of many non-negative floats, whatever the order they come in.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace skylapse::image {

/// Values >= 0, finite, sorted into steps of 1/128 of a power of two: by the upper half of their
/// bits. Numbers and sums are whole numbers inside, so that threads may add in any order.
class FloatHistogram {
 public:
  static constexpr int kBins = 0x7f80;
  FloatHistogram() : bins_(kBins) {}

  void add(float value);
  void add(const FloatHistogram& other);

  [[nodiscard]] uint64_t count() const;
  [[nodiscard]] double sum() const;
  /// Sum of the values of one bin; its number of values.
  [[nodiscard]] double sum_of(int bin) const;
  [[nodiscard]] uint64_t count_of(int bin) const { return bins_[size_t(bin)].count; }
  /// The bin that holds element `rank` of the ascending list; rank < count().
  [[nodiscard]] int bin_of_rank(uint64_t rank) const;
  /// The smallest value of a bin.
  static float lower_bound(int bin);
  static int bin_of(float value);

 private:
  struct Bin {
    uint64_t count = 0, low_bits = 0;
  };
  std::vector<Bin> bins_;
};

/// Rows of floats: returns `width` values, held by the caller or in `buffer` (of that size).
struct FloatRows {
  int width = 0, height = 0;
  std::function<const float*(int y, float* buffer)> row;
};

/// All values of the rows, read in parallel.
FloatHistogram histogram_of(const FloatRows& rows);

/// How often each value of one bin occurs, by the lower half of its bits.
std::vector<uint64_t> counts_within(const FloatRows& rows, int bin);

/// The value of a bin with those lower bits.
float value_within(int bin, size_t low_bits);

}  // namespace skylapse::image
