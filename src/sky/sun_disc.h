#pragma once
// The sun's disc in an image, with its energy kept: whatever the projection, the size and the
// place within a pixel, the sum of radiance times solid angle over the pixels is the disc's flux.
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "core/frames.h"
#include "image/camera/camera.h"
#include "image/frame_buffer.h"
#include "image/lighting/point_light.h"

namespace skylapse::sky {

/// Radiance over a disc per output channel at a view elevation from the horizon to 90 deg and the
/// limb variable m = sqrt(1 - (sin gamma / sin radius)^2): 1 in the middle, 0 at the limb. Finite;
/// channels may be negative (a red sun outside the gamut).
using DiscRadiance = std::function<glm::dvec3(Angle view_elevation, double limb_m)>;

/// The same light without limb darkening: at each elevation the mean over the disc, 2 m dm being
/// the share of its area. Exact to 1e-6 for powers m^alpha from alpha 0 on.
DiscRadiance without_limb_darkening(const DiscRadiance& radiance);

/// A disc on the sky, cut by the horizon.
struct SunDisc {
  Direction<Enu> centre;  // as seen: refracted, if refraction is on
  Angle radius;           // in (0, 10] deg
  DiscRadiance radiance;
  /// Elevation of the horizon, in (-90, 0] deg: minus the dip of a camera above the ground.
  Angle horizon{};
  /// Height over width, in (0, 1]: the air lifts the lower limb of a low sun more than the upper.
  /// Each point stands `flattening` times as far above or below the centre, along its circle at
  /// right angles to the horizon, as without; gamma in the limb variable is the angle before that.
  /// Radiance is kept, so the flux is `flattening` times that of a round disc of even light.
  double flattening = 1;
};

/// sin^2(gamma / 2) of the angle gamma that a direction of the flattened disc had from its centre
/// before refraction drew it together: with lambda out of the vertical plane and psi up in it,
///   cos gamma = cos lambda cos(psi / flattening).
double haversine_in_disc(const SunDisc& disc, const Direction<Enu>& direction);

/// Irradiance by the disc, per channel, in its radiance unit times steradian.
struct DiscEnergy {
  glm::dvec3 normal_irradiance{0};      // sum of L dOmega: on a surface that faces the disc
  glm::dvec3 horizontal_irradiance{0};  // sum of L sin(elevation) dOmega where that
                                        // is positive: on a level surface
};

/// Irradiance by the part of the disc above the horizon, by Gauss quadrature; nothing when no part
/// is. Within 1e-6 for a radiance that is smooth over the disc, the horizon's cut included.
DiscEnergy disc_energy(const SunDisc& disc);

/// The nodes of that quadrature, 768 small lights: their sums are those of disc_energy. For
/// integrals of the disc's light times something smooth over it. None if the disc has set.
std::vector<image::PointLight> disc_points(const SunDisc& disc);

/// Light of the disc in one pixel: radiance to add to what is there.
struct PixelAddition {
  int x = 0;
  int y = 0;
  glm::dvec3 radiance{0};
};

/// The disc as seen by a camera: each pixel at most once, in reading order. Empty if the disc is
/// below the horizon or out of the picture.
struct ProjectedDisc {
  std::vector<PixelAddition> pixels;
  DiscEnergy energy;  // sums over `pixels`, with pixel_solid_angle and the centres' elevations
};

/// Flux      sum of L Omega is that of the part of the disc inside the picture: to rounding if all
///           of it is, within 0.5 % of the whole disc's flux where the frame cuts it (0.05 % for a
///           disc of more than 64 pixels' radius, which is not set to the reference then).
/// Ground    sum of L Omega sin(elevation) too, unless the disc spans so few pixel rows above the
///           horizon that no sharing of the light among them has both sums; then flux is kept.
/// Place     the centroid is kept to a small part of a pixel; no light falls on pixels that are
///           wholly below the horizon or outside the picture.
/// Change    continuous in the disc's direction: a moving sun does not flicker.
/// Cost      0.3 ms for a small disc, 0.6 us per pixel of a large one, whatever the image size.
ProjectedDisc project_sun_disc(const image::Camera& camera, const SunDisc& disc);

/// Adds what of a projected disc lies in the rows [first_row, first_row + image.height()) of the
/// picture to an image of them.
void add_rows(const ProjectedDisc& projected, int first_row, image::FrameBuffer& image);

/// Adds project_sun_disc to an image of the camera's size (asserted); returns its energy. Add the
/// disc after the ground: the pixels of the horizon hold both.
DiscEnergy add_sun_disc(const image::Camera& camera, const SunDisc& disc,
                        image::FrameBuffer& image);

/// The same for the rows [first_row, first_row + image.height()) of the camera's picture, for
/// pictures that are made in pieces.
void add_sun_disc_rows(const image::Camera& camera, const SunDisc& disc, int first_row,
                       image::FrameBuffer& image);

}  // namespace skylapse::sky
