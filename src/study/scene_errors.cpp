#include "study/scene_errors.h"

#include <cmath>
#include <ctime>
#include <numbers>

#include "config/air_conversion.h"
#include "core/parallel.h"
#include "plan/sky_model.h"
#include "sky/bruneton/slice_refine.h"
#include "sky/bruneton/twin.h"
#include "sky/hosek_wilkie/sky.h"
#include "sky/monte_carlo/reference.h"

namespace skylapse::study {
namespace {

using plan::ErrorPart;
using plan::kSkyParts;
using plan::SkyPart;
using sky::atmosphere::Medium;
using sky::bruneton::Answer;
using sky::bruneton::Level;
using sky::bruneton::MarchSettings;
using sky::bruneton::Query;
using sky::bruneton::Tables;
using sky::bruneton::Twin;

/// Bands of what stands for the whole spectrum, and of the comparisons of tables.
constexpr int kAllBands = 32, kTableBands = 2;
/// Nodes of each piece of a view ray for the first order of the truth.
constexpr int kTruthNodes = 64;

struct View {
  SkyPart part;
  Direction<Enu> toward;
  Query query;
};

/// The sun stands in the north: azimuths count from it.
Direction<Enu> sun_of(const AccuracyScene& scene) {
  return enu_direction(0 * deg, scene.sun_elevation);
}

Medium medium_of(const AccuracyScene& scene, int bands) {
  return medium_at(sky::atmosphere::atmosphere_of(scene.air).value(),
                   sky::atmosphere::band_edges(bands));
}

/// Points of a part of the sky, uniform in solid angle: those of a low-discrepancy sequence over
/// the whole sky (or over the aureole's cap, the horizon's band...) that fall into it.
std::vector<View> views_of(const AccuracyScene& scene, SkyPart part, int count) {
  const Direction<Enu> sun = sun_of(scene);
  const Angle horizon = plan::horizon_elevation(scene.height, scene.air.planet_radius);
  const auto grid = sky::bruneton::slice_grid(medium_of(scene, 1), scene.height);
  const double top = sin(horizon + grid.sky_span_rad * rad), bottom = sin(horizon);
  std::vector<View> views;
  constexpr int kTries = 40000;
  for (int i = 0; i < kTries && int(views.size()) < count; ++i) {
    // Additive recurrence with the plastic number (M. Roberts 2018).
    const double u = std::fmod(0.5 + 0.7548776662466927 * (i + 1), 1.0);
    const double v = std::fmod(0.5 + 0.5698402909980532 * (i + 1), 1.0);
    double sine = std::lerp(bottom, top, u);
    const auto within = [&](Angle low, Angle high) {
      sine = std::lerp(std::max(bottom, sin(low)), std::min(top, sin(high)), u);
    };
    if (part == SkyPart::horizon_sunward || part == SkyPart::horizon_away)
      within(horizon, horizon + plan::kHorizonBand);
    if (part == SkyPart::aureole)
      within(std::max(horizon, scene.sun_elevation - plan::kAureoleRadius),
             std::min(90 * deg, scene.sun_elevation + plan::kAureoleRadius));
    if (sine < bottom || sine > top) continue;
    const Angle azimuth = std::numbers::pi * v * rad;
    const Direction<Enu> toward = enu_direction(azimuth, std::asin(sine) * rad);
    if (plan::part_of(toward, sun, horizon) != part) continue;
    if (separation(toward, sun) < 0.5 * deg) continue;  // the disc
    views.push_back(
        {part,
         toward,
         {scene.height, 90 * deg - scene.sun_elevation, 90 * deg - elevation(toward), azimuth}});
  }
  return views;
}

std::vector<View> views_of(const AccuracyScene& scene, int count) {
  std::vector<View> all;
  for (int part = 0; part < kSkyParts; ++part)
    for (const View& view : views_of(scene, SkyPart(part), count)) all.push_back(view);
  return all;
}

glm::dvec3 xyz_of(const Medium& medium, const std::vector<double>& radiance) {
  glm::dvec3 xyz(0);
  for (size_t b = 0; b < radiance.size(); ++b) xyz += radiance[b] * medium.bands[b].xyz_weight;
  return xyz;
}

Twin twin_of(const Medium& medium, std::optional<Level> level) {
  Tables tables;
  tables.medium = medium;
  if (level) tables = precompute_twin(medium, settings_for(*level, medium));
  return Twin(std::make_shared<const Tables>(std::move(tables)));
}

using Colours = std::vector<glm::dvec3>;

Colours answers(const Twin& twin, const std::vector<View>& views, const MarchSettings& march = {}) {
  Colours xyz(views.size());
  parallel_for_ranges(views.size(), 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      xyz[i] = xyz_of(twin.medium(), twin.answer(views[i].query, march).radiance);
  });
  return xyz;
}

/// Times as many paths where few of them find light: in twilight.
long paths_for(const AccuracyScene& scene, long paths) {
  const Angle over =
      scene.sun_elevation - plan::horizon_elevation(scene.height, scene.air.planet_radius);
  return paths * (over < -6 * deg ? 6 : over < -2 * deg ? 3 : 1);
}

/// Mean of the values of each part of the sky with its standard error.
class PartMeans {
 public:
  void add(SkyPart part, double value) {
    Sum& sum = sums_[size_t(part)];
    sum.n += 1, sum.first += value, sum.second += value * value;
  }
  void store(SceneErrors& errors, ErrorPart error) const {
    for (int part = 0; part < kSkyParts; ++part) {
      const Sum& s = sums_[part];
      if (s.n == 0) continue;
      const double mean = s.first / s.n, variance = std::max(0.0, s.second / s.n - mean * mean);
      errors.parts[size_t(error)][part] = {mean, std::sqrt(variance / std::max(1.0, s.n - 1))};
    }
  }

