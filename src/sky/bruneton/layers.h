#pragma once
// Layers aloft: straight pieces of a profile that begin above the ground, as a volcano's veil. A
// grazing ray is in them for hundreds of kilometres, so a bilinear table cannot hold their columns;
// they are integrated where they are needed, and tables get nodes at their edges.
#include <vector>

#include "sky/bruneton/settings.h"

namespace skylapse::sky::bruneton {

enum class Component { rayleigh, aerosol, ozone };

/// Density slope * h + constant >= 0 on bottom <= h < top.
struct Layer {
  Component component;
  double bottom_km, top_km, slope_per_km, constant;

  [[nodiscard]] double at(double height_km) const { return slope_per_km * height_km + constant; }
};

/// Most layers that are integrated; more stay in the table.
inline constexpr int kMaxLayers = 8;

/// Ascending. Aerosol's always; ozone's where one is deeper than 0.1 in some band (the Earth's is
/// 0.05, broad enough for the table). Rayleigh's never: the pieces of a standard atmosphere join
/// smoothly.
std::vector<Layer> layers_aloft(const atmosphere::Medium& medium);

/// The medium without those.
atmosphere::Medium without_layers(const atmosphere::Medium& medium);

/// The heights at which a layer begins or ends, ascending.
std::vector<double> layer_edges(const atmosphere::Medium& medium);

/// From this height on, nodes of the tables are even in (h / H)^(1 / kHeightExponent).
struct HeightKnot {
  double share;  // (h / H)^(1 / kHeightExponent)
  int node;
};
/// From the ground's, node 0, to the top's, node settings.heights - 1. Where aerosol lies aloft
/// there is one at each edge and several where it sets in: light scattered by air and by aerosol
/// mixes within the first hundredths of a tent. Without (or with too few heights) just the two.
std::vector<HeightKnot> height_knots(const atmosphere::Medium& medium, const Settings& settings);

/// How many nodes the knots between ground and top take.
int layer_nodes(const atmosphere::Medium& medium);

/// Most knots: 8 layers of 6, ground and top.
inline constexpr int kMaxHeightKnots = 50;

}  // namespace skylapse::sky::bruneton
