#include "plan/error_bounds.h"

#include <algorithm>
#include <cmath>

#include "data/error_bounds.h"

namespace skylapse::plan {
namespace {

constexpr std::array kSunNodes{-32., -12., -8., -5., -2., 0., 3., 8., 20., 45., 90.};
constexpr std::array kHeightNodes{0., 1., 4., 12., 40., 400.};
constexpr std::array kHazeNodes{0., 0.05, 0.15, 0.4, 0.8, 1.5};
constexpr std::array kGroundNodes{0., 0.45, 0.9};
constexpr std::array kOzoneNodes{200., 450.};
static_assert(kSunNodes.size() + kHeightNodes.size() + kHazeNodes.size() + kGroundNodes.size() +
                  kOzoneNodes.size() ==
              kFeatureNodes);

double plain(double value) { return value; }

using S = SceneFeatures;
const std::array kFeatures{
    Feature{"sun", kSunNodes,
            [](const S& s, SkyPart part) { return sun_elevation_at(part, s).in(deg); }, plain},
    Feature{"height", kHeightNodes, [](const S& s, SkyPart) { return s.height.in(km); },
            [](double h) { return std::log(1 + h); }},
    Feature{"haze", kHazeNodes, [](const S& s, SkyPart) { return s.aerosol_depth; },
            [](double depth) { return std::log(0.02 + depth); }},
    Feature{"ground", kGroundNodes, [](const S& s, SkyPart) { return s.ground_albedo; }, plain},
    Feature{"ozone", kOzoneNodes, [](const S& s, SkyPart) { return s.ozone_du; }, plain}};
/// The lowest sun over the horizontal that scenes of the calibration have.
constexpr Angle kLowestSun = -12 * deg;

constexpr double kThickHaze = 0.4;
/// Thick haze, and with it a low sun or a bright ground: too few scenes of the calibration have
/// them together, and the product of their factors falls short.
bool is_thick(const SceneFeatures& scene) {
  return scene.aerosol_depth > kThickHaze &&
         (scene.sun_elevation < 3 * deg || scene.ground_albedo > 0.6);
}

ErrorTable read_table() {
  ErrorTable table;
  for (int part = 0; part < kErrorParts; ++part) {
    const auto& numbers = data::kErrorBounds[part];
    static_assert(std::tuple_size_v<std::remove_cvref_t<decltype(numbers)>> ==
                  kSkyParts + kFeatureNodes + 1);
    ErrorRow& row = table[part];
    const auto factors = numbers.begin() + kSkyParts;
    std::copy(numbers.begin(), factors, row.base.begin());
    std::copy(factors, factors + kFeatureNodes, row.factor.begin());
    row.margin = numbers.back();
  }
  return table;
}

}  // namespace

static_assert(data::kErrorBoundsPart == kErrorPartNames);

std::span<const Feature> scene_features() { return kFeatures; }

Angle sun_elevation_at(SkyPart part, const SceneFeatures& scene) {
  switch (part) {
    case SkyPart::aureole:
    case SkyPart::horizon_sunward:
    case SkyPart::low_sunward:
      return scene.sun_elevation + scene.dip;
    case SkyPart::horizon_away:
    case SkyPart::low_away:
      return scene.sun_elevation - scene.dip;
    case SkyPart::high:
      break;
  }
  return scene.sun_elevation;
}

std::array<double, kFeatureNodes> node_weights(const SceneFeatures& scene, SkyPart part) {
  std::array<double, kFeatureNodes> weights{};
  size_t first = 0;
  for (const Feature& feature : kFeatures) {
    const auto& nodes = feature.nodes;
    const double value = std::clamp(feature.value(scene, part), nodes.front(), nodes.back());
    size_t i = 0;
    while (i + 2 < nodes.size() && value > nodes[i + 1]) ++i;
    const double low = feature.scale(nodes[i]), high = feature.scale(nodes[i + 1]);
    const double share = (feature.scale(value) - low) / (high - low);
    weights[first + i] = 1 - share;
    weights[first + i + 1] = share;
    first += nodes.size();
  }
  return weights;
}

const ErrorTable& stored_errors() {
  static const ErrorTable table = read_table();
  return table;
}

double typical_square(const ErrorRow& row, const SceneFeatures& scene, const PartShares& shares) {
  double square = 0;
  for (int part = 0; part < kSkyParts; ++part) {
    if (shares[part] == 0) continue;
    const auto weights = node_weights(scene, SkyPart(part));
    double log_factor = 0;
    for (size_t i = 0; i < weights.size(); ++i)
      if (weights[i] > 0) log_factor += weights[i] * std::log(row.factor[i]);
    square += shares[part] * row.base[part] * row.base[part] * std::exp(2 * log_factor);
  }
  return square;
}

bool is_beyond_truth(const SceneFeatures& scene) {
  return scene.aerosol_depth > kThickHaze && scene.sun_elevation < -2 * deg;
}

bool within_calibration(const SceneFeatures& scene) {
  if (scene.sun_elevation < kLowestSun || is_thick(scene)) return false;
  for (const Feature& feature : std::span(kFeatures).subspan(1)) {
    const double value = feature.value(scene, SkyPart::high);
    if (!(value >= feature.nodes.front() && value <= feature.nodes.back())) return false;
  }
  return true;
}

}  // namespace skylapse::plan
