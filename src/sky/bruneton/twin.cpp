#include "sky/bruneton/twin.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/parallel.h"
#include "sky/bruneton/rays.h"
#include "sky/bruneton/twin_march.h"

namespace skylapse::sky::bruneton {

Twin::Twin(std::shared_ptr<const Tables> tables)
    : tables_(std::move(tables)), columns_(make_columns(tables_->medium)) {
  PhysicsData data = physics_data(tables_->medium, tables_->settings, MarchSettings{}.samples);
  data.columns = columns_->nodes().data();
  data.tables = tables_.get();
  data_ = std::make_shared<const PhysicsData>(std::move(data));
}

const atmosphere::Medium& Twin::medium() const { return tables_->medium; }

Answer Twin::answer(const Query& query, const MarchSettings& march) const {
  const double h = query.height.in(km);
  assert(std::isfinite(h) && h >= 0);
  const PhysicsData data = march_data(*data_, march.samples);
  const bool multiple = march.multiple_scattering && !tables_->source.empty();
  const double mu = cos(query.view_zenith), mu_s = cos(query.sun_zenith);
  const double a = sin((query.view_zenith - query.sun_zenith) / 2), b = sin(query.azimuth / 2);
  const double nu = std::clamp(
      1 - 2 * (a * a + sin(query.view_zenith) * sin(query.sun_zenith) * b * b), -1.0, 1.0);
  const text::Ray ray = make_ray(*columns_, h, mu);
  const size_t count = medium().bands.size();
  const glm::dvec3 to_sun = columns_to_sun(*columns_, h, mu_s);
  const double visible = Geometry(data).sun_visibility(h, mu_s);
  Bands radiance{{}, count}, transmittance{{}, count}, sun{{}, count};
  for_groups(data, [&](auto& text, int first) {
    const text::SunOfRay at = text.sun_of_ray(ray, mu_s, nu);
    const auto light = text.march(ray, at, multiple);
    for (int g = 0; g < text.GROUPS; ++g) {
      glm::dvec4 sum = light.rayleigh[g] * text.rayleigh_phase(nu) +
                       light.aerosol[g] * text.aerosol_phase(nu) + light.multiple[g];
      if (march.ground) sum += text.ground_through_air(g, ray, at, light);
      radiance.add(sum);
      transmittance.add(light.transmittance[g]);
      sun.add(glm::exp(-text.optical_depth(data.groups[first + g], to_sun)) * visible);
    }
  });
  return {radiance.values, transmittance.values, sun.values};
}

std::vector<double> Twin::transmittance(Length height, Angle zenith) const {
  const double h = height.in(km);
  Geometry text(*data_);
  const text::Ray ray = make_ray(*columns_, h, cos(zenith));
  Bands result{{}, medium().bands.size()};
  const glm::dvec3 path = columns_->paths().columns(ray.height, ray.mu, 0, ray.length);
  for (const text::BandGroup& band : data_->groups)
    result.add(ray.hits_ground > 0 ? glm::dvec4(0) : glm::exp(-text.optical_depth(band, path)));
  return result.values;
}

Twin::AerialPerspective Twin::aerial_perspective(const glm::dvec3& from_km, const glm::dvec3& to_km,
                                                 const glm::dvec3& to_sun,
                                                 const MarchSettings& march) const {
  const size_t count = medium().bands.size();
  const double distance = glm::length(to_km - from_km), radius = glm::length(from_km);
  if (distance <= 0 || radius <= 0)
    return {std::vector<double>(count, 0.0), std::vector<double>(count, 1.0)};
  const PhysicsData data = march_data(*data_, march.samples);
  const bool multiple = march.multiple_scattering && !tables_->source.empty();
  const glm::dvec3 direction = (to_km - from_km) / distance;
  const double h = std::max(radius - medium().bottom_radius_km, 0.0);
  const double mu = std::clamp(glm::dot(from_km, direction) / radius, -1.0, 1.0);
  const double mu_s = std::clamp(glm::dot(from_km, to_sun) / radius, -1.0, 1.0);
  const double nu = std::clamp(glm::dot(direction, to_sun), -1.0, 1.0);
  const text::Ray ray = make_ray(*columns_, h, mu, RaySide::by_direction, distance);
  Bands in_scatter{{}, count}, transmittance{{}, count};
  for_groups(data, [&](auto& text, int) {
    const auto light = text.march(ray, text.sun_of_ray(ray, mu_s, nu), multiple);
    for (int g = 0; g < text.GROUPS; ++g) {
      in_scatter.add(light.rayleigh[g] * text.rayleigh_phase(nu) +
                     light.aerosol[g] * text.aerosol_phase(nu) + light.multiple[g]);
      transmittance.add(light.transmittance[g]);
    }
  });
  return {in_scatter.values, transmittance.values};
}

SkySlice Twin::slice(Length camera_height, Angle sun_zenith, const SliceGrid& grid,
                     const MarchSettings& march) const {
  const PhysicsData data = march_data(*data_, march.samples);
  const bool multiple = march.multiple_scattering && !tables_->source.empty();
  const std::vector<SliceRow> rows = slice_rows(*columns_, camera_height.in(km), grid);
  const double mu_s = cos(sun_zenith);
  const SliceWindow window = march.window.value_or(whole_window(grid));
  SkySlice slice = dark_slice(medium(), sun_zenith, grid, march.window);
  const auto node = [&](const SliceRow& row, int column, glm::vec4& to_smooth,
                        glm::vec4& to_aerosol) {
    glm::dvec3 smooth(0), aerosol(0);
    const bool scatters = march.aerial_perspective || row.ray.hits_ground < 0.5;
    for_groups(data, [&](auto& text, int first) {
      const double nu = text.cosine_to_sun(row.mu, mu_s, text.slice_azimuth(column, grid.azimuths));
      const text::SunOfRay at = text.sun_of_ray(row.ray, mu_s, nu);
      const auto light = scatters ? text.march(row.ray, at, multiple) : text.dark_ray();
      for (int g = 0; g < text.GROUPS; ++g) {
        glm::dvec4 sum = light.rayleigh[g] * text.rayleigh_phase(nu) + light.multiple[g];
        if (march.ground) sum += text.ground_through_air(g, row.ray, at, light);
        for (int c = 0; c < 4; ++c) {
          const size_t band = size_t(4) * (first + g) + c;
          if (band >= medium().bands.size()) break;
          smooth += sum[c] * medium().bands[band].xyz_weight;
          aerosol += light.aerosol[g][c] * medium().bands[band].xyz_weight;
        }
      }
    });
    to_smooth = glm::vec4(glm::vec3(smooth), 0);
    to_aerosol = glm::vec4(glm::vec3(aerosol), 0);
  };
  parallel_for_ranges(rows.size(), 1, [&](size_t begin, size_t end) {
    for (size_t j = begin; j < end; ++j) {
      if (!window.has_row(grid, int(j))) continue;
      for (int i = window.azimuths.begin; i < window.azimuths.end; ++i)
        node(rows[j], i, slice.smooth[j * grid.azimuths + i], slice.aerosol[j * grid.azimuths + i]);
    }
  });
  return slice;
}

}  // namespace skylapse::sky::bruneton
