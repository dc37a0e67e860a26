#include "study/accuracy_scene.h"

#include <cmath>
#include <random>

namespace skylapse::study {
namespace {

/// The same numbers everywhere: the distributions of the standard library differ.
class Draw {
 public:
  Draw(uint64_t seed, int index) : random_(seed * 1'000'003 + uint64_t(index)) {
    random_.discard(16);
  }
  double share() { return double(random_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * share(); }

 private:
  std::mt19937_64 random_;
};

double sun_elevation_deg(Draw& draw) {
  const double kind = draw.share();
  if (kind < 0.35) return draw.between(-12, 0);
  if (kind < 0.6) return draw.between(0, 12);
  return draw.between(12, 80);
}

double height_km(Draw& draw) {
  const double kind = draw.share(), place = draw.share();
  if (kind < 0.15) return 0;
  if (kind < 0.45) return place;
  if (kind < 0.88) return 1 + 11 * place;
  return kind < 0.94 ? 40 : 400;
}

double aerosol_depth(Draw& draw) {
  const double kind = draw.share(), place = draw.share();
  if (kind < 0.05) return 0;
  if (kind < 0.75) return 0.02 * std::pow(25, place);
  return 0.4 + 1.1 * place;
}

}  // namespace

AccuracyScene draw_scene(uint64_t seed, int index) {
  Draw draw(seed, index);
  AccuracyScene scene;
  scene.sun_elevation = sun_elevation_deg(draw) * deg;
  scene.height = height_km(draw) * km;
  scene.air.aerosol_optical_depth = aerosol_depth(draw);
  scene.ground_albedo = draw.between(0, 0.9);
  scene.air.ground_albedo = sky::atmosphere::constant_spectrum(scene.ground_albedo);
  scene.air.ozone_du = draw.between(200, 450);
  if (draw.share() < 0.5) {
    scene.air.aerosol_g = draw.between(0.55, 0.85);
    scene.air.aerosol_single_scattering_albedo = draw.between(0.8, 1);
    scene.air.angstrom_exponent = draw.between(0.3, 2);
  }
  return scene;
}

}  // namespace skylapse::study
