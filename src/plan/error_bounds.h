#pragma once
// Bounds on the error of each way of computing the sky, as a function of the scene: calibrated
// against the path tracer (data/accuracy) and looked up here.
#include <array>
#include <span>
#include <vector>

#include "core/quantity.h"
#include "plan/error_parts.h"
#include "plan/sky_parts.h"

namespace skylapse::plan {

/// What errors depend on.
struct SceneFeatures {
  Angle sun_elevation;  // over the horizontal
  Angle dip;            // of the camera's horizon below it
  Length height;        // of the camera
  double aerosol_depth = 0;
  double ground_albedo = 0;
  double ozone_du = 0;
};

/// Elevation of the sun where the light of a part of the sky comes from: a camera far above the
/// ground sees air over places where the sun stands higher, towards it, and lower, away from it.
Angle sun_elevation_at(SkyPart part, const SceneFeatures& scene);

/// A feature as the bounds know it: a factor at nodes, whose logarithm is linear in between along
/// `scale`; beyond its ends it stays.
struct Feature {
  std::string_view name;
  std::span<const double> nodes;
  double (*value)(const SceneFeatures&, SkyPart);
  double (*scale)(double);
};
/// Sun, height, haze, ground, ozone.
std::span<const Feature> scene_features();
/// Nodes of all features together.
inline constexpr int kFeatureNodes = 28;

/// Weights of all nodes for a part of a scene's sky, 1 in sum for each feature.
std::array<double, kFeatureNodes> node_weights(const SceneFeatures& scene, SkyPart part);

/// One part of the error: typical rms is base[sky part] times the product of the factors of the
/// scene's features; 1 picture in 20 has more than `margin` times that.
struct ErrorRow {
  std::array<double, kSkyParts> base{};
  std::array<double, kFeatureNodes> factor{};
  double margin = 1;
};
using ErrorTable = std::array<ErrorRow, kErrorParts>;

/// The stored table, data/accuracy/error_bounds.table.
const ErrorTable& stored_errors();

/// Typical mean square of a part of the error over a picture whose sky is shared out so.
double typical_square(const ErrorRow& row, const SceneFeatures& scene, const PartShares& shares);

/// Whether nothing can be promised: thick haze in twilight, where the path tracer itself does not
/// settle with the paths of a calibration, so that no error of tables is known.
bool is_beyond_truth(const SceneFeatures& scene);

/// Whether the scene lies where the table was measured: the nearest of its nodes stand for others.
bool within_calibration(const SceneFeatures& scene);

}  // namespace skylapse::plan
