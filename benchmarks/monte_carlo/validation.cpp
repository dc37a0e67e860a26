// The path tracer against tables that were computed without it: for each, the rms and the worst of
// (value - truth) / standard error, and the mean relative standard error.
//
//   bench_validation [paths a value, default 20000]
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "monte_carlo/media.h"
#include "sky/monte_carlo/reference.h"
#include "support/atmosphere_truth.h"

namespace {

using namespace skylapse;
using namespace skylapse::sky;
using namespace skylapse::sky::monte_carlo;

class Deviations {
 public:
  /// `own`: what the table leaves open.
  void add(double value, double error, double truth, double own) {
    if (truth == 0) return;
    const double z = (value - truth) / std::hypot(error, own);
    squares_ += z * z, worst_ = std::max(worst_, std::abs(z));
    relative_ += error / truth;
    within_three_ += std::abs(z) <= 3;
    ++count_;
  }
  void print(const std::string& name) const {
    fmt::print(
        "{:34} {:5} values  rms {:5.2f}  worst {:5.2f}  within three {:6.2f} %  mean error "
        "{:.3f} %\n",
        name, count_, std::sqrt(squares_ / count_), worst_, 100.0 * within_three_ / count_,
        100 * relative_ / count_);
    std::fflush(stdout);
  }

 private:
  double squares_ = 0, worst_ = 0, relative_ = 0;
  int count_ = 0, within_three_ = 0;
};

constexpr std::array kBands{"680", "550", "440"};

void single_scattering(long paths) {
  Deviations all;
  for (TruthRow& row : read_truth("single_scattering.tsv")) {
    const auto answer = reference_answer(atmosphere::reference_medium(),
                                         {row["height_m"] * metre, row["sun_zenith_deg"] * deg,
                                          row["view_zenith_deg"] * deg, row["azimuth_deg"] * deg},
                                         {.samples = paths, .max_order = 1});
    for (size_t b = 0; b < 3; ++b) {
      const double truth = row[std::string("radiance_") + kBands[b]];
      all.add(answer.order1[b], answer.order1_error[b], truth, 1e-5 * truth);
    }
  }
  all.print("first order, quadrature");
}

void multiple_scattering(long paths) {
  Deviations all, four;
  for (TruthRow& row : read_truth("multiple_scattering.tsv")) {
    const auto answer = reference_answer(atmosphere::reference_medium(),
                                         {1 * metre, row["sun_zenith_deg"] * deg,
                                          row["view_zenith_deg"] * deg, row["azimuth_deg"] * deg},
                                         {.samples = paths});
    const size_t b = row["wavelength_nm"] == 680 ? 0 : row["wavelength_nm"] == 550 ? 1 : 2;
    all.add(answer.radiance[b], answer.standard_error[b], row["all"], row["all_error"]);
    four.add(answer.up_to_order4[b], answer.up_to_order4_error[b], row["up_to_order4"],
             row["up_to_order4_error"]);
  }
  four.print("up to four orders, Monte Carlo");
  all.print("all orders, Monte Carlo");
}

void rayleigh_slab(long paths) {
  Deviations all;
  for (TruthRow& row : read_truth("slab_rayleigh.tsv"))
    for (const auto& [azimuth, name] :
         {std::pair{0.0, "radiance_000"}, {90.0, "radiance_090"}, {180.0, "radiance_180"}}) {
      if (row["mu"] == 1 && azimuth > 0) continue;
      const auto answer = reference_answer(
          slab(row["tau"], 0),
          {0 * metre, std::acos(row["mu0"]) * rad, std::acos(row["mu"]) * rad, azimuth * deg},
          {.samples = paths, .seed = 5});
      all.add(answer.radiance[0], answer.standard_error[0], row[name],
              std::hypot(1e-6, 2e-4 * row[name]));
    }
  all.print("Rayleigh slab, adding-doubling");
}

void cloud_slab(long paths) {
  for (TruthRow& row : read_truth("slab_cloud.tsv")) {
    Deviations flux;
    for (const auto& [mu0, name] :
         {std::pair{1.0, "mu0_1.0"}, {0.5, "mu0_0.5"}, {0.2, "mu0_0.2"}}) {
      const auto found = reference_irradiance(
          cloud(row["tau"]), 0 * metre, std::acos(mu0) * rad,
          {.samples = paths, .seed = 8, .aerosol = AerosolShape::henyey_greenstein});
      flux.add((found.sun[0] + found.sky[0]) / mu0, found.sky_error[0] / mu0, row[name], 5e-5);
    }
    flux.print(fmt::format("cloud of depth {}, adding-doubling", row["tau"]));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const long paths = argc > 1 ? std::atol(argv[1]) : 20000;
  single_scattering(paths);
  multiple_scattering(paths);
  rayleigh_slab(paths);
  cloud_slab(paths);
  return 0;
}
