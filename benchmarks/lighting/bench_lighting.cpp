// Time and error of what is made from a whole sky: filtered cubes, irradiance maps, harmonics.
//   bench_lighting        a table of milliseconds, and of errors against finer sums
#include <chrono>
#include <cstdio>
#include <numbers>

#include "image/irradiance.h"
#include "image/lighting/harmonics.h"
#include "image/lighting/irradiance_map.h"
#include "image/lighting/skies.h"
#include "image/lighting/sources.h"
#include "image/lighting/specular.h"

using namespace skylapse;
using namespace skylapse::image;

namespace {

template <class Work>
double milliseconds(const Work& work) {
  double best = 1e9;
  for (int i = 0; i < 3; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> t = std::chrono::steady_clock::now() - start;
    best = std::min(best, t.count());
  }
  return best;
}

/// A sun of 146 (100 klux in the maps' unit) and of its real size.
std::vector<PointLight> sun_at(const Direction<Enu>& centre) {
  std::vector<PointLight> lights;
  const int n = 768;
  const glm::dvec3 a = glm::normalize(glm::cross(centre.vec(), glm::dvec3{0.3, 0.4, 0.5}));
  const glm::dvec3 b = glm::cross(centre.vec(), a);
  for (int i = 0; i < n; ++i) {
    const double r = std::sqrt((i + 0.5) / n) * 0.00465, t = 2.39996322972865 * i;
    lights.push_back(
        {Direction<Enu>::from_vector(centre.vec() + r * std::cos(t) * a + r * std::sin(t) * b),
         glm::dvec3{146.0 / n}});
  }
  return lights;
}

void time_specular(int side) {
  const Camera camera = strip_heading({}, side);
  const FrameBuffer sky = cube_of(camera, clear_sky);
  const auto sun = sun_at(enu_direction(50 * deg, 40 * deg));
  const int levels = level_count(side, 4);
  const double narrowest = alpha_of_roughness(roughness_of_level(1, levels));
  double filter = 0, disc = 0;
  const double source = milliseconds([&] { const SpecularSource made(camera, sky, narrowest); });
  const SpecularSource made(camera, sky, narrowest);
  for (int level = 1; level < levels; ++level) {
    const double alpha = alpha_of_roughness(roughness_of_level(level, levels));
    FrameBuffer cube;
    filter += milliseconds([&] { cube = made.filtered(level_side(side, level), alpha); });
    disc += milliseconds([&] { add_filtered_lights(camera, sun, alpha, cube); });
  }
  std::printf(
      "specular cube of %4d, %2d levels: pyramid %6.1f ms, filter %7.1f ms, disc %6.1f ms\n", side,
      levels, source, filter, disc);
}

void time_irradiance(int side) {
  const Camera camera = strip_heading({}, 128), out = strip_heading({}, side);
  const FrameBuffer sky = cube_of(camera, clear_sky);
  const auto sun = sun_at(enu_direction(50 * deg, 40 * deg));
  std::printf("irradiance cube of %4d: %7.1f ms\n", side,
              milliseconds([&] { irradiance_map(out, camera, sky, sun); }));
}

/// What a map of a low sun says of level ground: the mean of the texels about the zenith.
void zenith_of_low_suns() {
  std::printf(
      "\nerror of the zenith of an irradiance map, sun alone, by its elevation\n"
      "%16s",
      "side of a cube");
  const double elevations[] = {0, 0.5, 1, 2, 4, 8, 16};
  for (const double e : elevations) std::printf("%9.1f deg", e);
  std::printf("\n");
  const Camera camera = strip_heading({}, 16);
  const FrameBuffer dark(16, 96);
  for (const int side : {16, 32, 64, 128}) {
    std::printf("%16d", side);
    const Camera out = strip_heading({}, side);
    for (const double e : elevations) {
      // The part of the disc above the horizon.
      auto sun = sun_at(enu_direction(66 * deg, e * deg));
      std::erase_if(sun, [](const PointLight& p) { return p.direction.z() <= 0; });
      const FrameBuffer map = irradiance_map(out, camera, dark, sun);
      double truth = 0, sum = 0;
      for (const PointLight& p : sun) truth += p.irradiance.x * p.direction.z();
      for (const int y : {side / 2 - 1, side / 2})
        for (const int x : {side / 2 - 1, side / 2}) sum += map.pixel(x, 2 * side + y)[0] / 4;
      std::printf("%+12.3f%%", 100 * (sum / truth - 1));
    }
    std::printf("\n");
  }
}

void time_harmonics() {
  const Camera camera = strip_heading({}, 128);
  const FrameBuffer sky = cube_of(camera, clear_sky);
  Harmonics h{};
  const double ms = milliseconds([&] { h = project_picture(camera, sky, glm::dmat3{1.0}); });
  const double truth = image_irradiance(camera, sky).y;
  std::printf("harmonics of a cube of 128: %.1f ms; level ground by nine terms %+.2f %%\n", ms,
              100 * (irradiance_of(h, {0, 0, 1}).y / truth - 1));
}

}  // namespace

int main() {
  for (const int side : {128, 256, 512}) time_specular(side);
  for (const int side : {16, 32, 64}) time_irradiance(side);
  time_harmonics();
  zenith_of_low_suns();
}
