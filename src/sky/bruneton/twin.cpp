#include "sky/bruneton/twin.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/parallel.h"
#include "sky/bruneton/physics.h"
#include "sky/bruneton/rays.h"

namespace skylapse::sky::bruneton {
namespace {

/// Four numbers a group, cut to the bands there are.
struct Bands {
  std::vector<double> values;
  size_t count;
  void add(const glm::dvec4& group) {
    for (int c = 0; c < 4 && values.size() < count; ++c) values.push_back(group[c]);
  }
};

PhysicsData march_data(const Tables& tables, const Columns& columns, int samples) {
  PhysicsData data = physics_data(tables.medium, tables.settings, samples);
  data.columns = columns.nodes().data();
  data.tables = &tables;
  return data;
}

/// Calls body(text, first group) for all groups, marching up to four of them together.
template <class Body>
void for_groups(const PhysicsData& data, const Body& body) {
  const int groups = int(data.groups.size());
  int first = 0;
  for (; first + 4 <= groups; first += 4) {
    text::Physics<4> physics(data, first);
    body(physics, first);
  }
  for (; first < groups; ++first) {
    text::Physics<1> physics(data, first);
    body(physics, first);
  }
}

/// Transmittance towards the sun's centre, times the visible part of its disc.
glm::dvec4 sun_transmittance(Geometry& text, const Columns& columns, const text::BandGroup& band,
                             double h, double mu_s) {
  const double visible = text.sun_visibility(h, mu_s);
  if (visible <= 0) return glm::dvec4(0);
  const text::Ray ray = make_ray(columns, h, std::max(mu_s, text.horizon_mu(h)), RaySide::sky);
  const glm::dvec3 path = columns.paths().columns(ray.height, ray.mu, 0, ray.length);
  return glm::exp(-text.optical_depth(band, path)) * visible;
}

}  // namespace

Twin::Twin(std::shared_ptr<const Tables> tables)
    : tables_(std::move(tables)), columns_(make_columns(tables_->medium)) {}

const atmosphere::Medium& Twin::medium() const { return tables_->medium; }

Answer Twin::answer(const Query& query, const MarchSettings& march) const {
  const double h = query.height.in(km);
  assert(std::isfinite(h) && h >= 0);
  const PhysicsData data = march_data(*tables_, *columns_, march.samples);
  const bool multiple = march.multiple_scattering && !tables_->source.empty();
  const double mu = cos(query.view_zenith), mu_s = cos(query.sun_zenith);
  const double a = sin((query.view_zenith - query.sun_zenith) / 2), b = sin(query.azimuth / 2);
  const double nu = std::clamp(
      1 - 2 * (a * a + sin(query.view_zenith) * sin(query.sun_zenith) * b * b), -1.0, 1.0);
  const text::Ray ray = make_ray(*columns_, h, mu);
  const size_t count = medium().bands.size();
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
      Geometry geometry(data);
      sun.add(sun_transmittance(geometry, *columns_, data.groups[first + g], h, mu_s));
    }
  });
  return {radiance.values, transmittance.values, sun.values};
}

std::vector<double> Twin::transmittance(Length height, Angle zenith) const {
  const double h = height.in(km);
  const PhysicsData data = physics_data(medium(), tables_->settings, 2);
  Geometry text(data);
  const text::Ray ray = make_ray(*columns_, h, cos(zenith));
  Bands result{{}, medium().bands.size()};
  const glm::dvec3 path = columns_->paths().columns(ray.height, ray.mu, 0, ray.length);
  for (const text::BandGroup& band : data.groups)
    result.add(ray.hits_ground > 0 ? glm::dvec4(0) : glm::exp(-text.optical_depth(band, path)));
  return result.values;
}

SkySlice Twin::slice(Length camera_height, Angle sun_zenith, const SliceGrid& grid,
                     const MarchSettings& march) const {
  const PhysicsData data = march_data(*tables_, *columns_, march.samples);
  const bool multiple = march.multiple_scattering && !tables_->source.empty();
  const std::vector<SliceRow> rows = slice_rows(*columns_, camera_height.in(km), grid);
  const double mu_s = cos(sun_zenith);
  SkySlice slice{grid, medium().aerosol_g, sun_zenith.in(rad), {}, {}};
  slice.smooth.resize(size_t(grid.azimuths) * grid.zeniths, glm::vec4(0));
  slice.aerosol = slice.smooth;
  parallel_for_ranges(rows.size(), 1, [&](size_t begin, size_t end) {
    for (size_t j = begin; j < end; ++j)
      for (int i = 0; i < grid.azimuths; ++i) {
        glm::dvec3 smooth(0), aerosol(0);
        for_groups(data, [&](auto& text, int first) {
          const double nu =
              text.cosine_to_sun(rows[j].mu, mu_s, text.slice_azimuth(i, grid.azimuths));
          const text::SunOfRay at = text.sun_of_ray(rows[j].ray, mu_s, nu);
          const auto light = text.march(rows[j].ray, at, multiple);
          for (int g = 0; g < text.GROUPS; ++g) {
            glm::dvec4 sum = light.rayleigh[g] * text.rayleigh_phase(nu) + light.multiple[g];
            if (march.ground) sum += text.ground_through_air(g, rows[j].ray, at, light);
            for (int c = 0; c < 4; ++c) {
              const size_t band = size_t(4) * (first + g) + c;
              if (band >= medium().bands.size()) break;
              smooth += sum[c] * medium().bands[band].xyz_weight;
              aerosol += light.aerosol[g][c] * medium().bands[band].xyz_weight;
            }
          }
        });
        slice.smooth[j * grid.azimuths + i] = glm::vec4(glm::vec3(smooth), 0);
        slice.aerosol[j * grid.azimuths + i] = glm::vec4(glm::vec3(aerosol), 0);
      }
  });
  return slice;
}

}  // namespace skylapse::sky::bruneton
