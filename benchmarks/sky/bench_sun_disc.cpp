// Time of drawing the sun's disc and what is left of its energy, by projection and image width.
//   bench_sun_disc [positions]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <random>
#include <vector>

#include "sky/hosek_wilkie/solar_disc.h"
#include "sky/sun_disc.h"

namespace {

using namespace skylapse;
using image::Camera;
using image::CubeLayout;
using image::look_at;

struct Case {
  const char* name;
  Camera camera;
};

std::vector<Case> cases(int w, Angle azimuth, Angle elevation) {
  using enum image::Projection;
  const glm::dmat3 north = look_at({}, {}, {}), zenith = look_at(180 * deg, 90 * deg, {});
  const glm::dmat3 beside = look_at(azimuth + 4 * deg, elevation + 2 * deg, {});
  const auto strip = CubeLayout::vertical_strip;
  return {{"lat-long", {lat_long, w, w / 2, {}, strip, north}},
          {"cube", {cube, w / 4, w / 4 * 6, {}, strip, north}},
          {"perspective 75", {perspective, w, w * 9 / 16, 75 * deg, strip, beside}},
          {"perspective 30", {perspective, w, w * 9 / 16, 30 * deg, strip, beside}},
          {"equidistant", {fisheye_equidistant, w, w, 180 * deg, strip, zenith}},
          {"equisolid", {fisheye_equisolid, w, w, 180 * deg, strip, zenith}},
          {"stereographic", {fisheye_stereographic, w, w, 180 * deg, strip, zenith}}};
}

double relative(const glm::dvec3& value, const glm::dvec3& expected) {
  const glm::dvec3 e = glm::abs(value / expected - 1.0);
  return std::max({e.x, e.y, e.z});
}

struct Row {
  double flux_error = 0, ground_error = 0;
  size_t pixels = 0;
  std::vector<double> milliseconds;
};

void measure(const Camera& camera, const sky::SunDisc& sun, Row& row) {
  const auto start = std::chrono::steady_clock::now();
  const auto disc = project_sun_disc(camera, sun);
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  const auto reference = disc_energy(sun);
  row.milliseconds.push_back(time.count());
  row.pixels = std::max(row.pixels, disc.pixels.size());
  row.flux_error = std::max(row.flux_error,
                            relative(disc.energy.normal_irradiance, reference.normal_irradiance));
  row.ground_error = std::max(row.ground_error, relative(disc.energy.horizontal_irradiance,
                                                         reference.horizontal_irradiance));
}

}  // namespace

int main(int argc, char** argv) {
  const int positions = argc > 1 ? std::max(1, std::atoi(argv[1])) : 15;
  const auto model =
      sky::hosek_wilkie::SolarDisc::make(3, sky::hosek_wilkie::SolarFlux::reference, 0.2666 * deg)
          .value();
  fmt::print("Worst of {} positions; time is the median.\n", positions);
  fmt::print("{:>6} {:>9}  {:<15} {:>10} {:>10} {:>8} {:>8}\n", "width", "elevation", "projection",
             "flux", "ground", "pixels", "ms");
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> uniform;
  for (const int width : {64, 256, 1024, 8192, 16384})
    for (const double el : {0.0, 0.1, 0.27, 2.0, 12.0, 30.0, 89.9}) {
      std::vector<Row> rows(cases(width, {}, {}).size());
      for (int k = 0; k < positions; ++k) {
        const Angle azimuth = 360 * uniform(rng) * deg;
        const sky::SunDisc sun{
            enu_direction(azimuth, el * deg), model.radius(),
            [&](Angle view, double limb) { return model.radiance_xyz(view, limb); }};
        const auto all = cases(width, azimuth, el * deg);
        for (size_t c = 0; c < all.size(); ++c) measure(all[c].camera, sun, rows[c]);
      }
      for (size_t c = 0; c < rows.size(); ++c) {
        auto& ms = rows[c].milliseconds;
        std::nth_element(ms.begin(), ms.begin() + ms.size() / 2, ms.end());
        fmt::print("{:>6} {:>9.2f}  {:<15} {:>10.1e} {:>10.1e} {:>8} {:>8.3f}\n", width, el,
                   cases(width, {}, {})[c].name, rows[c].flux_error, rows[c].ground_error,
                   rows[c].pixels, ms[ms.size() / 2]);
      }
    }
}
