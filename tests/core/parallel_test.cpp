#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

using namespace skylapse;

TEST(ParallelForRanges, TouchesEveryItemOnce) {
  for (const size_t count : {0u, 1u, 7u, 10000u}) {
    std::vector<std::atomic<int>> hits(count);
    parallel_for_ranges(count, 16, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) ++hits[i];
    });
    for (const auto& hit : hits) EXPECT_EQ(hit, 1);
  }
}

TEST(ThreadLimit, OneThreadStillFinishesTheWork) {
  const ThreadLimit limit(1);
  EXPECT_EQ(allowed_threads(), 1);
  std::atomic<size_t> sum = 0;
  parallel_for_ranges(1000, 1, [&](size_t begin, size_t end) { sum += end - begin; });
  EXPECT_EQ(sum, 1000u);
}
