// Where tables are hard put: thick haze, a white ground, strongly forward scattering aerosol. The
// CPU twin at the settings that the rules choose, against the path tracer, from 1 m to 40 km.
//
//   hard_media [--level standard] [--error 0.01] [--medium NAME] [--truth FILE] [--set
//   KEY=VALUE]...
//
//   hard_media --blind SEED
//
// --truth keeps the path tracer's values in a file (written if it is not there), so that another
// setting is judged in seconds; --set changes one number of the settings (heights=40). --blind
// takes other media, random suns and views, and another seed of the path tracer: the rules of the
// settings were made with the first list in view. Prints one line a medium, altitude and sun.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "sky/bruneton/twin.h"
#include "sky/monte_carlo/reference.h"

namespace {
using namespace skylapse;
using namespace skylapse::sky;
using bruneton::Query;

struct HardMedium {
  std::string name;
  atmosphere::Medium medium;
};

/// Koschmieder 1924: visibility = 3.912 / extinction at 550 nm, the molecules' part included.
HardMedium hazy(double visibility_km) {
  HardMedium hard{fmt::format("visibility {:g} km", visibility_km), atmosphere::reference_medium()};
  const double aerosol = 3.912 / visibility_km - hard.medium.bands[1].rayleigh_scattering_per_km;
  for (atmosphere::SpectralBand& band : hard.medium.bands) {
    const double albedo = band.aerosol_scattering_per_km / band.aerosol_extinction_per_km;
    band.aerosol_extinction_per_km = aerosol;
    band.aerosol_scattering_per_km = albedo * aerosol;
  }
  return hard;
}

/// Ten times the reference's aerosol, so that its shape matters.
HardMedium forward(double g) {
  HardMedium hard{fmt::format("g {:g}, aerosol x 10", g), atmosphere::reference_medium()};
  hard.medium.aerosol_g = g;
  for (atmosphere::SpectralBand& band : hard.medium.bands) {
    band.aerosol_extinction_per_km *= 10;
    band.aerosol_scattering_per_km *= 10;
  }
  return hard;
}

HardMedium bright_ground(double albedo) {
  HardMedium hard{fmt::format("albedo {:g}", albedo), atmosphere::reference_medium()};
  for (atmosphere::SpectralBand& band : hard.medium.bands) band.ground_albedo = albedo;
  return hard;
}

std::vector<HardMedium> hard_media() {
  return {{"reference", atmosphere::reference_medium()},
          hazy(20),
          hazy(9),
          hazy(2),
          bright_ground(1),
          forward(0.9),
          forward(0.95)};
}

std::vector<HardMedium> other_media() {
  return {hazy(14), hazy(5), hazy(3), bright_ground(0.8), forward(0.86), forward(0.92)};
}

constexpr double kHeightsKm[] = {0.001, 2, 10, 40};
constexpr double kSunsDeg[] = {30, 70, 87, 90, 93};
/// Zenith angle and azimuth from the sun: up, across, aureole of the sun at 30 and 70, both
/// horizons, the limb seen from 40 km, down.
constexpr double kViewsDeg[][2] = {{0, 0},    {35, 0},   {60, 90},   {75, 0},
                                   {85, 180}, {88.5, 0}, {89.5, 60}, {93, 20},
                                   {95.5, 0}, {100, 30}, {120, 90},  {150, 150}};

/// The list above; with a seed suns within 3 degrees of it and random views, every third of them
/// within 5 degrees of the horizontal.
std::vector<Query> queries(std::optional<uint64_t> seed) {
  std::vector<Query> all;
  std::mt19937_64 random(seed.value_or(0));
  std::uniform_real_distribution<double> one(-1, 1);
  for (const double height : kHeightsKm)
    for (const double sun : kSunsDeg) {
      const double moved = seed ? sun + 3 * one(random) : sun;
      for (size_t i = 0; i < std::size(kViewsDeg); ++i) {
        double zenith = kViewsDeg[i][0], azimuth = kViewsDeg[i][1];
        if (seed) {
          zenith = i % 3 == 0 ? 90 + 5 * one(random) : (std::acos(one(random)) * rad).in(deg);
          azimuth = 180 * one(random);
        }
        all.push_back({height * km, moved * deg, zenith * deg, std::abs(azimuth) * deg});
      }
    }
  return all;
}

struct Value {
  double radiance = 0, error = 0;
};
/// [query][band]
using Truth = std::vector<std::vector<Value>>;

struct Options {
  bruneton::Level level = bruneton::Level::standard;
  double error = 0.01;
  std::string medium, truth;
  std::optional<uint64_t> blind;
  std::vector<std::pair<std::string, double>> changes;  // of the settings
};

bool change(bruneton::Settings& s, const std::string& key, double value) {
  const std::pair<const char*, int*> numbers[] = {
      {"heights", &s.heights},
      {"suns", &s.suns},
      {"sun_rows_per_interval", &s.sun_rows_per_interval},
      {"directions_up", &s.directions_up},
      {"directions_down", &s.directions_down},
      {"azimuths", &s.azimuths},
      {"harmonics", &s.harmonics},
      {"table_azimuths", &s.table_azimuths},
      {"table_zeniths", &s.table_zeniths},
      {"samples", &s.samples},
      {"first_order_samples", &s.first_order_samples},
      {"max_orders", &s.max_orders}};
  for (const auto& [name, number] : numbers)
    if (key == name) return *number = int(value), true;
  if (key == "stop_below") return s.stop_below = value, true;
  return false;
}

Truth trace(const atmosphere::Medium& medium, const Options& options) {
  Truth truth;
  for (const Query& query : queries(options.blind)) {
    const monte_carlo::ReferenceAnswer answer = monte_carlo::reference_answer(
        medium, query,
        {.samples = 400000, .relative_error = options.error, .seed = options.blind.value_or(17)});
    std::vector<Value> values;
    for (size_t b = 0; b < medium.bands.size(); ++b)
      values.push_back({answer.radiance[b], answer.standard_error[b]});
    truth.push_back(values);
  }
  return truth;
}

Truth truth_of(const HardMedium& hard, const Options& options) {
  if (options.truth.empty()) return trace(hard.medium, options);
  std::string name = options.truth + "." + hard.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  const size_t bands = hard.medium.bands.size();
  Truth truth(queries(options.blind).size(), std::vector<Value>(bands));
  if (std::ifstream file(name); file) {
    for (auto& values : truth)
      for (Value& value : values) file >> value.radiance >> value.error;
    if (file) return truth;
  }
  truth = trace(hard.medium, options);
  std::ofstream file(name);
  for (const auto& values : truth)
    for (const Value& value : values)
      file << fmt::format("{:.17g} {:.17g}\n", value.radiance, value.error);
  return truth;
}

/// Errors of many values.
struct Errors {
  double squares = 0, noise = 0, sigmas = 0, worst = 0;
  int count = 0;
  std::string worst_at;

