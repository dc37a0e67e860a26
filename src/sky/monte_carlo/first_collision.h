#pragma once
// Where the first collision of all paths along one view ray is drawn: a table of the ray's cells,
// made once, with most draws where the sun lights the ray, and the rest where light is to be
// expected and where the air is dense.
#include "sky/monte_carlo/path.h"

namespace skylapse::sky::monte_carlo {

class FirstCollision {
 public:
  /// `place` within the air; `min_order` as in PathRules.
  FirstCollision(const Optics& optics, const Place& place, const glm::dvec3& direction,
                 const glm::dvec3& to_sun, int min_order);

  [[nodiscard]] bool possible() const { return !cells_.empty(); }
  [[nodiscard]] bool hits_ground() const { return trace_.hits_ground; }
  [[nodiscard]] Place ground() const;
  /// Sunlight that the ground at the ray's end reflects into it, dimmed on the way.
  [[nodiscard]] PerBand sunlit_ground(const glm::dvec3& to_sun) const;
  /// Transmittance along the whole ray.
  [[nodiscard]] const PerBand& through() const { return through_; }

  /// A collision. `factor`: transmittance up to it over the density of drawing it [km].
  Place sample(PathRandom& random, PerBand& factor) const;

 private:
  void weigh(const glm::dvec3& to_sun, int min_order);

  const Optics& optics_;
  Place place_;
  glm::dvec3 direction_;
  RayParabola ray_;
  Trace trace_;
  PerBand through_;
  RayCells cells_;
};

}  // namespace skylapse::sky::monte_carlo
