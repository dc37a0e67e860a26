#pragma once
// Cameras and a sun for the tests of the sun disc.
#include <cmath>
#include <string>
#include <vector>

#include "sky/sun_disc.h"

namespace skylapse::sky {

inline const Angle kTestRadius = 0.2666 * deg;

/// Limb-darkened, reddened towards the horizon: steeper across the disc than a real sun is.
inline glm::dvec3 test_radiance(Angle view_elevation, double limb_m) {
  const double e = std::max(0.0, view_elevation.in(deg));
  const double air_mass = 1 / (std::sin(e * 0.0174533) + 0.15 * std::pow(e + 3.885, -1.253));
  return (0.4 + 0.6 * limb_m) * glm::dvec3{1e7 * std::exp(-0.1 * air_mass),
                                           8e6 * std::exp(-0.15 * air_mass),
                                           6e6 * std::exp(-0.3 * air_mass)};
}

inline SunDisc test_sun(Angle azimuth, Angle elevation) {
  return {enu_direction(azimuth, elevation), kTestRadius, test_radiance};
}

struct TestCamera {
  std::string name;
  image::Camera camera;
  bool fisheye = false;
};

/// Cameras `width` pixels wide of every projection that see the whole disc at this place.
inline std::vector<TestCamera> cameras_around(int width, Angle azimuth, Angle elevation) {
  using enum image::Projection;
  using image::CubeLayout;
  using image::look_at;
  const glm::dmat3 north = look_at({}, {}, {}), heading = look_at(20 * deg, {}, {});
  const glm::dmat3 zenith = look_at(180 * deg, 90 * deg, {});
  const glm::dmat3 beside = look_at(azimuth + 4 * deg, elevation + 2 * deg, 7 * deg);
  // A mirror ball squeezes what it hides to its rim: there the sun is not.
  const glm::dmat3 away = look_at(azimuth + 130 * deg, 10 * deg, 7 * deg);
  const int w = width, face = width / 4;
  const auto strip = CubeLayout::vertical_strip;
  return {
      {"lat-long", {lat_long, w, w / 2, {}, strip, north}},
      {"cube strip", {cube, face, 6 * face, {}, strip, heading}},
      {"cube cross", {cube, 4 * face, 3 * face, {}, CubeLayout::cross, north}},
      {"perspective 75", {perspective, w, w * 9 / 16, 75 * deg, strip, beside}},
      {"perspective 30", {perspective, w, w * 9 / 16, 30 * deg, strip, beside}},
      {"equidistant", {fisheye_equidistant, w, w, 180 * deg, strip, zenith}, true},
      {"equisolid", {fisheye_equisolid, w, w, 180 * deg, strip, zenith}, true},
      {"stereographic", {fisheye_stereographic, w, w, 180 * deg, strip, zenith}, true},
      {"cube vertical cross", {cube, 3 * face, 4 * face, {}, CubeLayout::vertical_cross, north}},
      {"octahedral", {octahedral, w, w, {}, strip, north}},
      {"octahedral odd", {octahedral, w - 1, w - 1, {}, strip, heading}},
      {"mirror ball", {mirror_ball, w, w, {}, strip, away}, true},
  };
}

}  // namespace skylapse::sky
