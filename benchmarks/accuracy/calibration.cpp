// Measures the errors from which the planner's bounds are made.
//
//   accuracy_calibration measure FILE.csv --seed S --count N [--first I] [--paths P]
//       [--tables-every K]
//   accuracy_calibration fit FILE.csv > data/accuracy/error_bounds.table
//
// `measure` appends one line a scene, scenes I to I + N - 1 of the seed; those that the file has
// are passed over. Every Kth scene is measured in full, the others without their tables.
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <string>

#include "study/calibration_file.h"
#include "study/fit_errors.h"

namespace {

using namespace skylapse;
using namespace skylapse::study;

struct Arguments {
  std::string command, file;
  uint64_t seed = 1;
  int count = 10, first = 0, tables_every = 1;
  MeasureOptions measure;
};

Arguments parse(int argc, char** argv) {
  Arguments a;
  if (argc > 2) a.command = argv[1], a.file = argv[2];
  for (int i = 3; i + 1 < argc; i += 2) {
    const std::string name = argv[i];
    const long value = std::atol(argv[i + 1]);
    if (name == "--seed") a.seed = uint64_t(value);
    if (name == "--count") a.count = int(value);
    if (name == "--first") a.first = int(value);
    if (name == "--tables-every") a.tables_every = int(value);
    if (name == "--paths") a.measure.paths = value;
  }
  return a;
}

int measure(const Arguments& a) {
  std::set<std::pair<uint64_t, int>> known;
  if (const auto before = read_measured(a.file))
    for (const MeasuredScene& m : *before) known.emplace(m.seed, m.index);
  std::ofstream out(a.file, std::ios::app);
  if (known.empty()) out << measured_header() << std::endl;
  for (int index = a.first; index < a.first + a.count; ++index) {
    if (known.contains({a.seed, index})) continue;
    MeasureOptions options = a.measure;
    options.seed = a.seed * 4099 + uint64_t(index);
    options.tables = index % a.tables_every == 0;
    const AccuracyScene scene = draw_scene(a.seed, index);
    const MeasuredScene m{a.seed, index, scene, measure_scene(scene, options)};
    out << measured_line(m) << std::endl;
  }
  return out ? 0 : 6;
}

int fit(const Arguments& a) {
  const auto scenes = read_measured(a.file);
  if (!scenes) return fmt::print(stderr, "{}\n", scenes.error().message), 4;
  const std::string source = fmt::format(
      "measured by accuracy_calibration over {} random scenes (seed {}), data/accuracy/README.md",
      scenes->size(), scenes->empty() ? 0 : scenes->front().seed);
  fmt::print("{}", table_text(fit_errors(*scenes), source));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments a = parse(argc, argv);
  if (a.command == "measure") return measure(a);
  if (a.command == "fit") return fit(a);
  fmt::print(stderr, "accuracy_calibration measure FILE.csv --seed S --count N\n");
  return 3;
}
