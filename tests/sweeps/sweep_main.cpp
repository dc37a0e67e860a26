// sweep [COUNT [WORD...]]: every public physics function COUNT times (10 million if not named) over
// its whole domain; only sweeps whose name holds one of the words, if there are any. Prints, for
// each, evaluations, values that are not finite, broken laws, the greatest error with its bound and
// arguments. Exit 1 if a number is not finite, a law is broken or a bound exceeded.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

#include "sweeps/sweep.h"

using namespace skylapse::sweeps;

namespace {

bool asked_for(const Sweep& sweep, int argc, char** argv) {
  if (argc <= 2) return true;
  for (int i = 2; i < argc; ++i)
    if (sweep.name.find(argv[i]) != std::string::npos) return true;
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  const long count = argc > 1 ? std::atol(argv[1]) : 10'000'000;
  if (count < 1) {
    fmt::print(stderr, "usage: sweep [COUNT [WORD...]], COUNT at least 1\n");
    return 3;
  }
  long evaluations = 0, bad = 0;
  fmt::print("{:<44} {:>11} {:>5} {:>5} {:>9} {:>9}  {}\n", "function", "evaluations", "nan", "law",
             "error", "bound", "of what; where the error is greatest");
  uint64_t seed = 1;
  for (const Sweep& sweep : all_sweeps()) {
    ++seed;
    if (!asked_for(sweep, argc, argv)) continue;
    const auto start = std::chrono::steady_clock::now();
    const Finding found = run(sweep, count, seed);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    evaluations += found.evaluations;
    const bool good = found.non_finite == 0 && found.broken == 0 && found.worst <= sweep.bound;
    bad += good ? 0 : 1;
    fmt::print("{:<44} {:>11} {:>5} {:>5} {:>9.2e} {:>9.2e}  {}; {} ({:.1f} s){}\n", sweep.name,
               found.evaluations, found.non_finite, found.broken, found.worst, sweep.bound,
               sweep.measure, found.where.empty() ? "none" : found.where, seconds,
               good ? "" : "  <-- " + found.first_broken);
    std::fflush(stdout);
  }
  fmt::print("{} evaluations, {} sweeps out of bounds\n", evaluations, bad);
  return bad == 0 ? 0 : 1;
}
