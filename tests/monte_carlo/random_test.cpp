#include "sky/monte_carlo/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skylapse::sky::monte_carlo {
namespace {

// Random123 of Salmon et al., file kat_vectors, philox4x32 with 10 rounds.
TEST(Philox, GivesTheKnownAnswersOfItsAuthors) {
  using Block = std::array<uint32_t, 4>;
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  constexpr uint32_t k = 0xffffffff;
  EXPECT_EQ(philox({k, k, k, k}, {k, k}), (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(PathRandom, IsUniformAndNeverZeroOrOne) {
  double sum = 0, squares = 0;
  constexpr int n = 100000;
  for (int path = 0; path < n / 10; ++path) {
    PathRandom random(7, uint64_t(path));
    for (int i = 0; i < 10; ++i) {
      const double u = random.uniform();
      ASSERT_GT(u, 0);
      ASSERT_LT(u, 1);
      sum += u, squares += u * u;
    }
  }
  // Four standard errors of the mean of u and of u^2 (variances 1/12 and 4/45).
  EXPECT_NEAR(sum / n, 0.5, 4 * std::sqrt(1.0 / 12 / n));
  EXPECT_NEAR(squares / n, 1.0 / 3, 4 * std::sqrt(4.0 / 45 / n));
}

TEST(PathRandom, DiffersBetweenPathsAndSeeds) {
  PathRandom a(1, 0), b(1, 1), c(2, 0), again(1, 0);
  const double first = a.uniform();
  EXPECT_NE(first, b.uniform());
  EXPECT_NE(first, c.uniform());
  EXPECT_EQ(first, again.uniform());
}

}  // namespace
}  // namespace skylapse::sky::monte_carlo
