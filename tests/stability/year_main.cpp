// year_walk [YEAR]: a whole year (2026 if not named) minute by minute at six places; prints the
// greatest step of sun, refraction, exposure and light with its bound. Exit 1 if one is exceeded.
#include <fmt/format.h>

#include <cstdlib>

#include "core/parallel.h"
#include "stability/year_walk.h"

using namespace skylapse;

int main(int argc, char** argv) {
  const int year = argc > 1 ? std::atoi(argv[1]) : 2026;
  const auto begin = astro::parse_instant(fmt::format("{}-01-01T00:00Z", year));
  const auto end = astro::parse_instant(fmt::format("{}-01-01T00:00Z", year + 1));
  if (!begin || !end) {
    fmt::print(stderr, "usage: year_walk [YEAR], 1900 to 2198\n");
    return 3;
  }
  const long minutes = std::lround((*end - *begin).in(minute));
  std::array<stability::Steps, 6> found;
  parallel_for_ranges(found.size(), 1, [&](size_t from, size_t to) {
    for (size_t i = from; i < to; ++i)
      found[i] = stability::walk(stability::places()[i], *begin, minutes);
  });
  stability::Steps all;
  for (size_t i = 0; i < found.size(); ++i) {
    fmt::print("{}: {}\n", stability::places()[i].name, stability::table(found[i]));
    all.add(found[i]);
  }
  fmt::print("all places: {}", stability::table(all));
  return stability::within_bounds(all) ? 0 : 1;
}