 private:
  struct Sum {
    double n = 0, first = 0, second = 0;
  };
  std::array<Sum, kSkyParts> sums_{};
};

/// Stores the mean squares of the relative difference of two models.
void compare(const std::vector<View>& views, const Colours& model, const Colours& truth,
             ErrorPart part, SceneErrors& errors) {
  PartMeans means;
  for (size_t i = 0; i < views.size(); ++i) {
    const double scale = glm::length(truth[i]);
    if (scale > 0) means.add(views[i].part, std::pow(glm::length(model[i] - truth[i]) / scale, 2));
  }
  means.store(errors, part);
}

/// Few bands against many, with tables of the level draft, whose own error is common to both.
void measure_bands(const AccuracyScene& scene, const std::vector<View>& views,
                   SceneErrors& errors) {
  const Twin twin = twin_of(medium_of(scene, kAllBands), Level::draft);
  const Colours all = answers(twin, views);
  compare(views, answers(twin, views, {.multiple_scattering = false}), all,
          ErrorPart::single_scattering, errors);
  for (const auto& [bands, part] :
       {std::pair(4, ErrorPart::bands_4), std::pair(8, ErrorPart::bands_8),
        std::pair(16, ErrorPart::bands_16)})
    compare(views, answers(twin_of(medium_of(scene, bands), Level::draft), views), all, part,
            errors);

  const double turbidity = config::turbidity_from_aerosol_depth(scene.air.aerosol_optical_depth);
  if (scene.height > plan::kNearGround) return;
  const auto fit = sky::hosek_wilkie::Sky::make(
      sky::hosek_wilkie::Fit::spectral, sky::hosek_wilkie::SolarFlux::reference,
      std::max(1.0, turbidity), sky::grey_bands(scene.ground_albedo), scene.sun_elevation);
  if (!fit) return;  // sun or haze that it does not know
  Colours fitted;
  for (const View& view : views) fitted.push_back(fit->radiance_xyz(view.toward, sun_of(scene)));
  compare(views, fitted, all, ErrorPart::hosek_wilkie, errors);
}

/// The slice of a frame, as frames read it.
Colours slice_colours(const Twin& twin, const std::vector<View>& views,
                      const AccuracyScene& scene) {
  const auto grid = sky::bruneton::slice_grid(twin.medium(), scene.height);
  const auto slice =
      sky::bruneton::refined(twin.slice(scene.height, 90 * deg - scene.sun_elevation, grid));
  Colours xyz;
  for (const View& view : views)
    xyz.push_back(slice.radiance_xyz(view.query.view_zenith, view.query.azimuth));
  return xyz;
}

/// `fine`, through a slice, against the path tracer.
void trace(const Medium& medium, const std::vector<View>& views, const Colours& fine, int traced,
           long paths, uint64_t seed, SceneErrors& errors) {
  const Twin exact = twin_of(medium, {});
  PartMeans squares, deviations, times;
  std::array<int, kSkyParts> in_part{};
  for (size_t i = 0; i < views.size(); ++i) {
    const double scale = glm::length(fine[i]);
    if (in_part[size_t(views[i].part)]++ >= traced || !(scale > 0)) continue;
    const auto first =
        exact.answer(views[i].query, {.samples = kTruthNodes, .multiple_scattering = false});
    std::array<glm::dvec3, 2> difference;
    for (const int half : {0, 1}) {
      const std::clock_t start = std::clock();
      const auto answer = sky::monte_carlo::reference_answer(
          medium, views[i].query,
          {.samples = paths, .seed = seed * 1'000'003 + 2 * i + size_t(half)});
      const double us = 1e6 * double(std::clock() - start) / CLOCKS_PER_SEC / double(paths);
      std::vector<double> light = first.radiance;
      for (size_t b = 0; b < light.size(); ++b) light[b] += answer.radiance[b] - answer.order1[b];
      difference[half] = (fine[i] - xyz_of(medium, light)) / scale;
      const glm::dvec3 deviation = xyz_of(medium, answer.standard_error) / scale;
      deviations.add(views[i].part, glm::dot(deviation, deviation) * double(paths));
      times.add(views[i].part, us * us);
    }
    squares.add(views[i].part, glm::dot(difference[0], difference[1]));
  }
  squares.store(errors, ErrorPart::fine);
  deviations.store(errors, ErrorPart::path);
  times.store(errors, ErrorPart::path_time);
}

/// The levels against `fine`, and that against the truth.
void measure_tables(const AccuracyScene& scene, const std::vector<View>& views,
                    const MeasureOptions& options, SceneErrors& errors) {
  const Medium medium = medium_of(scene, kTableBands);
  const Twin fine = twin_of(medium, Level::fine);
  const Colours best = answers(fine, views);
  for (const auto& [level, part] :
       {std::pair(Level::draft, ErrorPart::draft), std::pair(Level::low, ErrorPart::low),
        std::pair(Level::standard, ErrorPart::standard)})
    compare(views, answers(twin_of(medium, level), views), best, part, errors);
  trace(medium, views, slice_colours(fine, views, scene), options.traced,
        paths_for(scene, options.paths), options.seed, errors);
}

}  // namespace

SceneErrors measure_scene(const AccuracyScene& scene, const MeasureOptions& options) {
  const std::clock_t start = std::clock();
  SceneErrors errors;
  const std::vector<View> views = views_of(scene, options.directions);
  measure_bands(scene, views, errors);
  if (options.tables) measure_tables(scene, views, options, errors);
  errors.core_seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  return errors;
}

}  // namespace skylapse::study
