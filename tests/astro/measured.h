#pragma once
// Prints the figure a test measured beside its limit, so that a green run is a report too.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace skylapse::astro::test {

/// The largest magnitude seen and where.
struct Largest {
  double value = 0;
  std::string where;
  void see(double magnitude, const std::string& place) {
    if (!(magnitude <= value)) value = magnitude, where = place;  // a NaN is kept
  }
};

inline void expect_within(const Largest& seen, double limit, const std::string& what) {
  std::printf("[ measured ] %s: %.3g (limit %.3g) at %s\n", what.c_str(), seen.value, limit,
              seen.where.c_str());
  EXPECT_LE(seen.value, limit) << what << " at " << seen.where;
}

}  // namespace skylapse::astro::test
