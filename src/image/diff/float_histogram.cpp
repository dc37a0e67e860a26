#include "image/diff/float_histogram.h"

#include <bit>
#include <cassert>
#include <mutex>

#include "core/parallel.h"

namespace skylapse::image {

int FloatHistogram::bin_of(float value) { return int(std::bit_cast<uint32_t>(value) >> 16); }

float FloatHistogram::lower_bound(int bin) { return std::bit_cast<float>(uint32_t(bin) << 16); }

void FloatHistogram::add(float value) {
  const auto bits = std::bit_cast<uint32_t>(value);
  assert(bits >> 16 < kBins);
  Bin& bin = bins_[bits >> 16];
  ++bin.count;
  bin.low_bits += bits & 0xffff;
}

void FloatHistogram::add(const FloatHistogram& other) {
  for (size_t i = 0; i < bins_.size(); ++i) {
    bins_[i].count += other.bins_[i].count;
    bins_[i].low_bits += other.bins_[i].low_bits;
  }
}

uint64_t FloatHistogram::count() const {
  uint64_t sum = 0;
  for (const Bin& bin : bins_) sum += bin.count;
  return sum;
}

double FloatHistogram::sum_of(int bin) const {
  const Bin& b = bins_[size_t(bin)];
  // Within a bin values are the lower bound plus so many units in the last place: those of its
  // power of two, which its neighbour in an even pair shares.
  const double width = double(lower_bound(bin | 1)) - double(lower_bound(bin & ~1));
  return double(lower_bound(bin)) * double(b.count) + width * 0x1p-16 * double(b.low_bits);
}

double FloatHistogram::sum() const {
  double sum = 0;
  for (int bin = 0; bin < kBins; ++bin) sum += sum_of(bin);
  return sum;
}

int FloatHistogram::bin_of_rank(uint64_t rank) const {
  uint64_t below = 0;
  for (int bin = 0; bin < kBins; ++bin) {
    below += bins_[size_t(bin)].count;
    if (below > rank) return bin;
  }
  assert(false && "rank beyond the number of values");
  return kBins - 1;
}

namespace {

/// Calls each(part, value) for all values, with one `Part` for each piece of the work, and
/// merge(part) when a piece is done.
template <class Part, class Each, class Merge>
void visit(const FloatRows& rows, const Part& empty, Each each, Merge merge) {
  constexpr size_t kRowsAtOnce = 64;
  std::mutex mutex;
  parallel_for_ranges(size_t(rows.height), kRowsAtOnce, [&](size_t begin, size_t end) {
    Part part = empty;
    std::vector<float> buffer(size_t(rows.width));
    for (size_t y = begin; y < end; ++y) {
      const float* row = rows.row(int(y), buffer.data());
      for (int x = 0; x < rows.width; ++x) each(part, row[x]);
    }
    const std::lock_guard lock(mutex);
    merge(part);
  });
}

}  // namespace

FloatHistogram histogram_of(const FloatRows& rows) {
  FloatHistogram all;
  visit(
      rows, FloatHistogram{}, [](FloatHistogram& part, float value) { part.add(value); },
      [&](const FloatHistogram& part) { all.add(part); });
  return all;
}

std::vector<uint64_t> counts_within(const FloatRows& rows, int bin) {
  using Counts = std::vector<uint64_t>;
  Counts all(0x10000);
  visit(
      rows, Counts(all.size()),
      [bin](Counts& part, float value) {
        const auto bits = std::bit_cast<uint32_t>(value);
        if (int(bits >> 16) == bin) ++part[bits & 0xffff];
      },
      [&](const Counts& part) {
        for (size_t i = 0; i < all.size(); ++i) all[i] += part[i];
      });
  return all;
}

float value_within(int bin, size_t low_bits) {
  return std::bit_cast<float>((uint32_t(bin) << 16) | uint32_t(low_bits));
}

}  // namespace skylapse::image
