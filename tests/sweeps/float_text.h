#pragma once
// shaders/atmosphere compiled in float, as GLSL reads it: what rounding does to each function, free
// of any driver. (Drivers may add errors of their own in exp, pow and the roots; tests/parity
// measures those.)
#include <glm/glm.hpp>
#include <memory>
#include <vector>

namespace skylapse::sweeps {

class FloatText {
 public:
  /// The numbers of an AirParameters and of a table of columns, rounded here; the coefficients of
  /// one group of four bands: Rayleigh, aerosol and ozone.
  FloatText(const double* air, size_t air_count, const std::vector<glm::dvec3>& columns,
            const glm::dvec4& rayleigh, const glm::dvec4& aerosol, const glm::dvec4& ozone);
  ~FloatText();
  /// How many numbers an AirParameters holds.
  static size_t air_count();

  [[nodiscard]] float rayleigh_phase(float nu) const;
  [[nodiscard]] float aerosol_phase(float nu) const;
  [[nodiscard]] glm::vec3 densities(float h) const;
  [[nodiscard]] float height_along(float h, float mu, float t) const;
  [[nodiscard]] float horizon_mu(float h) const;
  [[nodiscard]] float distance_to_top(float h, float mu) const;
  [[nodiscard]] float distance_to_ground(float h, float mu) const;
  [[nodiscard]] glm::vec2 shadow_cuts(float h, float mu, float mu_s, float nu) const;
  [[nodiscard]] glm::vec2 grazing_cuts(float h, float mu, float mu_s, float nu, float level) const;
  [[nodiscard]] glm::vec2 columns_texel(float h, float mu) const;
  [[nodiscard]] float height_coordinate(float h) const;
  [[nodiscard]] float zenith_coordinate(float mu) const;
  [[nodiscard]] float sun_row_of(float mu_s) const;
  [[nodiscard]] float azimuth_coordinate(float mu, float mu_s, float nu) const;
  [[nodiscard]] float sun_visibility(float h, float mu_s) const;
  [[nodiscard]] float sun_mean_cosine(float mu_s) const;
  [[nodiscard]] float cosine_to_sun(float mu, float mu_s, float azimuth) const;
  /// To the top, by the table and the layers.
  [[nodiscard]] glm::vec4 transmittance(float h, float mu) const;

 private:
  class Text;
  std::unique_ptr<Text> text_;
};

}  // namespace skylapse::sweeps
