#include "sky/hosek_wilkie/probe.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "sky/hosek_wilkie/model.h"
#include "sky/hosek_wilkie/solar_disc.h"

namespace skylapse::sky::hosek_wilkie {
namespace {

// 90 and 180 deg typed in degrees may come back an ulp high after unit conversion.
constexpr Angle kRounding = 1e-12 * rad;

Error refuse(std::string message, std::string allowed) {
  return {ErrorCode::invalid_input, std::move(message), {}, "allowed: " + std::move(allowed)};
}

std::optional<Error> check_angle(const char* name, Angle value, Angle high) {
  if (value >= 0 * deg && value <= high + kRounding) return std::nullopt;
  return refuse(fmt::format("{} = {} deg is outside the model", name, value.in(deg)),
                fmt::format("0 to {} deg", high.in(deg)));
}

std::optional<double> wavelength_nm(const std::string& band) {
  char* end = nullptr;
  const double value = std::strtod(band.c_str(), &end);
  if (band.empty() || *end != '\0' || !(value >= 320 && value <= 720)) return std::nullopt;
  return value;
}

Result<double> probe_channel(const ProbeQuery& query, Fit fit, std::string_view letters) {
  const size_t channel = query.band.size() == 1 ? letters.find(query.band) : std::string::npos;
  if (channel == std::string::npos)
    return refuse(fmt::format("band '{}' is not a channel of this fit", query.band),
                  fmt::format("{}, {}, {}", letters[0], letters[1], letters[2]));
  SkyParameters parameters{query.turbidity, {}, query.sun_elevation};
  parameters.albedo.fill(query.albedo);
  const Result<Patterns> patterns = make_patterns(fit, parameters);
  if (!patterns) return patterns.error();
  return radiance(patterns->items[channel], query.view_zenith, query.gamma);
}

Result<double> probe_spectral(const ProbeQuery& query) {
  const auto band = wavelength_nm(query.band);
  if (!band) return refuse("band '" + query.band + "' is not a wavelength", "320 to 720 (nm)");
  SkyParameters parameters{query.turbidity, {}, query.sun_elevation};
  parameters.albedo.fill(query.albedo);
  const Result<Patterns> patterns = make_patterns(Fit::spectral, parameters);
  if (!patterns) return patterns.error();
  const Result<SolarDisc> disc = SolarDisc::make(query.turbidity, SolarFlux::reference);
  if (!disc) return disc.error();
  double value = 0;
  if (query.kind != ProbeKind::spectral)
    if (const auto limb = disc->limb_variable(query.gamma))
      value += disc->radiance(*band * nm, 90 * deg - query.view_zenith, *limb).in(W_per_m2_sr_nm);
  if (query.kind != ProbeKind::solar_direct)
    value +=
        spectral_radiance(*patterns, *band * nm, query.view_zenith, query.gamma).in(W_per_m2_sr_nm);
  return value;
}

}  // namespace

Result<double> probe(const ProbeQuery& query) {
  if (auto error = check_angle("view zenith angle", query.view_zenith, 90 * deg)) return *error;
  if (auto error = check_angle("gamma", query.gamma, 180 * deg)) return *error;
  switch (query.kind) {
    case ProbeKind::xyz:
      return probe_channel(query, Fit::xyz, "XYZ");
    case ProbeKind::rgb:
      return probe_channel(query, Fit::rgb, "RGB");
    default:
      return probe_spectral(query);
  }
}

Result<ProbeKind> probe_kind_from_name(const std::string& name) {
  constexpr std::array<std::string_view, 5> kNames{"spectral", "xyz", "rgb", "solar_direct",
                                                   "solar_total"};
  for (size_t i = 0; i < kNames.size(); ++i)
    if (kNames[i] == name) return static_cast<ProbeKind>(i);
  return refuse("unknown kind '" + name + "'", "spectral, xyz, rgb, solar_direct, solar_total");
}

}  // namespace skylapse::sky::hosek_wilkie
