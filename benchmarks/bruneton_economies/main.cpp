// What the economies of the computed atmosphere save, and what they cost in accuracy.
//   bench_economies [slices|irradiance|tables|half|orders|steps|components|all] [BANDS]
// CPU times are of all threads: on a busy machine they are what can be compared.
#include "economies.h"

#include <utility>

namespace skylapse::economies {

Distance distance(const SkySlice& slice, const SkySlice& truth) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  const SliceGrid& grid = truth.grid;
  const double low = std::cos(grid.horizon_zenith_rad - grid.sky_span_rad);
  std::vector<double> a, b;
  for (int i = 0; i < 4000; ++i) {
    const Angle zenith = std::acos(low - share(random) * (low + 1)) * rad;
    const Angle azimuth = 180 * share(random) * deg;
    a.push_back(slice.radiance_xyz(zenith, azimuth).y);
    b.push_back(truth.radiance_xyz(zenith, azimuth).y);
  }
  const double least = 1e-3 * *std::max_element(b.begin(), b.end());
  Distance result;
  size_t count = 0;
  for (size_t i = 0; i < b.size(); ++i) {
    if (!(b[i] > least)) continue;
    const double error = std::abs(a[i] / b[i] - 1);
    result.rms += error * error;
    result.worst = std::max(result.worst, error);
    ++count;
  }
  result.rms = std::sqrt(result.rms / double(std::max<size_t>(count, 1)));
  return result;
}

}  // namespace skylapse::economies

int main(int argc, char** argv) {
  using namespace skylapse;
  using namespace skylapse::economies;
  const std::string what = argc > 1 ? argv[1] : "all";
  const int bands = argc > 2 ? std::clamp(std::atoi(argv[2]), 3, 32) : 16;
  const Context context = value_or_exit(gpu::Context::create(gpu::Backend::automatic));
  const gpu::ContextInfo& info = context->info();
  fmt::print("{}: {}, OpenGL {}\n", info.backend, info.renderer, info.version);
  const std::pair<const char*, void (*)(const Context&, int)> parts[] = {
      {"slices", windows},       {"irradiance", irradiance}, {"tables", partial_tables},
      {"half", half_floats},     {"orders", orders},         {"steps", steps},
      {"components", components}};
  bool known = false;
  for (const auto& [name, part] : parts) {
    if (what != name && what != "all") continue;
    known = true;
    fmt::print("\n{}\n", name);
    part(context, bands);
  }
  return known ? 0 : 2;
}