  void add(double value, const Value& truth, const Query& query, double wavelength) {
    const double relative = value / truth.radiance - 1;
    squares += relative * relative;
    noise += std::pow(truth.error / truth.radiance, 2);
    sigmas += std::pow((value - truth.radiance) / truth.error, 2);
    ++count;
    if (std::abs(relative) <= std::abs(worst)) return;
    worst = relative;
    worst_at =
        fmt::format("{:g} km, sun {:g}, view {:g}/{:g}, {:g} nm, {:.1f} se", query.height.in(km),
                    query.sun_zenith.in(deg), query.view_zenith.in(deg), query.azimuth.in(deg),
                    wavelength, (value - truth.radiance) / truth.error);
  }
  void print(const std::string& name) const {
    if (count == 0) return;
    // What the truth's own noise leaves of the error; the two are independent.
    const double own = std::sqrt(std::max(0.0, squares - noise) / count);
    fmt::print("{:<22} {:5d} {:7.2f} {:7.2f} {:7.2f} {:7.2f} {:+8.1f}  {}\n", name, count,
               100 * std::sqrt(squares / count), 100 * std::sqrt(noise / count), 100 * own,
               std::sqrt(sigmas / count), 100 * worst, worst_at);
  }
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void judge(const HardMedium& hard, const Options& options) {
  bruneton::Settings settings = bruneton::settings_for(options.level, hard.medium);
  for (const auto& [key, value] : options.changes) change(settings, key, value);
  auto start = std::chrono::steady_clock::now();
  const auto tables =
      std::make_shared<const bruneton::Tables>(bruneton::precompute_twin(hard.medium, settings));
  const double table_time = seconds_since(start);
  start = std::chrono::steady_clock::now();
  const Truth truth = truth_of(hard, options);
  const double truth_time = seconds_since(start);
  const bruneton::Twin twin(tables);
  const std::vector<Query> all = queries(options.blind);
  std::vector<bruneton::Answer> answers(all.size());
  parallel_for_ranges(all.size(), 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) answers[i] = twin.answer(all[i]);
  });

