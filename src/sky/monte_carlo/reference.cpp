#include "sky/monte_carlo/reference.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/parallel.h"
#include "sky/monte_carlo/view_ray.h"

namespace skylapse::sky::monte_carlo {
namespace {

/// Paths that one thread sums up in one go; sums of batches are added in their order.
constexpr long kBatch = 512;

/// Sum and sum of squares of one quantity.
struct Moments {
  PerBand sum{}, squares{};
  void add(const PerBand& value, int bands) {
    for (int b = 0; b < bands; ++b) sum[b] += value[b], squares[b] += value[b] * value[b];
  }
  void add(const Moments& o, int bands) {
    for (int b = 0; b < bands; ++b) sum[b] += o.sum[b], squares[b] += o.squares[b];
  }
  void finish(int bands, long n, std::vector<double>& mean, std::vector<double>& error) const {
    for (int b = 0; b < bands; ++b) {
      const double m = sum[b] / double(n);
      const double variance = std::max(0.0, squares[b] / double(n) - m * m);
      mean.push_back(m);
      error.push_back(n > 1 ? std::sqrt(variance / double(n - 1)) : 0);
    }
  }
};

struct Sums {
  Moments order1, up_to_order4, all;
  long paths = 0;
};

/// Traces path number `index`.
using TracePath = std::function<void(Path&, long index, PathRandom&, PathRadiance&)>;

class Sampler {
 public:
  Sampler(const Optics& optics, const ReferenceOptions& options)
      : optics_(optics), options_(options) {}

  Sums run(const TracePath& trace) const {
    Sums total;
    // Rounds double the paths until they suffice; where rounds end depends on nothing else.
    const long wanted = std::max(1L, options_.samples);
    long round = options_.relative_error ? std::min(wanted, 16 * kBatch) : wanted;
    while (total.paths < wanted) {
      add_round(trace, std::min(wanted, round), total);
      if (options_.relative_error && precise(total)) break;
      round *= 2;
    }
    return total;
  }

 private:
  [[nodiscard]] bool precise(const Sums& sums) const {
    std::vector<double> mean, error;
    sums.all.finish(optics_.bands, sums.paths, mean, error);
    for (size_t b = 0; b < mean.size(); ++b)
      if (error[b] > *options_.relative_error * mean[b]) return false;
    return true;
  }

  /// Paths total.paths .. end - 1.
  void add_round(const TracePath& trace, long end, Sums& total) const {
    const long begin = total.paths;
    const size_t batches = size_t((end - begin + kBatch - 1) / kBatch);
    std::vector<Sums> parts(batches);
    parallel_for_ranges(batches, 1, [&](size_t first, size_t last) {
      Path path(optics_, rules_of(options_));
      PathRadiance found;
      for (size_t i = first; i < last; ++i) {
        const long from = begin + long(i) * kBatch, to = std::min(end, from + kBatch);
        for (long n = from; n < to; ++n) {
          PathRandom random(options_.seed, uint64_t(n));
          trace(path, n, random, found);
          parts[i].order1.add(found.order1, optics_.bands);
          parts[i].up_to_order4.add(found.up_to_order4, optics_.bands);
          parts[i].all.add(found.all, optics_.bands);
        }
      }
    });
    for (const Sums& part : parts) {
      total.order1.add(part.order1, optics_.bands);
      total.up_to_order4.add(part.up_to_order4, optics_.bands);
      total.all.add(part.all, optics_.bands);
    }
    total.paths = end;
  }

