#pragma once
// One backward path: from the observer against the light, vertex by vertex, gathering sunlight at
// each. All bands travel on the path of one of them, the hero; the balance heuristic over all bands
// (Wilkie, Nawaz, Droske, Weidlich & Hanika 2014, "Hero wavelength spectral sampling") keeps each
// of them unbiased.
#include <glm/glm.hpp>

#include "sky/monte_carlo/optics.h"
#include "sky/monte_carlo/ray_cells.h"

namespace skylapse::sky::monte_carlo {

/// Where a path is. Heights beside unit vectors: near the ground a radius has lost the digits.
struct Place {
  double height = 0;
  glm::dvec3 up{0, 0, 1};

  /// The place `distance` further along `direction`, not below the ground.
  [[nodiscard]] Place moved(double radius, const glm::dvec3& direction, double distance) const;
};

/// `axis` turned by the angle of cosine `nu`, at a uniform azimuth.
glm::dvec3 turned(const glm::dvec3& axis, double nu, PathRandom& random);

/// What one path found, per band: light scattered once, up to four times, and in all; of each the
/// orders that the rules let it gather.
struct PathRadiance {
  PerBand order1, up_to_order4, all;
  void add_first_order(const PerBand& light, int bands) {
    for (int b = 0; b < bands; ++b)
      order1[b] += light[b], up_to_order4[b] += light[b], all[b] += light[b];
  }
};

struct PathRules {
  int min_order = 1;  // events before this one gather nothing
  int max_order = 0;  // scattering events and ground bounces; 0: no limit
  SunVisibility sun = SunVisibility::smooth_step;
  /// Paths whose weight fell below this share of the weight after their first event are ended by
  /// chance, the others made heavier; 0 ends none (then max_order must be set).
  double roulette_below = 1;
  /// Where the sun is low, distances lead to where light is to be expected.
  bool guide = true;
};

/// The path being traced, with its scratch; one a thread. `optics` must outlive it.
class Path {
 public:
  Path(const Optics& optics, const PathRules& rules) : optics_(optics), rules_(rules) {}

  /// Starts at `place` along `direction` with weight 1 in each band; `result` is cleared.
  void begin(const Place& place, const glm::dvec3& direction, const glm::dvec3& to_sun, int hero,
             PathRandom& random, PathRadiance& result);
  void scale(const PerBand& factor);
  void scale(double factor);

  /// Meets the air here: gathers sunlight and picks a way on. False: the path is over.
  bool scatter_at(const Place& place);
  /// Meets the ground here; likewise. Sunlight that is known is not gathered.
  enum class Sunlight { unknown, known };
  bool reflect_at(const Place& place, Sunlight sunlight = Sunlight::unknown);
  /// Goes to the next event and through it; likewise.
  bool travel();

 private:
  /// Sampling towards where light is to be expected, beside the phase function.
  struct Lobe {
    double chance = 0;
    glm::dvec3 axis{};
    const AerosolPhase* shape = nullptr;
  };
  [[nodiscard]] Lobe lobe_at(const Place& place) const;
  /// A place on the traced way and the columns up to it.
  struct Meeting {
    double distance = 0;
    Columns before;
  };
  [[nodiscard]] Meeting at_depth(double depth) const;
  [[nodiscard]] double make_guide();
  [[nodiscard]] double expected_light(const Place& place) const;
  bool collide(const Meeting& at, bool forced, double chance_of_guide);
  void gather(int band, double value);
  [[nodiscard]] bool gathers() const { return order_ >= rules_.min_order; }
  bool normalise();
  bool go_on();

  const Optics& optics_;
  PathRules rules_;
  Place place_;
  glm::dvec3 direction_{}, to_sun_{};
  int hero_ = 0, order_ = 0;
  PathRandom* random_ = nullptr;
  PathRadiance* result_ = nullptr;
  /// weight_: what the bands carry, over the mean probability density with which the bands would
  /// have made this path. density_: those densities, in units of their mean.
  PerBand weight_{}, density_{}, weight_at_first_{};
  double light_at_first_ = 1;
  PerBand scratch_{}, rayleigh_{}, aerosol_{};
  Trace trace_;
  RayCells guide_;
  SunView sun_;
};

}  // namespace skylapse::sky::monte_carlo
