// Places where formulas break, asked on GL and of the twin.
#include <gmock/gmock.h>

#include <cmath>

#include "parity/twins.h"

namespace skylapse::sky::bruneton {
namespace {

struct Medley {
  const char* name;
  atmosphere::Medium medium;
};

/// Media at the ends of what is allowed.
std::vector<Medley> hard_media() {
  const atmosphere::Medium reference = atmosphere::reference_medium();
  const auto of_medium = [&](auto change) {
    atmosphere::Medium medium = reference;
    change(medium);
    return medium;
  };
  const auto of_bands = [&](auto change) {
    atmosphere::Medium medium = reference;
    for (auto& band : medium.bands) change(band);
    return medium;
  };
  return {{"g 0.99", of_medium([](auto& m) { m.aerosol_g = 0.99; })},
          {"g 0", of_medium([](auto& m) { m.aerosol_g = 0; })},
          {"g -0.5", of_medium([](auto& m) { m.aerosol_g = -0.5; })},
          {"white ground", of_bands([](auto& b) { b.ground_albedo = 1; })},
          {"black ground", of_bands([](auto& b) { b.ground_albedo = 0; })},
          {"no aerosol", of_bands([](auto& b) {
             b.aerosol_scattering_per_km = b.aerosol_extinction_per_km = 0;
           })},
          {"no ozone", of_bands([](auto& b) { b.ozone_absorption_per_km = 0; })},
          {"no Rayleigh", of_bands([](auto& b) { b.rayleigh_scattering_per_km = 0; })},
          {"no air", of_bands([](auto& b) {
             b.rayleigh_scattering_per_km = b.aerosol_scattering_per_km =
                 b.aerosol_extinction_per_km = b.ozone_absorption_per_km = 0;
           })},
          {"visibility 200 m", of_bands([](auto& b) {
             b.aerosol_scattering_per_km = 17.6;
             b.aerosol_extinction_per_km = 19.6;
           })},
          {"planet of 400 km", of_medium([](auto& m) { m.bottom_radius_km = 400; })},
          {"planet of 60000 km", of_medium([](auto& m) { m.bottom_radius_km = 60000; })}};
}

/// Observers, suns and views where something ends.
std::vector<Query> hard_queries(const atmosphere::Medium& medium) {
  const double R = medium.bottom_radius_km, H = medium.top_height_km;
  std::vector<Query> queries;
  for (const double h : {0.0, 1e-5, 1e-3, H - 1e-3, H, H + 1e-3, 400.0, 36000.0}) {
    const double horizon = 90 + std::atan2(std::sqrt(h * (2 * R + h)), R) / (1 * deg).in(rad);
    const double micro = 1e-6 / (1 * deg).in(rad);
    for (const double sun : {0.0, 45.0, 90.0, horizon, 120.0, 180.0})
      for (const double view :
           {0.0, sun, horizon - micro, horizon, horizon + micro, 180 - sun, 180.0})
        for (const double azimuth : {0.0, 180.0})
          queries.push_back({h * km, sun * deg, view * deg, azimuth * deg});
  }
  return queries;
}

using AnyHardCase = gpu::AnyContext;

TEST_P(AnyHardCase, IsFiniteAndPhysical) {
  for (const Medley& medley : hard_media()) {
    Settings settings = odd_settings();
    settings.max_orders = 4;
    const Tables tables = value_of(precompute(*context_, medley.medium, settings));
    for (const auto& group : tables.source)
      for (const float value : group)
        ASSERT_TRUE(std::isfinite(value) && value >= 0) << medley.name;
    const auto model = GpuModel::create(context_, tables);
    ASSERT_TRUE(model.ok());
    const auto queries = hard_queries(medley.medium);
    const auto answers =
        value_of(model->answer(queries, {.multiple_scattering = true, .ground = true}));
    ASSERT_EQ(answers.size(), queries.size());
    for (size_t i = 0; i < answers.size(); ++i)
      for (size_t b = 0; b < answers[i].radiance.size(); ++b) {
        const Answer& a = answers[i];
        EXPECT_TRUE(std::isfinite(a.radiance[b]) && a.radiance[b] >= 0 && a.transmittance[b] >= 0 &&
                    a.transmittance[b] <= 1 && a.sun_transmittance[b] >= 0 &&
                    a.sun_transmittance[b] <= 1)
            << medley.name << ": height " << queries[i].height.in(km) << " km, sun "
            << queries[i].sun_zenith.in(deg) << ", view " << queries[i].view_zenith.in(deg) << ": "
            << a.radiance[b] << " " << a.transmittance[b] << " " << a.sun_transmittance[b];
      }
  }
}

SKYLAPSE_ON_EVERY_CONTEXT(AnyHardCase);

}  // namespace
}  // namespace skylapse::sky::bruneton
