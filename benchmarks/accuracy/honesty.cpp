// Are the planner's promises kept? Random scenes and promises against the path tracer.
//
//   accuracy_honesty run FILE.csv --seed S --count N [--time-best-every K]
//   accuracy_honesty sum FILE.csv
//
// `run` appends one line a scene and passes over those that the file has. `sum` prints what the
// lines come to. Every Kth scene is also rendered by the best rung, for its time.
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "study/honesty.h"

namespace {

using namespace skylapse;
using namespace skylapse::study;

constexpr std::string_view kHeader =
    "seed,index,sun_elevation_deg,height_km,aerosol_optical_depth,ground_albedo,promise,taken,"
    "bound,"
    "measured,uncertainty,predicted_s,measured_s,best_predicted_s,best_measured_s,refused";

std::string quoted(const std::string& text) {
  return text.find(',') == std::string::npos ? text : '"' + text + '"';
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  bool in_quotes = false;
  for (const char c : line) {
    if (c == '"')
      in_quotes = !in_quotes;
    else if (c == ',' && !in_quotes)
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

std::vector<std::vector<std::string>> rows_of(const std::string& path) {
  std::ifstream in(path);
  std::vector<std::vector<std::string>> rows;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) rows.push_back(fields_of(line));
  return rows;
}

int run(const std::string& path, uint64_t seed, int count, int best_every) {
  std::set<std::pair<std::string, std::string>> known;
  for (const auto& row : rows_of(path)) known.emplace(row[0], row[1]);
  std::ofstream out(path, std::ios::app);
  if (known.empty()) out << kHeader << std::endl;
  for (int index = 0; index < count; ++index) {
    if (known.contains({fmt::format("{}", seed), fmt::format("{}", index)})) continue;
    const HonestyJob job = draw_honesty_job(seed, index);
    HonestyOptions options;
    options.time_best = best_every > 0 && index % best_every == 0;
    const auto r = measure_honesty(job, seed * 10'007 + uint64_t(index), options);
    if (!r) return fmt::print(stderr, "{}\n{}\n", job.config, r.error().message), 7;
    out << fmt::format(
               "{},{},{:.2f},{:.3f},{:.4f},{:.3f},{:.4f},{},{:.4f},{:.4f},{:.4f},{:.3f},{:.3f},"
               "{:.3f},{},{}",
               seed, index, job.scene.sun_elevation.in(deg), job.scene.height.in(km),
               job.scene.air.aerosol_optical_depth, job.scene.ground_albedo, job.accuracy,
               quoted(r->taken), r->bound, r->measured, r->uncertainty, r->predicted_s,
               r->measured_s, r->best_predicted_s,
               r->best_measured_s ? fmt::format("{:.3f}", *r->best_measured_s) : "",
               quoted(r->refused))
        << std::endl;
  }
  return out ? 0 : 6;
}

int sum(const std::string& path) {
  int promised = 0, kept = 0, clearly_broken = 0, refused = 0, timed = 0;
  double predicted = 0, best_predicted = 0, taken_s = 0, best_s = 0;
  for (const auto& row : rows_of(path)) {
    if (!row[15].empty()) {
      ++refused;
      continue;
    }
    const double promise = std::stod(row[6]), error = std::stod(row[9]);
    ++promised;
    kept += error <= promise;
    clearly_broken += error - 2 * std::stod(row[10]) > promise;
    predicted += std::stod(row[11]), best_predicted += std::stod(row[13]);
    if (row[14].empty()) continue;
    ++timed;
    taken_s += std::stod(row[12]), best_s += std::stod(row[14]);
  }
  fmt::print(
      "{} promises, {} kept ({:.1f} %), {} broken by more than two standard errors; {} "
      "refused\n",
      promised, kept, 100.0 * kept / promised, clearly_broken, refused);
  fmt::print("predicted cost: {:.1f} % of always taking the best rung\n",
             100 * predicted / best_predicted);
  if (timed > 0)
    fmt::print("measured in {} scenes: {:.1f} % of the core seconds of the best rung\n", timed,
               100 * taken_s / best_s);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  uint64_t seed = 2;
  int count = 60, best_every = 0;
  for (int i = 3; i + 1 < argc; i += 2) {
    const std::string name = argv[i];
    if (name == "--seed") seed = std::strtoull(argv[i + 1], nullptr, 10);
    if (name == "--count") count = std::atoi(argv[i + 1]);
    if (name == "--time-best-every") best_every = std::atoi(argv[i + 1]);
  }
  if (argc > 2 && std::string(argv[1]) == "run") return run(argv[2], seed, count, best_every);
  if (argc > 2 && std::string(argv[1]) == "sum") return sum(argv[2]);
  fmt::print(stderr, "accuracy_honesty run|sum FILE.csv\n");
  return 3;
}
