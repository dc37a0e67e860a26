#include "sky/bruneton/layers.h"

#include <algorithm>
#include <cmath>

#include "sky/bruneton/directions.h"

namespace skylapse::sky::bruneton {
namespace {

using atmosphere::DensityProfile;
using atmosphere::DensityTerm;

constexpr double kOzoneDepth = 0.1;

bool is_aloft(const DensityTerm& term) {
  return term.bottom_km > 0 && term.amplitude == 0 && term.top_km > term.bottom_km;
}

bool ozone_is_deep(const atmosphere::Medium& medium) {
  const double column = medium.ozone.vertical_column_km(medium.top_height_km);
  return std::any_of(medium.bands.begin(), medium.bands.end(), [&](const auto& band) {
    return band.ozone_absorption_per_km * column > kOzoneDepth;
  });
}

/// The part of a term that is above 0 and in the air.
Layer layer_of(Component component, const DensityTerm& term, double top_km) {
  Layer layer{component, term.bottom_km, std::min(term.top_km, top_km), term.slope_per_km,
              term.constant};
  if (layer.slope_per_km != 0) {
    const double zero = -layer.constant / layer.slope_per_km;
    double& end = layer.slope_per_km > 0 ? layer.bottom_km : layer.top_km;
    end = layer.slope_per_km > 0 ? std::max(end, zero) : std::min(end, zero);
  } else if (layer.constant <= 0) {
    layer.top_km = layer.bottom_km;
  }
  return layer;
}

void add_layers(Component component, const DensityProfile& profile, double top_km,
                std::vector<Layer>& layers) {
  for (const DensityTerm& term : profile.terms)
    if (is_aloft(term)) {
      const Layer layer = layer_of(component, term, top_km);
      if (layer.bottom_km < layer.top_km) layers.push_back(layer);
    }
}

bool all_fit(const std::vector<Layer>& layers) { return int(layers.size()) <= kMaxLayers; }

/// Shares of a layer at which nodes stand: close together where it sets in.
std::vector<double> places_in(const Layer& layer) {
  constexpr double kNothing = 1e-6;  // of the density at the other end
  const double low = layer.at(layer.bottom_km), high = layer.at(layer.top_km);
  if (low < kNothing * high) return {0, 0.02, 0.08, 0.25, 0.6, 1};
  if (high < kNothing * low) return {0, 0.4, 0.75, 0.92, 0.98, 1};
  return {-0.02, 0, 0.02, 0.5, 1, 1.02};
}

std::vector<double> knot_heights(const atmosphere::Medium& medium) {
  std::vector<double> heights;
  for (const Layer& layer : layers_aloft(medium))
    if (layer.component == Component::aerosol)
      for (const double place : places_in(layer))
        heights.push_back(layer.bottom_km + place * (layer.top_km - layer.bottom_km));
  std::sort(heights.begin(), heights.end());
  const double H = medium.top_height_km, least = 1e-4 * H;
  std::erase_if(heights, [&](double h) { return h < least || h > H - least; });
  const auto same = [&](double a, double b) { return b - a < 1e-9 * H; };
  heights.erase(std::unique(heights.begin(), heights.end(), same), heights.end());
  return heights;
}

}  // namespace

std::vector<Layer> layers_aloft(const atmosphere::Medium& medium) {
  std::vector<Layer> layers;
  add_layers(Component::aerosol, medium.aerosol, medium.top_height_km, layers);
  if (ozone_is_deep(medium)) {
    std::vector<Layer> more = layers;
    add_layers(Component::ozone, medium.ozone, medium.top_height_km, more);
    if (all_fit(more)) layers = more;
  }
  if (!all_fit(layers)) layers.clear();
  std::sort(layers.begin(), layers.end(),
            [](const Layer& a, const Layer& b) { return a.bottom_km < b.bottom_km; });
  return layers;
}

atmosphere::Medium without_layers(const atmosphere::Medium& medium) {
  atmosphere::Medium rest = medium;
  for (const Layer& layer : layers_aloft(medium))
    std::erase_if((layer.component == Component::aerosol ? rest.aerosol : rest.ozone).terms,
                  is_aloft);
  return rest;
}

std::vector<double> layer_edges(const atmosphere::Medium& medium) {
  std::vector<double> edges;
  for (const Layer& layer : layers_aloft(medium)) {
    edges.push_back(layer.bottom_km);
    edges.push_back(layer.top_km);
  }
  std::sort(edges.begin(), edges.end());
  const auto same = [](double a, double b) { return b - a < 1e-9; };
  edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
  return edges;
}

int layer_nodes(const atmosphere::Medium& medium) { return int(knot_heights(medium).size()); }

std::vector<HeightKnot> height_knots(const atmosphere::Medium& medium, const Settings& settings) {
  const double H = medium.top_height_km;
  std::vector<double> shares{0};
  for (const double h : knot_heights(medium))
    shares.push_back(std::pow(h / H, 1 / kHeightExponent));
  shares.push_back(1);
  // One interval each; the rest go where they are widest.
  const int gaps = int(shares.size()) - 1;
  if (settings.heights - 1 < gaps) return {{0, 0}, {1, settings.heights - 1}};
  std::vector<int> intervals(gaps, 1);
  const auto width = [&](int i) { return (shares[i + 1] - shares[i]) / intervals[i]; };
  for (int spare = settings.heights - 1 - gaps; spare > 0; --spare) {
    int widest = 0;
    for (int i = 1; i < gaps; ++i)
      if (width(i) > width(widest)) widest = i;
    ++intervals[widest];
  }
  std::vector<HeightKnot> knots{{0, 0}};
  for (int i = 0; i < gaps; ++i) knots.push_back({shares[i + 1], knots[i].node + intervals[i]});
  return knots;
}

}  // namespace skylapse::sky::bruneton
