// Errors of the levels, and random draws.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <ctime>
#include <random>

#include "bruneton/energy_balance.h"
#include "core/parallel.h"
#include "sky/bruneton/physics.h"
#include "studies.h"
#include "support/atmosphere_truth.h"

namespace skylapse::sky::bruneton {
namespace {

Query query_of(TruthRow row) {
  return {row["height_m"] * metre, row["sun_zenith_deg"] * deg, row["view_zenith_deg"] * deg,
          row["azimuth_deg"] * deg};
}

double quantile(std::vector<double>& sorted, double share) {
  return sorted[std::min(sorted.size() - 1, size_t(share * double(sorted.size())))];
}

void single_scattering() {
  auto empty = std::make_shared<Tables>();
  empty->medium = atmosphere::reference_medium();
  const Twin twin(empty);
  std::map<std::pair<double, double>, std::vector<std::pair<double, double>>> groups;
  for (TruthRow row : read_truth("single_scattering.tsv")) {
    const Answer answer = twin.answer(query_of(row));
    const double truth[3] = {row["radiance_680"], row["radiance_550"], row["radiance_440"]};
    for (int b = 0; b < 3; ++b)
      groups[{row["height_m"], row["sun_zenith_deg"]}].push_back({answer.radiance[b], truth[b]});
  }
  fmt::print("single scattering against quadrature, values above 0.1 % of the brightest [%]\n");
  for (const auto& [group, pairs] : groups) {
    double brightest = 0;
    for (const auto& [value, truth] : pairs) brightest = std::max(brightest, truth);
    std::vector<double> errors;
    for (const auto& [value, truth] : pairs)
      if (truth > 1e-3 * brightest) errors.push_back(100 * std::abs(value / truth - 1));
    std::sort(errors.begin(), errors.end());
    fmt::print("  {:6g} m sun {:3g}: median {:.3f}  p95 {:.3f}  max {:.3f}\n", group.first,
               group.second, quantile(errors, 0.5), quantile(errors, 0.95), errors.back());
  }
}

void against_monte_carlo(const Twin& twin) {
  double squares = 0, sigmas = 0, worst = 0;
  int count = 0, beyond = 0;
  for (TruthRow row : read_truth("multiple_scattering.tsv")) {
    row["height_m"] = 1;
    const int band = row["wavelength_nm"] == 680 ? 0 : row["wavelength_nm"] == 550 ? 1 : 2;
    const double error = twin.answer(query_of(row)).radiance[band] - row["all"];
    squares += std::pow(error / row["all"], 2);
    sigmas += std::pow(error / row["all_error"], 2);
    worst = std::max(worst, std::abs(error / row["all"]));
    beyond += std::abs(error) > 0.03 * row["all"] && std::abs(error) > 4 * row["all_error"];
    ++count;
  }
  fmt::print("Monte Carlo: rms {:.3f} % = {:.2f} se, worst {:.2f} %, beyond 3 % and 4 se: {}; ",
             100 * std::sqrt(squares / count), std::sqrt(sigmas / count), 100 * worst, beyond);
}

struct Case {
  Query query;
  double value;
};

std::map<double, std::vector<Case>> converged_cases(const Twin& twin) {
  std::map<double, std::vector<Case>> cases;
  for (const double sun : {30.0, 90.0, 93.0, 96.0, 100.0})
    for (const double height : {0.001, 2.0, 10.0, 40.0})
      for (const double view : {0.0, 30.0, 60.0, 80.0, 89.0, 95.0, 120.0})
        for (const double azimuth : {0.0, 45.0, 100.0, 180.0}) {
          const Query query{height * km, sun * deg, view * deg, azimuth * deg};
          cases[sun].push_back({query, twin.answer(query).radiance[1]});
        }
  return cases;
}

void against_converged(const Twin& twin, const std::map<double, std::vector<Case>>& cases) {
  for (const auto& [sun, group] : cases) {
    double brightest = 0;
    for (const Case& one : group) brightest = std::max(brightest, one.value);
    std::vector<double> errors;
    for (const Case& one : group)
      if (one.value > 1e-3 * brightest)
        errors.push_back(100 * std::abs(twin.answer(one.query).radiance[1] / one.value - 1));
    std::sort(errors.begin(), errors.end());
    fmt::print("sun {:g} {:.2f}/{:.2f}/{:.2f}; ", sun, quantile(errors, 0.5),
               quantile(errors, 0.95), errors.back());
  }
}

Settings converged() {
  Settings s = settings_for(Level::fine, atmosphere::reference_medium());
  s.heights = 36, s.suns = 60, s.sun_rows_per_interval = 8;
  s.directions_up = 28, s.directions_down = 12, s.azimuths = 20, s.harmonics = 20;
  s.table_azimuths = 24, s.table_zeniths = 48;
  s.samples = 12, s.first_order_samples = 32, s.stop_below = 0.003;
  return s;
}

}  // namespace

void study_accuracy() {
  single_scattering();
  const atmosphere::Medium medium = atmosphere::reference_medium();
  const auto cases = converged_cases(twin_of(medium, converged()));
  fmt::print(
      "levels; errors against converged tables at 550 nm, 1 m to 40 km: median/p95/max [%]\n");
  for (const Level level : {Level::draft, Level::low, Level::standard, Level::fine}) {
    const std::clock_t start = std::clock();
    const auto tables =
        std::make_shared<const Tables>(precompute_twin(medium, settings_for(level, medium)));
    const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    const Twin twin(tables);
    fmt::print("{:8}: {:.2f} CPU-s, {:.1f} MB, {} orders; ", name_of(level), seconds,
               double(tables->bytes()) / 1e6, tables->orders);
    against_monte_carlo(twin);
    against_converged(twin, cases);
    fmt::print("\n");
    std::fflush(stdout);
  }
}

void study_energy(Level level) {
  const atmosphere::Medium medium = atmosphere::reference_medium();
  const auto tables =
      std::make_shared<const Tables>(precompute_twin(medium, settings_for(level, medium)));
  const Twin twin(tables);
  fmt::print("irradiance of the tables over the integral of the radiance - 1 [%], three bands\n");
  for (const double sun : {0.0, 30.0, 60.0, 80.0, 85.0, 90.0, 94.0, 97.0}) {
    const Twin::Irradiance integral = twin.irradiance(0 * km, sun * deg);
    fmt::print("  sun {:2g}:", sun);
    for (int b = 0; b < 3; ++b)
      fmt::print(" {:+.2f}", 100 * (table_irradiance(*tables, sun * deg, b) / integral.sky[b] - 1));
    fmt::print("\n");
  }
  for (const double factor : {1.0, 50.0}) {
    atmosphere::Medium white = conservative_medium(1);
    white.bands[0].aerosol_extinction_per_km *= factor;
    white.bands[0].aerosol_scattering_per_km *= factor;
    fmt::print(
        "conservative air over a white ground, aerosol x {:g}: {:.4f} of the light returns\n",
        factor, returned_share(white, level));
  }
}

void study_draws(long long count) {
  const atmosphere::Medium medium = atmosphere::reference_medium();
  const Twin twin = twin_of(medium, settings_for(Level::draft, medium));
  std::atomic<long long> bad{0};
  constexpr long long kBatch = 10000;
  parallel_for_ranges(size_t((count + kBatch - 1) / kBatch), 1, [&](size_t begin, size_t end) {
    for (size_t batch = begin; batch < end; ++batch) {
      std::mt19937_64 random(batch);
      std::uniform_real_distribution<double> share(0, 1);
      for (long long i = 0; i < kBatch; ++i) {
        const double height_km = share(random) < 0.8 ? 60 * std::pow(share(random), 3)
                                                     : 60 * std::pow(1000.0, share(random));
        const Query query{height_km * km, std::acos(1 - 2 * share(random)) * rad,
                          std::acos(1 - 2 * share(random)) * rad, share(random) * text::PI * rad};
        MarchSettings march;
        march.ground = true;
        const Answer answer = twin.answer(query, march);
        for (int b = 0; b < 3; ++b)
          if (!(answer.radiance[b] >= 0) || !std::isfinite(answer.radiance[b]) ||
              !(answer.transmittance[b] >= 0 && answer.transmittance[b] <= 1))
            ++bad;
      }
    }
  });
  fmt::print("{} draws: {} with NaN, infinite or negative light or a transmittance above 1\n",
             count, bad.load());
}

}  // namespace skylapse::sky::bruneton
