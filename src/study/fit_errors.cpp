#include "study/fit_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "plan/rung.h"
#include "plan/sky_model.h"

namespace skylapse::study {
namespace {

using plan::ErrorPart;
using plan::ErrorRow;
using plan::kFeatureNodes;
using plan::kSkyParts;

constexpr int kUnknowns = kSkyParts + kFeatureNodes;
/// Weight of the wish that neighbouring nodes differ alike, and that factors be near 1.
constexpr double kSmooth = 2, kNearOne = 0.1;
/// Scatter of a scene about the fit, as a share of its value: how much one scene may say.
constexpr double kScatter = 1;
constexpr int kIterations = 60, kFolds = 5, kCameras = 10;
/// Share of pictures that stay within the bound; a normal deviate that as many stay below.
constexpr double kWithin = 0.95, kNormalMargin = 1.65;
/// Margins from few scenes may be too small: with n of them they grow by the share kFewScenes / n.
constexpr double kFewScenes = 12;
/// Mean squares below this are nothing that a promise could hang on.
constexpr double kNothing = 1e-10;

using Vector = std::array<double, kUnknowns>;

struct Observation {
  Vector weight{};  // of the unknowns
  double value = 0, uncertainty = 0;
};

std::vector<Observation> observations(const std::vector<const MeasuredScene*>& scenes,
                                      ErrorPart error) {
  std::vector<Observation> all;
  for (const MeasuredScene* m : scenes) {
    for (int part = 0; part < kSkyParts; ++part) {
      const auto nodes = plan::node_weights(features_of(m->scene), plan::SkyPart(part));
      const auto& measured = m->errors.parts[size_t(error)][part];
      if (!measured) continue;
      Observation o;
      o.weight[part] = 1;
      std::copy(nodes.begin(), nodes.end(), o.weight.begin() + kSkyParts);
      o.value = std::max(measured->value, measured->uncertainty > 0 ? -1.0 : kNothing);
      o.uncertainty = measured->uncertainty;
      all.push_back(o);
    }
  }
  return all;
}

/// Solves a symmetric positive definite system by elimination.
Vector solve(std::array<Vector, kUnknowns> a, Vector b) {
  for (int i = 0; i < kUnknowns; ++i)
    for (int j = i + 1; j < kUnknowns; ++j) {
      const double factor = a[j][i] / a[i][i];
      for (int k = i; k < kUnknowns; ++k) a[j][k] -= factor * a[i][k];
      b[j] -= factor * b[i];
    }
  for (int i = kUnknowns - 1; i >= 0; --i) {
    for (int k = i + 1; k < kUnknowns; ++k) b[i] -= a[i][k] * b[k];
    b[i] /= a[i][i];
  }
  return b;
}

/// Adds weight * (c . x)^2 / 2 to be made small.
void penalise(std::array<Vector, kUnknowns>& a, const std::vector<std::pair<int, double>>& c,
              double weight) {
  for (const auto& [i, ci] : c)
    for (const auto& [j, cj] : c) a[i][j] += weight * ci * cj;
}

void add_penalties(std::array<Vector, kUnknowns>& a) {
  int first = kSkyParts;
  for (const plan::Feature& feature : plan::scene_features()) {
    const int n = int(feature.nodes.size());
    for (int i = 0; i < n; ++i) penalise(a, {{first + i, 1}}, kNearOne);
    for (int i = 0; i + 2 < n; ++i)
      penalise(a, {{first + i, 1}, {first + i + 1, -2}, {first + i + 2, 1}}, kSmooth);
    first += n;
  }
  for (int i = 0; i < kSkyParts; ++i)
    for (int j = 0; j < i; ++j) penalise(a, {{i, 1}, {j, -1}}, kNearOne);
}

/// Logarithms of the mean square's base and factors.
Vector fit(const std::vector<Observation>& all) {
  double mean = 0;
  for (const Observation& o : all) mean += o.value / double(all.size());
  Vector x{};
  std::fill(x.begin(), x.begin() + kSkyParts, std::log(std::max(mean, kNothing)));
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    std::array<Vector, kUnknowns> a{};
    Vector b{};
    for (const Observation& o : all) {
      double eta = 0;
      for (int i = 0; i < kUnknowns; ++i) eta += o.weight[i] * x[i];
      const double mu = std::max(std::exp(eta), kNothing);
      const double weight = mu * mu / (kScatter * mu * mu + o.uncertainty * o.uncertainty);
      const double target = eta + std::clamp((o.value - mu) / mu, -1.0, 2.0);
      for (int i = 0; i < kUnknowns; ++i) {
        if (o.weight[i] == 0) continue;
        b[i] += weight * o.weight[i] * target;
        for (int j = 0; j < kUnknowns; ++j) a[i][j] += weight * o.weight[i] * o.weight[j];
      }
    }
    add_penalties(a);
    for (int i = 0; i < kUnknowns; ++i) a[i][i] += 1e-9;
    const Vector next = solve(a, b);
    for (int i = 0; i < kUnknowns; ++i) x[i] += 0.5 * (next[i] - x[i]);
  }
  return x;
}

ErrorRow row_of(const Vector& x) {
  ErrorRow row;
  for (int i = 0; i < kSkyParts; ++i) row.base[i] = std::exp(x[i] / 2);
  for (int i = 0; i < kFeatureNodes; ++i) row.factor[i] = std::exp(x[kSkyParts + i] / 2);
  return row;
}

/// Pictures of a scene: the whole sky, and cameras that see some of it.
std::vector<plan::PartShares> pictures_of(const AccuracyScene& scene, uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto share = [&] { return double(random() >> 11) * 0x1p-53; };
  const Angle horizon = plan::horizon_elevation(scene.height, scene.air.planet_radius);
  const auto sun = enu_direction(0 * deg, scene.sun_elevation);
  std::vector<plan::PartShares> pictures;
  for (int i = 0; i < kCameras; ++i) {
    image::Camera camera;
    camera.width = 60, camera.height = 40;
    if (i == 0) camera.projection = image::Projection::lat_long;
    camera.field_of_view = (20 + 80 * share()) * deg;
    camera.camera_to_enu = image::look_at(360 * share() * deg, (60 * share() - 5) * deg, 0 * deg);
    if (i == 0) camera.camera_to_enu = image::Camera{}.camera_to_enu;
    pictures.push_back(plan::CameraSky(camera).shares(sun, horizon));
  }
  return pictures;
}

/// Measured over typical rms of the pictures of one scene; parts of the sky without measurement
/// do not count.
void add_ratios(const MeasuredScene& m, ErrorPart error, const ErrorRow& row,
                std::vector<double>& ratios) {
  for (plan::PartShares shares : pictures_of(m.scene, uint64_t(m.index))) {
    double square = 0;
    for (int part = 0; part < kSkyParts; ++part) {
      const auto& measured = m.errors.parts[size_t(error)][part];
      if (!measured) shares[part] = 0;
      if (measured) square += shares[part] * std::max(measured->value, 0.0);
    }
    const double typical = plan::typical_square(row, features_of(m.scene), shares);
    const double beyond = std::max(0.0, square - std::pow(plan::kNegligibleError, 2));
    if (typical > 0) ratios.push_back(std::sqrt(beyond / typical));
  }
}

double margin_of(const std::vector<const MeasuredScene*>& scenes, ErrorPart error) {
  std::vector<double> ratios;
  for (int fold = 0; fold < kFolds; ++fold) {
    std::vector<const MeasuredScene*> known;
    for (size_t i = 0; i < scenes.size(); ++i)
      if (int(i % kFolds) != fold) known.push_back(scenes[i]);
    const ErrorRow row = row_of(fit(observations(known, error)));
    for (size_t i = 0; i < scenes.size(); ++i)
      if (int(i % kFolds) == fold) add_ratios(*scenes[i], error, row, ratios);
  }
  std::sort(ratios.begin(), ratios.end());
  if (ratios.empty()) return 1;
  return std::max(1.0,
                  ratios[std::min(ratios.size() - 1, size_t(kWithin * double(ratios.size())))]);
}

}  // namespace

