#include "core/pipeline.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "core/parallel.h"

namespace skylapse {
namespace {

std::function<std::optional<int>()> numbers_below(int count, int& next) {
  return [count, &next]() -> std::optional<int> {
    if (next == count) return {};
    return next++;
  };
}

TEST(Pipeline, FinishesEveryItemInTheOrderItWasMade) {
  int next = 0;
  std::vector<int> finished;
  run_pipeline<int>(
      8, numbers_below(1000, next), [](int& item) { item *= 3; },
      [&](int& item) { finished.push_back(item); }, FinishOrder::as_made);
  ASSERT_EQ(finished.size(), 1000U);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(finished[i], 3 * i);
}

TEST(Pipeline, HoldsNoMoreItemsThanItMay) {
  int next = 0;
  std::atomic<int> alive = 0, most = 0;
  const auto make = [&]() -> std::optional<int> {
    if (next == 200) return {};
    const int now = ++alive;
    most = std::max(most.load(), now);
    return next++;
  };
  run_pipeline<int>(
      3, make, [](int&) {}, [&](int&) { --alive; }, FinishOrder::as_done);
  EXPECT_LE(most.load(), 3);
  EXPECT_EQ(alive.load(), 0);
}

TEST(Pipeline, OfNothingDoesNothing) {
  int next = 0, finished = 0;
  run_pipeline<int>(
      4, numbers_below(0, next), [](int&) {}, [&](int&) { ++finished; }, FinishOrder::as_done);
  EXPECT_EQ(finished, 0);
}

TEST(Pipeline, WorkMayItselfBeParallel) {
  int next = 0;
  long sum = 0;
  run_pipeline<int>(
      4, numbers_below(50, next),
      [](int& item) {
        std::atomic<int> count = 0;
        parallel_for_ranges(100, 1, [&](size_t begin, size_t end) { count += int(end - begin); });
        item = count;
      },
      [&](int& item) { sum += item; }, FinishOrder::as_done);
  EXPECT_EQ(sum, 5000);
}

}  // namespace
}  // namespace skylapse
