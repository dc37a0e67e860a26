// Every sweep, short: no number that is none, no broken law, no error beyond its bound. The command
// "sweep" runs the same with ten million evaluations each.
#include <gtest/gtest.h>

#include <algorithm>

#include "sweeps/sweep.h"

namespace skylapse::sweeps {
namespace {

constexpr long kCount = 20'000;

class Domain : public testing::TestWithParam<size_t> {};

TEST_P(Domain, IsFiniteLawfulAndWithinItsBound) {
  const Sweep sweep = all_sweeps()[GetParam()];
  const Finding found = run(sweep, kCount, GetParam() + 2);
  EXPECT_GT(found.evaluations, 0);
  EXPECT_EQ(found.non_finite, 0) << sweep.name << " at " << found.first_broken;
  EXPECT_EQ(found.broken, 0) << sweep.name << " at " << found.first_broken;
  EXPECT_LE(found.worst, sweep.bound)
      << sweep.name << ", " << sweep.measure << ", at " << found.where << "\n"
      << sweep.reason;
}

std::string name_of(const testing::TestParamInfo<size_t>& info) {
  std::string name = all_sweeps()[info.param].name;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Sweep, Domain, testing::Range(size_t{0}, all_sweeps().size()), name_of);

TEST(Sweeps, SeeAPlantedFault) {
  const Sweep faulty{"faulty", "absolute", 1e-3, "", 1, [](Draw& draw, Tally& tally) {
                       const double x = draw.in(-1, 1);
                       const auto where = [&] { return std::to_string(x); };
                       if (!tally.finite(x == 1 ? NAN : x, where)) return;
                       tally.law(x != -1, where);
                       tally.error(std::abs(x), where);
                     }};
  const Finding found = run(faulty, 10'000, 1);
  EXPECT_GT(found.non_finite, 0);
  EXPECT_GT(found.broken, 0);
  EXPECT_NEAR(found.worst, 1, 1e-6);
  EXPECT_FALSE(found.first_broken.empty());
}

TEST(Sweeps, DrawTheEndsTheirNeighboursAndDenormals) {
  bool low = false, high = false, beside = false, denormal = false, zero = false;
  for (uint64_t i = 0; i < 10'000; ++i) {
    Draw draw(7, i);
    const double x = draw.in(-2, 3);
    ASSERT_GE(x, -2);
    ASSERT_LE(x, 3);
    low |= x == -2;
    high |= x == 3;
    beside |= x == std::nextafter(3, -2);
    denormal |= std::fpclassify(x) == FP_SUBNORMAL;
    zero |= x == 0;
  }
  EXPECT_TRUE(low && high && beside && denormal && zero);
}

}  // namespace
}  // namespace skylapse::sweeps
