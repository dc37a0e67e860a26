#include "sky/fitted_sky.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/parallel.h"
#include "sky/atmosphere/atmosphere.h"
#include "sky/atmosphere_disc.h"

namespace skylapse::sky {

glm::dvec3 dome_irradiance(const DomeRadiance& dome) {
  constexpr int kZeniths = 180, kAzimuths = 200;
  std::vector<glm::dvec3> rows(kZeniths);
  parallel_for_ranges(kZeniths, 20, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const Angle zenith = (double(i) + 0.5) / kZeniths * 90 * deg;
      glm::dvec3 sum{0};
      for (int j = 0; j < kAzimuths; ++j)
        sum += dome(enu_direction((j + 0.5) / kAzimuths * 360 * deg, 90 * deg - zenith));
      rows[i] = sum * (sin(zenith) * cos(zenith));
    }
  });
  glm::dvec3 sum{0};
  for (const glm::dvec3& row : rows) sum += row;
  return sum * (std::numbers::pi / 2 / kZeniths) * (2 * std::numbers::pi / kAzimuths);
}

glm::dvec3 ground_radiance(const FittedSky& sky, const glm::dvec3& dome_irradiance, double albedo) {
  return albedo / std::numbers::pi *
         (dome_irradiance + disc_energy(sky.disc).horizontal_irradiance);
}

void render_dome(const image::Camera& camera, const DomeRadiance& dome,
                 const glm::dmat3& xyz_to_rgb, const glm::dvec3& ground_rgb,
                 image::FrameBuffer& out) {
  assert(out.height() == camera.height);
  render_dome_rows(camera, dome, xyz_to_rgb, ground_rgb, 0, out);
}

void render_dome_rows(const image::Camera& camera, const DomeRadiance& dome,
                      const glm::dmat3& xyz_to_rgb, const glm::dvec3& ground_rgb, int first_row,
                      image::FrameBuffer& out) {
  assert(out.width() == camera.width);
  assert(first_row >= 0 && first_row + out.height() <= camera.height);
  const size_t grain = size_t(std::max(1, 2048 / camera.width));
  parallel_for_ranges(size_t(out.height()), grain, [&](size_t begin, size_t end) {
    for (int row = int(begin); row < int(end); ++row)
      for (int x = 0; x < camera.width; ++x) {
        const int y = first_row + row;
        const auto centre = image::direction_at(camera, {x + 0.5, y + 0.5});
        if (!centre) continue;
        const double share =
            image::horizon_coverage(elevation(*centre), image::pixel_solid_angle(camera, x, y));
        glm::dvec3 rgb = (1 - share) * glm::max(ground_rgb, 0.0);
        if (share > 0) rgb += share * glm::max(xyz_to_rgb * dome(*centre), 0.0);
        for (int c = 0; c < 3; ++c) out.pixel(x, row)[c] = float(rgb[c]);
      }
  });
}

SunDisc dimmed_disc(const Direction<Enu>& sun, Angle radius,
                    const std::function<double(Wavelength, Angle elevation)>& transmittance) {
  constexpr int kBands = 16, kSteps = 32;
  const auto air = atmosphere::atmosphere_of({});
  assert(air.ok());
  const atmosphere::Medium sunlight = medium_at(*air, atmosphere::band_edges(kBands));
  const Angle lowest = std::max(0 * deg, elevation(sun) - radius);
  const Angle step = std::max((elevation(sun) + radius - lowest) / kSteps, 1e-9 * rad);
  std::vector<std::vector<double>> values(kSteps + 1);
  for (int i = 0; i <= kSteps; ++i)
    for (const atmosphere::SpectralBand& band : sunlight.bands)
      values[size_t(i)].push_back(
          transmittance(band.wavelength_nm * nm, std::min(90 * deg, lowest + double(i) * step)));
  const auto disc = std::make_shared<const AtmosphereDisc>(sunlight, radius, lowest, step, values);
  return {sun, radius, [disc](Angle view, double limb) { return disc->radiance_xyz(view, limb); }};
}

}  // namespace skylapse::sky
