#pragma once
// shaders/atmosphere compiled in double: the physics of the CPU twin, and of the host's lists.
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <numbers>
#include <vector>

#include "sky/atmosphere/medium.h"
#include "sky/bruneton/layers.h"
#include "sky/bruneton/settings.h"
#include "sky/bruneton/tables.h"

namespace skylapse::sky::bruneton {

/// What the text takes from its host (shaders/atmosphere/README.md), and its structs.
namespace text {

using Real = double;
using vec2 = glm::dvec2;
using vec3 = glm::dvec3;
using vec4 = glm::dvec4;
using glm::acos;
using glm::asinh;
using glm::clamp;
using glm::cos;
using glm::exp;
using glm::floor;
using glm::max;
using glm::min;
using glm::mix;
using glm::pow;
using glm::sin;
using glm::smoothstep;
using glm::sqrt;
inline double abs(double x) { return x < 0 ? -x : x; }

inline constexpr double PI = std::numbers::pi;
inline constexpr int MAX_DENSITY_TERMS = atmosphere::kMaxDensityTerms;
inline constexpr int MAX_CUTS = 16;
inline constexpr int MAX_LAYERS = kMaxLayers;
inline constexpr int MAX_HEIGHT_KNOTS = kMaxHeightKnots;

#define LAYERED 1
#include "atmosphere/parameters.glsl"

static_assert(sizeof(AirParameters) % (4 * sizeof(Real)) == 0 &&
                  sizeof(Ray) % (4 * sizeof(Real)) == 0,
              "whole groups of four: the layout that GLSL gives them");

}  // namespace text

/// Nodes of the table of columns (columns.h): heights and distances to the top.
inline constexpr int kColumnHeights = 64, kColumnDistances = 256;

/// The text's view of a medium and the coordinates of tables with these settings.
text::AirParameters air_parameters(const atmosphere::Medium& medium, const Settings& settings);

/// The coefficients in groups of four bands; spare channels of the last repeat the last band.
std::vector<text::BandGroup> band_groups(const atmosphere::Medium& medium);

/// Factor of aerosol_phase (phase.glsl) at a shape parameter.
double aerosol_phase_norm(double g);

/// Gauss-Legendre nodes in (0, 1), ascending, and weights that sum to 1.
std::vector<glm::dvec2> gauss_nodes(int count);

/// Everything that Physics reads. Tables may be null where no table is looked up, columns too.
struct PhysicsData {
  text::AirParameters air;
  std::vector<text::BandGroup> groups;
  std::vector<glm::dvec2> gauss;        // of the march; air.march_samples is their number
  const glm::dvec3* columns = nullptr;  // Columns::nodes(), whose owner must outlive this
  const Tables* tables = nullptr;
};

/// Data for marches of `samples` Gauss nodes a piece.
PhysicsData physics_data(const atmosphere::Medium& medium, const Settings& settings, int samples);

namespace text {

/// The text over `GroupCount` groups of bands from `first_group` on. Keeps a reference to `data`.
template <int GroupCount>
class Physics {
 public:
  static constexpr int GROUPS = GroupCount;
  explicit Physics(const PhysicsData& data, int first_group = 0)
      : air(data.air), data_(data), first_(first_group) {}

  const AirParameters& air;
  [[nodiscard]] const BandGroup& band_group(int g) const { return data_.groups[first_ + g]; }
  [[nodiscard]] vec2 fetch_gauss(int i) const { return data_.gauss[i]; }
  [[nodiscard]] vec3 fetch_columns(vec2 texel) const;
  [[nodiscard]] vec4 fetch_source(int g, vec3 texel) const;
  [[nodiscard]] vec4 fetch_ground(int g, Real row) const;

#include "atmosphere/atmosphere.glsl"
#undef LAYERED

 private:
  const PhysicsData& data_;
  int first_;
};

}  // namespace text

/// The text for what depends on no band.
using Geometry = text::Physics<1>;

}  // namespace skylapse::sky::bruneton

#include "sky/bruneton/physics_fetch.h"
