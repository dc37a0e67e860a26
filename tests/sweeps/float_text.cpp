// Compiled with -fsingle-precision-constant: includes nothing that has double constants of its own.
#include "sweeps/float_text.h"

#include <algorithm>
#include <cassert>

namespace skylapse::sweeps {
namespace {

using Real = float;
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
using glm::vec2;
using glm::vec3;
using glm::vec4;
inline float abs(float x) { return x < 0 ? -x : x; }

// physics.h gives the double text the same; text_sweeps.cpp checks that the structs agree.
constexpr float PI = 3.14159265358979f;
constexpr int MAX_DENSITY_TERMS = 8, MAX_CUTS = 16, MAX_LAYERS = 8, MAX_HEIGHT_KNOTS = 50;
constexpr int kHeights = 64, kDistances = 256;

#define LAYERED 1
#include "atmosphere/parameters.glsl"

}  // namespace

class FloatText::Text {
 public:
  static constexpr int GROUPS = 1;
  AirParameters air;
  BandGroup band;
  std::vector<vec3> columns;

  [[nodiscard]] const BandGroup& band_group(int) const { return band; }
  [[nodiscard]] vec2 fetch_gauss(int) const { return vec2(0.5f, 1.0f); }
  [[nodiscard]] vec4 fetch_source(int, vec3) const { return vec4(0); }
  [[nodiscard]] vec4 fetch_ground(int, Real) const { return vec4(0); }
  [[nodiscard]] vec3 fetch_columns(vec2 texel) const {
    const int x = std::clamp(int(texel.x), 0, kHeights - 2);
    const int y = std::clamp(int(texel.y), 0, kDistances - 2);
    const float u = texel.x - float(x), v = texel.y - float(y);
    const vec3* at = columns.data() + x * kDistances + y;
    return mix(mix(at[0], at[1], v), mix(at[kDistances], at[kDistances + 1], v), u);
  }

#include "atmosphere/atmosphere.glsl"
};

FloatText::FloatText(const double* air, size_t count, const std::vector<glm::dvec3>& columns,
                     const glm::dvec4& rayleigh, const glm::dvec4& aerosol, const glm::dvec4& ozone)
    : text_(std::make_unique<Text>()) {
  assert(count == air_count());
  auto* numbers = reinterpret_cast<float*>(&text_->air);
  std::transform(air, air + count, numbers, [](double x) { return float(x); });
  for (const glm::dvec3& node : columns) text_->columns.emplace_back(node);
  text_->band = {};
  text_->band.rayleigh_scattering = rayleigh;
  text_->band.aerosol_extinction = aerosol;
  text_->band.ozone_absorption = ozone;
}

FloatText::~FloatText() = default;

size_t FloatText::air_count() { return sizeof(AirParameters) / sizeof(float); }

float FloatText::rayleigh_phase(float nu) const { return text_->rayleigh_phase(nu); }
float FloatText::aerosol_phase(float nu) const { return text_->aerosol_phase(nu); }
glm::vec3 FloatText::densities(float h) const { return text_->densities(h); }
float FloatText::height_along(float h, float mu, float t) const {
  return text_->height_along(h, mu, t);
}
float FloatText::horizon_mu(float h) const { return text_->horizon_mu(h); }
float FloatText::distance_to_top(float h, float mu) const { return text_->distance_to_top(h, mu); }
float FloatText::distance_to_ground(float h, float mu) const {
  return text_->distance_to_ground(h, mu);
}
glm::vec2 FloatText::shadow_cuts(float h, float mu, float mu_s, float nu) const {
  return text_->shadow_cuts(h, mu, mu_s, nu);
}
glm::vec2 FloatText::grazing_cuts(float h, float mu, float mu_s, float nu, float level) const {
  return text_->grazing_cuts(h, mu, mu_s, nu, level);
}
glm::vec2 FloatText::columns_texel(float h, float mu) const { return text_->columns_texel(h, mu); }
float FloatText::height_coordinate(float h) const { return text_->height_coordinate(h); }
float FloatText::zenith_coordinate(float mu) const { return text_->zenith_coordinate(mu); }
float FloatText::sun_row_of(float mu_s) const { return text_->sun_row_of(mu_s); }
float FloatText::azimuth_coordinate(float mu, float mu_s, float nu) const {
  return text_->azimuth_coordinate(mu, mu_s, nu);
}
float FloatText::sun_visibility(float h, float mu_s) const {
  return text_->sun_visibility(h, mu_s);
}
float FloatText::sun_mean_cosine(float mu_s) const { return text_->sun_mean_cosine(mu_s); }
float FloatText::cosine_to_sun(float mu, float mu_s, float azimuth) const {
  return text_->cosine_to_sun(mu, mu_s, azimuth);
}
glm::vec4 FloatText::transmittance(float h, float mu) const {
  return glm::exp(-text_->optical_depth(text_->band, text_->columns_to_top(h, mu)));
}

}  // namespace skylapse::sweeps
