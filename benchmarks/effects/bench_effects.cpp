// What `effects: auto` leaves out of drawn scenes, what that changes, and the time it saves.
//   bench_effects [SCENES] [SEED] [LEVEL] [KEYS OF THE SKY] [LIST]
// With LIST, two words of sky.effects are compared instead: "auto" and LIST.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "effects/drawn_scenes.h"
#include "effects/proof.h"

using namespace skylapse;
using namespace skylapse::effects_proof;

namespace {

double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[size_t(q * double(values.size() - 1) + 0.5)];
}

void print_quantiles(const char* what, const std::vector<double>& values) {
  fmt::print("{:<34}", what);
  for (const double q : {0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0})
    fmt::print(" {:>9.3g}", quantile(values, q));
  fmt::print("\n");
}

}  // namespace

int main(int argc, char** argv) {
  const int scenes = argc > 1 ? std::atoi(argv[1]) : 200;
  const uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  Fineness fineness{argc > 3 ? argv[3] : "standard", argc > 4 ? argv[4] : "", 64};
  const std::string other = argc > 5 ? argv[5] : "all";
  std::vector<double> errors, margins, codes, means, saved, seconds_auto, seconds_all;
  std::map<std::string, int> left;
  int broken = 0;
  for (int i = 0; i < scenes; ++i) {
    const std::string scene = drawn_scene(seed, i, fineness);
    const auto some = picture_of(scene, "auto", plan::standard_rules());
    const auto all = picture_of(scene, other, plan::standard_rules());
    if (!some || !all) {
      for (const Error& e : some ? all.error() : some.error())
        fmt::print("scene {}: {}\n{}", i, format_error(e), scene);
      ++broken;
      continue;
    }
    const Change change = change_of(*some, *all);
    if (!change.holds()) {
      ++broken;
      fmt::print("scene {}: {}\n{}", i, change.text(), scene);
    }
    errors.push_back(change.error), codes.push_back(change.codes);
    means.push_back(change.mean_codes);
    margins.push_back(change.error / (change.bound + Change::kRounding));
    seconds_auto.push_back(some->core_seconds), seconds_all.push_back(all->core_seconds);
    saved.push_back(1 - some->core_seconds / all->core_seconds);
    for (const auto& decision : some->decisions)
      if (!decision.on) ++left[name_of(decision.effect)];
    std::fflush(stdout);
  }
  fmt::print("{} scenes, seed {}, level {}: {} break a bound\n", scenes, seed, fineness.level,
             broken);
  fmt::print("{:<34} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "", "least", "10 %", "25 %",
             "median", "75 %", "90 %", "most");
  print_quantiles("error of the worst pixel", errors);
  print_quantiles("over the stated bound", margins);
  print_quantiles("8-bit values, greatest difference", codes);
  print_quantiles("8-bit values, greatest mean", means);
  print_quantiles("core seconds, all", seconds_all);
  print_quantiles("core seconds, auto", seconds_auto);
  print_quantiles("share of the time saved", saved);
  for (const auto& [name, count] : left) fmt::print("left out in {:>4}: {}\n", count, name);
  return broken == 0 ? 0 : 1;
}
