#include "sky/atmosphere/medium.h"

#include <fmt/format.h>

#include <cmath>

namespace skylapse::sky::atmosphere {
namespace {

constexpr size_t kMaxBands = 64;

/// Collects the first violation: what it is, and what is allowed.
class Checker {
 public:
  void require(bool good, const std::string& name, double value, const std::string& allowed) {
    if (good || !first_.empty()) return;
    first_ = fmt::format("{} = {:g} is no property of an atmosphere", name, value);
    hint_ = "allowed: " + allowed;
  }
  [[nodiscard]] Status status() const {
    if (first_.empty()) return Done{};
    return Error{ErrorCode::invalid_input, first_, {}, hint_};
  }

 private:
  std::string first_, hint_;
};

// Written so that NaN fails each of them.
bool in_range(double value, double low, double high) { return value >= low && value <= high; }
bool is_coefficient(double value) { return value >= 0 && std::isfinite(value); }

void check_profile(const DensityProfile& profile, const std::string& name, double top_km,
                   Checker& checker) {
  const auto count = static_cast<double>(profile.terms.size());
  checker.require(profile.terms.size() <= kMaxDensityTerms, name + " density terms", count,
                  fmt::format("0 to {}", kMaxDensityTerms));
  for (size_t i = 0; i < profile.terms.size(); ++i) {
    const DensityTerm& term = profile.terms[i];
    const std::string at = fmt::format("{} density term {}: ", name, i + 1);
    checker.require(std::isfinite(term.bottom_km), at + "bottom", term.bottom_km, "a height in km");
    checker.require(term.top_km > term.bottom_km && std::isfinite(term.top_km), at + "top",
                    term.top_km, "a height above the term's bottom");
    for (const double number :
         {term.amplitude, term.inverse_scale_height_per_km, term.slope_per_km, term.constant})
      checker.require(std::isfinite(number), at + "a number", number, "finite numbers");
  }
  const double column = profile.vertical_column_km(top_km);
  checker.require(is_coefficient(column), name + " density's vertical column [km]", column,
                  "0 or more, and finite");
}

void check_band(const SpectralBand& band, Checker& checker) {
  const std::string at = fmt::format("band at {:g} nm: ", band.wavelength_nm);
  const auto coefficient = [&](double value, const std::string& name) {
    checker.require(is_coefficient(value), at + name, value, "0 or more, and finite");
  };
  checker.require(band.wavelength_nm > 0 && std::isfinite(band.wavelength_nm), "wavelength [nm]",
                  band.wavelength_nm, "above 0");
  coefficient(band.solar_irradiance, "solar irradiance");
  coefficient(band.rayleigh_scattering_per_km, "Rayleigh scattering");
  coefficient(band.aerosol_extinction_per_km, "aerosol extinction");
  coefficient(band.aerosol_scattering_per_km, "aerosol scattering");
  coefficient(band.ozone_absorption_per_km, "ozone absorption");
  // The product of extinction and an albedo of 1 may differ from the extinction by rounding.
  checker.require(
      band.aerosol_scattering_per_km <= band.aerosol_extinction_per_km * (1 + 1e-12),
      at + "aerosol scattering", band.aerosol_scattering_per_km,
      fmt::format("not above the aerosol extinction, {:g}", band.aerosol_extinction_per_km));
  checker.require(in_range(band.ground_albedo, 0, 1), at + "ground albedo", band.ground_albedo,
                  "0 to 1");
  for (int i = 0; i < 3; ++i)
    checker.require(std::isfinite(band.xyz_weight[i]), at + "CIE weight", band.xyz_weight[i],
                    "finite");
}

void append(std::string& text, double value) {
  fmt::format_to(std::back_inserter(text), " {:a}", value + 0.0);  // -0 and 0 are equal
}

void append(std::string& text, const std::string& name, const DensityProfile& profile) {
  fmt::format_to(std::back_inserter(text), "{} {}\n", name, profile.terms.size());
  for (const DensityTerm& t : profile.terms) {
    for (const double number : {t.bottom_km, t.top_km, t.amplitude, t.inverse_scale_height_per_km,
                                t.slope_per_km, t.constant})
      append(text, number);
    text += '\n';
  }
}

}  // namespace

Status check(const Medium& medium) {
  Checker checker;
  const double top = medium.top_height_km;
  checker.require(medium.bottom_radius_km > 0 && std::isfinite(medium.bottom_radius_km),
                  "planet radius [km]", medium.bottom_radius_km, "above 0");
  checker.require(top > 0 && std::isfinite(top), "top of the atmosphere [km]", top,
                  "above the ground (0)");
  checker.require(in_range(medium.sun_angular_radius_rad, 0, 0.5), "sun's angular radius [rad]",
                  medium.sun_angular_radius_rad, "0 to 0.5");
  checker.require(in_range(medium.rayleigh_depolarization, 0, 1), "Rayleigh depolarization",
                  medium.rayleigh_depolarization, "0 to 1");
  checker.require(std::abs(medium.aerosol_g) < 1, "aerosol g", medium.aerosol_g,
                  "above -1 and below 1");
  check_profile(medium.rayleigh, "Rayleigh", top, checker);
  check_profile(medium.aerosol, "aerosol", top, checker);
  check_profile(medium.ozone, "ozone", top, checker);
  checker.require(!medium.bands.empty() && medium.bands.size() <= kMaxBands, "number of bands",
                  static_cast<double>(medium.bands.size()), fmt::format("1 to {}", kMaxBands));
  for (const SpectralBand& band : medium.bands) check_band(band, checker);
  return checker.status();
}

std::string canonical_text(const Medium& medium) {
  std::string text = "medium 1\n";
  for (const double number :
       {medium.bottom_radius_km, medium.top_height_km, medium.sun_angular_radius_rad,
        medium.rayleigh_depolarization, medium.aerosol_g})
    append(text, number);
  text += '\n';
  append(text, "rayleigh", medium.rayleigh);
  append(text, "aerosol", medium.aerosol);
  append(text, "ozone", medium.ozone);
  fmt::format_to(std::back_inserter(text), "bands {}\n", medium.bands.size());
  for (const SpectralBand& b : medium.bands) {
    for (const double number :
         {b.wavelength_nm, b.solar_irradiance, b.rayleigh_scattering_per_km,
          b.aerosol_scattering_per_km, b.aerosol_extinction_per_km, b.ozone_absorption_per_km,
          b.ground_albedo, b.xyz_weight.x, b.xyz_weight.y, b.xyz_weight.z})
      append(text, number);
    text += '\n';
  }
  return text;
}

Medium reference_medium() {
  struct Row {
    double wavelength_nm, solar_irradiance, ozone_cross_section_m2;
  };
  constexpr Row kRows[] = {
      {680, 1.474, 1.209e-25}, {550, 1.8504, 3.5e-25}, {440, 1.91198, 1.582e-26}};
  constexpr double kRayleigh = 1.24062e-6;        // per metre at 1 um, times wavelength^-4
  constexpr double kAerosolExtinction = 4.44e-3;  // per km: depth 5.328e-3 over 1.2 km
  constexpr double kAerosolAlbedo = 0.9;
  // 300 DU in a tent whose integral is 15 km; molecules per m^3 at its peak.
  constexpr double kOzonePeak = 300 * 2.687e20 / 15000;

  Medium medium;
  medium.bottom_radius_km = 6360;
  medium.top_height_km = 60;
  medium.sun_angular_radius_rad = 0.004675;
  medium.rayleigh_depolarization = 0;
  medium.aerosol_g = 0.8;
  medium.rayleigh = exponential_profile(8.0 * km, 60.0 * km);
  medium.aerosol = exponential_profile(1.2 * km, 60.0 * km);
  medium.ozone = tent_profile(10.0 * km, 25.0 * km, 40.0 * km);
  for (const Row& row : kRows) {
    const double um = row.wavelength_nm * 1e-3;
    medium.bands.push_back(
        {.wavelength_nm = row.wavelength_nm,
         .solar_irradiance = row.solar_irradiance,
         .rayleigh_scattering_per_km = 1e3 * kRayleigh / (um * um * um * um),
         .aerosol_scattering_per_km = kAerosolAlbedo * kAerosolExtinction,
         .aerosol_extinction_per_km = kAerosolExtinction,
         .ozone_absorption_per_km = 1e3 * kOzonePeak * row.ozone_cross_section_m2,
         .ground_albedo = 0.1});
  }
  return medium;
}

}  // namespace skylapse::sky::atmosphere
