// Compiled with -O3 -fno-math-errno -fno-trapping-math, as sky_kernel.cpp and for its reasons.
#include "sky/monte_carlo/kernels.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include "core/vector_kernel.h"
#include "sky/quadrature.h"

namespace skylapse::sky::monte_carlo {
namespace {

/// exp(x), relative error 1e-11, x below -700 as -700: a power of two times a Taylor polynomial on
/// |r| <= ln(2) / 2. Free of branches, so that the loops around it become vectors.
SKYLAPSE_INLINE double exp_of(double x) {
  constexpr double kShift = 0x1.8p52;  // adding it leaves the integer in the low bits
  x = x < -700 ? -700 : x;
  x = x > 700 ? 700 : x;
  const double shifted = x * std::numbers::log2e + kShift;
  const double n = shifted - kShift;
  const double r = x - n * std::numbers::ln2;
  double p = 1.0 / 362880;
  p = p * r + 1.0 / 40320;
  p = p * r + 1.0 / 5040;
  p = p * r + 1.0 / 720;
  p = p * r + 1.0 / 120;
  p = p * r + 1.0 / 24;
  p = p * r + 1.0 / 6;
  p = p * r + 0.5;
  p = p * r + 1;
  p = p * r + 1;
  const uint64_t exponent = (std::bit_cast<uint64_t>(shifted) + 1023) << 52;
  return p * std::bit_cast<double>(exponent);
}

constexpr int kNodes = 8;

/// Nodes and weights apart, as vectors want them.
struct Nodes {
  double x[kNodes], weight[kNodes];
};
const Nodes kGauss = [] {
  Nodes nodes{};
  const auto points = gauss_legendre<kNodes>();
  for (int i = 0; i < kNodes; ++i) nodes.x[i] = points[i].x, nodes.weight[i] = points[i].weight;
  return nodes;
}();

}  // namespace

SKYLAPSE_CLONES Columns shell_columns(const Shell& shell, const RayParabola& ray, double t0,
                                      double t1) {
  double height[kNodes];
  const double length = t1 - t0, square = ray.radius * ray.radius;
  for (int i = 0; i < kNodes; ++i) {
    const double t = t0 + length * kGauss.x[i];
    const double q = ray.at_start + t * (ray.linear + t);
    height[i] = q / (ray.radius + std::sqrt(square + q));
  }
  double sums[3] = {0, 0, 0};
  for (const ShellTerm& term : shell.terms) {
    double parts[kNodes];
    if (term.amplitude != 0) {
      for (int i = 0; i < kNodes; ++i)
        parts[i] =
            kGauss.weight[i] * (term.amplitude * exp_of(-height[i] * term.inverse_scale_height) +
                                (term.slope * height[i] + term.constant));
    } else {
      for (int i = 0; i < kNodes; ++i)
        parts[i] = kGauss.weight[i] * (term.slope * height[i] + term.constant);
    }
    double sum = 0;
    for (int i = 0; i < kNodes; ++i) sum += parts[i];
    sums[term.component] += sum > 0 ? sum : 0;
  }
  return {sums[0] * length, sums[1] * length, sums[2] * length};
}

namespace kernel {

SKYLAPSE_CLONES void transmittances(int count, const double* a, const double* b, const double* c,
                                    const Columns& columns, double* out) {
  const double x = columns.rayleigh, y = columns.aerosol, z = columns.ozone;
  for (int i = 0; i < count; i += kLanes)
    for (int k = i; k < i + kLanes; ++k) out[k] = exp_of(-(a[k] * x + b[k] * y + c[k] * z));
}

}  // namespace kernel
}  // namespace skylapse::sky::monte_carlo