  Errors total;
  std::vector<Errors> by_height(std::size(kHeightsKm)), by_sun(std::size(kSunsDeg));
  const size_t suns = std::size(kSunsDeg), views = std::size(kViewsDeg);
  for (size_t first = 0; first < all.size(); first += views) {
    // Values above 0.1 % of the brightest of their sun and altitude count.
    for (size_t b = 0; b < hard.medium.bands.size(); ++b) {
      double brightest = 0;
      for (size_t i = first; i < first + views; ++i)
        brightest = std::max(brightest, truth[i][b].radiance);
      for (size_t i = first; i < first + views; ++i) {
        if (truth[i][b].radiance < 1e-3 * brightest || truth[i][b].radiance == 0) continue;
        for (Errors* errors : {&total, &by_height[i / (views * suns)], &by_sun[i / views % suns]})
          errors->add(answers[i].radiance[b], truth[i][b], all[i],
                      hard.medium.bands[b].wavelength_nm);
      }
    }
  }
  fmt::print(
      "\n{}: {} heights, l {}, {} azimuths, {} + {} directions, {} samples; {} orders, "
      "tail ratio {:.2f}; tables {:.1f} s, {:.0f} MB; truth {:.0f} s\n",
      hard.name, settings.heights, settings.harmonics, settings.azimuths, settings.directions_up,
      settings.directions_down, settings.samples, tables->orders,
      *std::max_element(tables->tail_ratio.begin(), tables->tail_ratio.end()), table_time,
      double(tables->bytes()) / 1e6, truth_time);
  total.print(hard.name);
  for (size_t i = 0; i < by_height.size(); ++i)
    by_height[i].print(fmt::format("  at {:g} km", kHeightsKm[i]));
  for (size_t i = 0; i < by_sun.size(); ++i)
    by_sun[i].print(fmt::format("  sun {:g}", kSunsDeg[i]));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string key = argv[i], value = argv[i + 1];
    const auto& names = bruneton::level_names();
    if (key == "--level" && std::find(names.begin(), names.end(), value) != names.end())
      options.level = bruneton::Level(std::find(names.begin(), names.end(), value) - names.begin());
    else if (key == "--error")
      options.error = std::stod(value);
    else if (key == "--medium")
      options.medium = value;
    else if (key == "--truth")
      options.truth = value;
    else if (key == "--blind")
      options.blind = std::stoull(value);
    else if (bruneton::Settings trial; key == "--set" && value.find('=') != std::string::npos &&
                                       change(trial, value.substr(0, value.find('=')), 1))
      options.changes.emplace_back(value.substr(0, value.find('=')),
                                   std::stod(value.substr(value.find('=') + 1)));
    else
      return fmt::print(stderr, "unknown option {} {}\n", key, value), 2;
  }
  fmt::print("level {}, truth to {:g} % standard error\n", bruneton::name_of(options.level),
             100 * options.error);
  fmt::print("{:<22} {:>5} {:>7} {:>7} {:>7} {:>7} {:>8}\n", "", "count", "rms %", "noise %",
             "own %", "in se", "worst %");
  for (const HardMedium& hard : options.blind ? other_media() : hard_media())
    if (options.medium.empty() || hard.name.find(options.medium) != std::string::npos)
      judge(hard, options);
  return 0;
}