plan::SceneFeatures features_of(const AccuracyScene& scene) {
  return {scene.sun_elevation, -plan::horizon_elevation(scene.height, scene.air.planet_radius),
          scene.height,        scene.air.aerosol_optical_depth,
          scene.ground_albedo, scene.air.ozone_du};
}

plan::ErrorTable fit_errors(const std::vector<MeasuredScene>& scenes) {
  plan::ErrorTable table;
  for (int part = 0; part < plan::kErrorParts; ++part) {
    std::vector<const MeasuredScene*> with;
    for (const MeasuredScene& m : scenes)
      if (std::ranges::any_of(m.errors.parts[part], [](const auto& p) { return p.has_value(); }))
        with.push_back(&m);
    const auto error = ErrorPart(part);
    table[part] = row_of(fit(observations(with, error)));
    table[part].margin = (error == ErrorPart::fine ? kNormalMargin : margin_of(with, error)) *
                         (1 + kFewScenes / double(with.size()));
  }
  return table;
}

std::string table_text(const plan::ErrorTable& table, const std::string& source) {
  std::string text = fmt::format(
      "skylapse-table 1\nname: error_bounds\ntitle: Typical error of each way of computing a sky, "
      "by the part of the sky and the scene\nsource: {}\nlicence: that of skylapse\n"
      "unit: rms of the relative error of XYZ; the row path_time in microseconds; factors are "
      "pure\n"
      "note: base by part of the sky, factors at the nodes of each feature, the margin of a "
      "bound\n",
      source);
  text += "axis: part =";
  for (const auto name : plan::kErrorPartNames) text += fmt::format(" {}", name);
  text += "\ncolumns:";
  for (const auto name : plan::kSkyPartNames) text += fmt::format(" {}", name);
  for (const plan::Feature& feature : plan::scene_features())
    for (const double node : feature.nodes) text += fmt::format(" {}={:g}", feature.name, node);
  text += " margin\nrows:\n";
  for (int part = 0; part < plan::kErrorParts; ++part) {
    text += fmt::format("{} |", plan::kErrorPartNames[part]);
    for (const double base : table[part].base) text += fmt::format(" {:.4g}", base);
    for (const double factor : table[part].factor) text += fmt::format(" {:.3g}", factor);
    text += fmt::format(" {:.3g}\n", table[part].margin);
  }
  return text;
}

}  // namespace skylapse::study
