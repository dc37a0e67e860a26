#include "sky/monte_carlo/view_ray.h"

#include <algorithm>
#include <cmath>

namespace skylapse::sky::monte_carlo {

glm::dvec3 direction_of(Angle zenith, Angle azimuth) {
  return {sin(zenith) * cos(azimuth), sin(zenith) * sin(azimuth), cos(zenith)};
}

glm::dvec3 sun_of_path(const Optics& optics, const glm::dvec3& centre, SunVisibility rule,
                       PathRandom& random) {
  if (rule == SunVisibility::smooth_step) return centre;
  const double sine = std::sin(optics.sun_radius) * std::sqrt(random.uniform());
  return turned(centre, std::sqrt(1 - sine * sine), random);
}

PathRules rules_of(const ReferenceOptions& options) {
  return {.min_order = options.min_order, .max_order = options.max_order, .sun = options.sun};
}

std::optional<Place> entry(const Shells& shells, double height, const glm::dvec3& direction) {
  const Place observer{height, {0, 0, 1}};
  if (height <= shells.top()) return observer;
  const double rm = (shells.radius() + height) * direction.z;
  const double above = (height - shells.top()) * (2 * shells.radius() + height + shells.top());
  const double root = rm * rm - above;
  if (rm >= 0 || root <= 0) return std::nullopt;
  Place place = observer.moved(shells.radius(), direction, above / (-rm + std::sqrt(root)));
  place.height = shells.top();
  return place;
}

ViewRay::ViewRay(const Optics& optics, const Place& start, const glm::dvec3& direction,
                 const glm::dvec3& to_sun, const ReferenceOptions& options)
    : optics_(optics),
      start_(start),
      direction_(direction),
      to_sun_(to_sun),
      options_(options),
      first_(optics, start, direction, to_sun, options.min_order) {
  if (options.ground && first_.hits_ground()) {
    if (options.min_order <= 1) off_ground_ = first_.sunlit_ground(to_sun);
    double brightest = 0;
    for (int b = 0; b < optics.bands; ++b)
      brightest = std::max(brightest, optics.albedo[b] * first_.through()[b]);
    chance_of_ground_ = brightest > 0 ? std::clamp(brightest, 0.1, 0.6) : 0;
    if (!first_.possible() && brightest > 0) chance_of_ground_ = 1;
  }
}

void ViewRay::operator()(Path& path, long index, PathRandom& random, PathRadiance& found) const {
  const glm::dvec3 sun = sun_of_path(optics_, to_sun_, options_.sun, random);
  path.begin(start_, direction_, sun, int(index % optics_.bands), random, found);
  bool alive = false;
  if (chance_of_ground_ > 0 && random.uniform() < chance_of_ground_) {
    path.scale(first_.through());
    path.scale(1 / chance_of_ground_);
    alive = path.reflect_at(first_.ground(), Path::Sunlight::known);
  } else if (first_.possible()) {
    PerBand factor;
    const Place place = first_.sample(random, factor);
    path.scale(factor);
    path.scale(1 / (1 - chance_of_ground_));
    alive = path.scatter_at(place);
  }
  while (alive) alive = path.travel();
  if (chance_of_ground_ > 0) found.add_first_order(off_ground_, optics_.bands);
}

}  // namespace skylapse::sky::monte_carlo
