#include "sky/bruneton/march_buffers.h"

#include <algorithm>
#include <cmath>

#include "gpu/functions.h"
#include "sky/bruneton/harmonics.h"
#include "sky/bruneton/slice_lists.h"

namespace skylapse::sky::bruneton {
namespace {

using text::PI;

// As in shaders/shared/march_list.glsl.
struct ListRay {
  int first, count;
  float mu, hits_ground;
  float ground_sun_scale, ground_nu_scale, unused[2];
};
static_assert(sizeof(ListRay) == 32, "the layout of std430");

std::vector<ListRay> rays_of(const MarchLists& lists) {
  std::vector<ListRay> rays;
  const size_t rows = lists.rows[0].mu.size();
  for (size_t i = 0; i < lists.rays.size(); ++i) {
    const MarchRay& ray = lists.rays[i];
    rays.push_back({ray.first,
                    ray.count,
                    float(lists.rows[i / rows].mu[i % rows]),
                    ray.hits_ground ? 1.0f : 0.0f,
                    float(ray.ground_sun_scale),
                    float(ray.ground_nu_scale),
                    {}});
  }
  return rays;
}

std::vector<ListSample> samples_of(const MarchLists& lists, const Settings& settings) {
  std::vector<ListSample> samples;
  for (const MarchSample& sample : lists.samples)
    samples.push_back(list_sample(sample.sun_scale, sample.nu_scale, sample.mu, sample.height_km,
                                  sample.height_coordinate, sample.zenith_coordinate, settings));
  return samples;
}

/// [group of the range][item][channel] from [item][band]; spare channels repeat the last band.
template <class Value>
std::vector<float> grouped(size_t items, int bands, GroupRange range, const Value& value) {
  std::vector<float> result;
  result.reserve(4 * items * range.count);
  for (int g = range.first; g < range.first + range.count; ++g)
    for (size_t i = 0; i < items; ++i)
      for (int c = 0; c < 4; ++c)
        result.push_back(float(value(i * bands + std::min(4 * g + c, bands - 1))));
  return result;
}

}  // namespace

MarchBuffers MarchBuffers::create(const gpu::Functions& gl, const MarchLists& lists,
                                  const Settings& settings, GroupRange range, bool split) {
  const auto weights = [&](const auto& value) {
    return gpu::Buffer::of(gl, grouped(lists.samples.size(), lists.bands, range, value));
  };
  MarchBuffers buffers;
  buffers.rays = gpu::Buffer::of(gl, rays_of(lists));
  buffers.samples = gpu::Buffer::of(gl, samples_of(lists, settings));
  buffers.to_ground =
      gpu::Buffer::of(gl, grouped(lists.rays.size(), lists.bands, range,
                                  [&](size_t i) { return lists.ground_transmittance[i]; }));
  if (split) {
    buffers.rayleigh = weights([&](size_t i) { return lists.rayleigh_weight[i]; });
    buffers.aerosol = weights([&](size_t i) { return lists.aerosol_weight[i]; });
  } else {
    buffers.rayleigh =
        weights([&](size_t i) { return lists.rayleigh_weight[i] + lists.aerosol_weight[i]; });
  }
  return buffers;
}

void MarchBuffers::bind(const gpu::Functions& gl) const {
  rays.bind_storage(gl, 1);
  samples.bind_storage(gl, 2);
  to_ground.bind_storage(gl, 4);
  rayleigh.bind_storage(gl, 6);
  if (aerosol.bytes() > 0) aerosol.bind_storage(gl, 7);
}

HarmonicBuffers HarmonicBuffers::create(const gpu::Functions& gl, const atmosphere::Medium& medium,
                                        const std::vector<DirectionRows>& rows,
                                        const Settings& settings, GroupRange range) {
  const int degree = settings.harmonics, zeniths = settings.table_zeniths;
  const double azimuth_step = 2 * PI / settings.azimuths;  // of both halves of the circle
  HarmonicBuffers buffers;

  std::vector<float> cosines;
  for (int a = 0; a < settings.azimuths; ++a)
    for (int m = 0; m <= degree; ++m)
      cosines.push_back(float(std::cos(m * direction_azimuth(a, settings.azimuths))));
  buffers.direction_cosines = gpu::Buffer::of(gl, cosines);

  cosines.clear();
  for (int m = 0; m <= degree; ++m)
    for (int a = 0; a < settings.table_azimuths; ++a)
      cosines.push_back(float(std::cos(m * PI * a / (settings.table_azimuths - 1))));
  buffers.table_cosines = gpu::Buffer::of(gl, cosines);

  std::vector<float> analysis;
  for (const DirectionRows& point : rows)
    for (size_t k = 0; k < point.mu.size(); ++k)
      for (const double factor : legendre_factors(degree, point.mu[k]))
        analysis.push_back(float(factor * point.weight[k] * azimuth_step));
  buffers.analysis = gpu::Buffer::of(gl, analysis);

  const size_t harmonics = HarmonicIndex{degree}.count();
  std::vector<float> synthesis(harmonics * zeniths);
  for (int z = 0; z < zeniths; ++z) {
    const auto factors = legendre_factors(degree, std::cos(PI * z / (zeniths - 1)));
    for (size_t i = 0; i < harmonics; ++i) synthesis[i * zeniths + z] = float(factors[i]);
  }
  buffers.synthesis = gpu::Buffer::of(gl, synthesis);

  const auto mixture = mixture_moments(medium, settings);
  std::vector<glm::vec4> moments;
  for (int g = range.first; g < range.first + range.count; ++g)
    for (const auto& height : mixture)
      for (const glm::dvec4& moment : height[g]) moments.emplace_back(moment);
  buffers.moments = gpu::Buffer::of(gl, moments);

  std::vector<float> ground;
  for (int k = 0; k < rows[0].up; ++k)
    ground.push_back(float(rows[0].mu[k] * rows[0].weight[k] * azimuth_step));
  buffers.ground_weights = gpu::Buffer::of(gl, ground);
  return buffers;
}

}  // namespace skylapse::sky::bruneton
