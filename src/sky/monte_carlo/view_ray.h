#pragma once
// All paths along one view ray, which share a table of where their first collision is drawn.
#include <optional>

#include "sky/monte_carlo/first_collision.h"
#include "sky/monte_carlo/reference.h"

namespace skylapse::sky::monte_carlo {

glm::dvec3 direction_of(Angle zenith, Angle azimuth);

/// The sun that one path sees: its centre, or for SunVisibility::disc a random point of the disc.
glm::dvec3 sun_of_path(const Optics& optics, const glm::dvec3& centre, SunVisibility rule,
                       PathRandom& random);

/// The rules that the options mean for a path.
PathRules rules_of(const ReferenceOptions& options);

/// Where a view ray of an observer at `height` starts to matter: there, or where it enters the air
/// from above; nothing if it misses the air. `direction` with the observer's zenith along z.
std::optional<Place> entry(const Shells& shells, double height, const glm::dvec3& direction);

class ViewRay {
 public:
  /// `optics` and `options` must outlive it.
  ViewRay(const Optics& optics, const Place& start, const glm::dvec3& direction,
          const glm::dvec3& to_sun, const ReferenceOptions& options);

  [[nodiscard]] const PerBand& transmittance() const { return first_.through(); }
  /// No path can bring light.
  [[nodiscard]] bool dark() const { return !first_.possible() && chance_of_ground_ == 0; }

  /// Traces path number `index`.
  void operator()(Path& path, long index, PathRandom& random, PathRadiance& found) const;

 private:
  const Optics& optics_;
  Place start_;
  glm::dvec3 direction_, to_sun_;
  const ReferenceOptions& options_;
  FirstCollision first_;
  /// Sunlight off the ground at the ray's end, the same for all paths and therefore not drawn.
  PerBand off_ground_{};
  double chance_of_ground_ = 0;  // of a path that goes on from there
};

}  // namespace skylapse::sky::monte_carlo