  const Optics& optics_;
  const ReferenceOptions& options_;
};

std::vector<double> per_band(const Optics& optics, const PerBand& values) {
  return {values.begin(), values.begin() + optics.bands};
}

std::vector<double> sun_transmittance(const Optics& optics, double height, double mu_sun) {
  SunView sun;
  // Above the air only the planet can hide the sun.
  if (height > optics.shells.top()) {
    const Shells& shells = optics.shells;
    const double radius = shells.radius(), r = radius + height;
    const double below = r * r * (1 - mu_sun * mu_sun);
    const double top = radius + shells.top();
    if (mu_sun >= 0 || below >= top * top) return std::vector<double>(size_t(optics.bands), 1.0);
    // The ray enters the air at its top: the same ray, seen from there.
    const double mu_top = -std::sqrt(std::max(0.0, 1 - below / (top * top)));
    return sun_transmittance(optics, shells.top(), mu_top);
  }
  optics.view_sun(height, mu_sun, SunVisibility::smooth_step, sun);
  if (!(sun.visible > 0)) return std::vector<double>(size_t(optics.bands), 0.0);
  std::vector<double> values = per_band(optics, sun.transmittance);
  for (double& v : values) v *= sun.visible;
  return values;
}

}  // namespace

ReferenceAnswer reference_answer(const atmosphere::Medium& medium, const bruneton::Query& query,
                                 const ReferenceOptions& options) {
  const Optics optics(medium, options.aerosol);
  const double height = query.height.in(km);
  assert(height >= 0 && std::isfinite(height));
  const glm::dvec3 direction = direction_of(query.view_zenith, query.azimuth);
  const glm::dvec3 to_sun = direction_of(query.sun_zenith, 0 * rad);
  ReferenceAnswer answer;
  answer.sun_transmittance = sun_transmittance(optics, height, cos(query.sun_zenith));
  const auto none = [&](double value) { return std::vector<double>(medium.bands.size(), value); };
  const std::optional<Place> start = entry(optics.shells, height, direction);
  if (start) {
    const ViewRay ray(optics, *start, direction, to_sun, options);
    answer.transmittance = per_band(optics, ray.transmittance());
    if (!ray.dark()) {
      const Sums sums = Sampler(optics, options).run(std::cref(ray));
      sums.all.finish(optics.bands, sums.paths, answer.radiance, answer.standard_error);
      sums.order1.finish(optics.bands, sums.paths, answer.order1, answer.order1_error);
      sums.up_to_order4.finish(optics.bands, sums.paths, answer.up_to_order4,
                               answer.up_to_order4_error);
      answer.samples = sums.paths;
      return answer;
    }
  } else {
    answer.transmittance = none(1);
  }
  answer.radiance = answer.order1 = answer.up_to_order4 = none(0);
  answer.standard_error = answer.order1_error = answer.up_to_order4_error = none(0);
  return answer;
}

ReferenceIrradiance reference_irradiance(const atmosphere::Medium& medium, Length height,
                                         Angle sun_zenith, const ReferenceOptions& options) {
  const Optics optics(medium, options.aerosol);
  const Place observer{height.in(km), {0, 0, 1}};
  assert(observer.height >= 0 && observer.height <= optics.shells.top());
  const glm::dvec3 to_sun = direction_of(sun_zenith, 0 * rad);
  ReferenceIrradiance irradiance;
  SunView sun;
  const double cosine =
      optics.sun_on_ground(observer.height, to_sun.z, SunVisibility::smooth_step, sun);
  for (int b = 0; b < optics.bands; ++b)
    irradiance.sun.push_back(
        cosine > 0 ? cosine * optics.solar[size_t(b)] * sun.transmittance[size_t(b)] : 0);
  const AerosolPhase lobe = optics.has_aerosol ? optics.aerosol_phase : AerosolPhase(0);
  const double chance = optics.has_aerosol && to_sun.z > 0 ? 0.3 : 0;
  const auto trace = [&](Path& path, long index, PathRandom& random, PathRadiance& found) {
    const glm::dvec3 sun_seen = sun_of_path(optics, to_sun, options.sun, random);
    const bool at_sun = chance > 0 && random.uniform() < chance;
    const glm::dvec3 direction = at_sun ? turned(to_sun, lobe.sample(random), random)
                                        : turned(observer.up, std::sqrt(random.uniform()), random);
    path.begin(observer, direction, sun_seen, int(index % optics.bands), random, found);
    if (!(direction.z > 0)) return;
    const double density = (1 - chance) * direction.z / std::numbers::pi +
                           chance * lobe.at(glm::dot(direction, to_sun));
    path.scale(direction.z / density);
    while (path.travel()) {
    }
  };
  const Sums sums = Sampler(optics, options).run(trace);
  sums.all.finish(optics.bands, sums.paths, irradiance.sky, irradiance.sky_error);
  irradiance.samples = sums.paths;
  return irradiance;
}

}  // namespace skylapse::sky::monte_carlo
