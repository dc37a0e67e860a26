#include <fmt/format.h>

#include <map>
#include <mutex>

#include "plan/effects/calibrated_bounds.h"
#include "plan/effects/rule.h"
#include "plan/plan.h"
#include "plan/rates.h"

namespace skylapse::plan {
namespace {

/// XYZ of sunlight off a ground, its spectrum told in so many bands.
glm::dvec3 sunlit_ground(const sky::atmosphere::Atmosphere& atmosphere, int bands) {
  const auto medium = sky::atmosphere::medium_at(atmosphere, sky::atmosphere::band_edges(bands));
  glm::dvec3 xyz(0);
  for (const auto& band : medium.bands)
    xyz += band.solar_irradiance * band.ground_albedo * band.xyz_weight;
  return xyz;
}

/// How far the default's bands miss the colour of a sunlit ground: plants rise from dark to bright
/// within one band, at 700 nm.
double error_of_ground(const config::Albedo& albedo) {
  if (!albedo.spectral) return 0;
  static std::mutex mutex;
  static std::map<std::string, double> known;  // few grounds, many frames
  const std::lock_guard lock(mutex);
  const auto found = known.find(albedo.name);
  if (found != known.end()) return found->second;
  sky::atmosphere::AirDescription air;
  air.ground_albedo = config::ground_spectrum(albedo);
  const auto atmosphere = sky::atmosphere::atmosphere_of(air);
  double error = 0;
  if (atmosphere) {
    const glm::dvec3 all = sunlit_ground(*atmosphere, kFullSpectrum);
    error =
        glm::length(sunlit_ground(*atmosphere, config::Sky{}.wavelengths) - all) / glm::length(all);
  }
  return known.emplace(albedo.name, error).first->second;
}

}  // namespace

Verdict judge_full_spectrum(const Plan& plan, const Frame&) {
  const config::Sky& sky = plan.job.sky;
  const double seconds = rates::full_spectrum_seconds(plan);
  if (sky.wavelengths_given || sky.accuracy || sky.time_budget)
    return {
        false, fmt::format("{} wavelengths are asked for", sky.wavelengths), {}, seconds, false};
  const int few = config::Sky{}.wavelengths;
  for (const auto& albedo : plan.job.air.ground_albedo)
    if (const double error = error_of_ground(albedo.value); error > kLeaveBelow)
      return {true,
              fmt::format("sunlit {} is {:.2g} % off in {} wavelengths", albedo.value.name,
                          100 * error, few),
              {},
              seconds};
  const Pressure pressure = plan.job.air.description.surface_pressure;
  if (pressure > kSpectrumPressure)
    return {true, fmt::format("the air weighs {:.0f} hPa", pressure.in(hPa)), {}, seconds};
  return {false, fmt::format("{} wavelengths stand for {}", few, kFullSpectrum), kSpectrumError,
          seconds};
}

}  // namespace skylapse::plan
