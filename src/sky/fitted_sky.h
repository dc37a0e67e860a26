#pragma once
// What pictures ask of a sky that is a formula: a dome for each direction, and a disc. For the
// baselines, whose formulas are cheap; Hosek-Wilkie has a faster way of its own.
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "core/frames.h"
#include "image/camera/camera.h"
#include "image/frame_buffer.h"
#include "sky/sun_disc.h"

namespace skylapse::sky {

/// XYZ of a direction above the horizon [W m^-2 sr^-1 with CIE weights, 1 au; 683 Y is cd/m^2].
using DomeRadiance = std::function<glm::dvec3(const Direction<Enu>& view)>;

struct FittedSky {
  DomeRadiance dome;  // views below the horizon count as on it
  SunDisc disc;
};

/// Horizontal irradiance by the dome, without the disc: midpoints in 180 zenith angles and 200
/// azimuths, within 1e-3 for the skies of this project (tested).
glm::dvec3 dome_irradiance(const DomeRadiance& dome);

/// Radiance of a Lambertian ground below dome and disc.
glm::dvec3 ground_radiance(const FittedSky& sky, const glm::dvec3& dome_irradiance, double albedo);

/// Fills every pixel of `out`, whose size is the camera's, with the radiance of its centre: the
/// dome above the horizon, `ground_rgb` below, both mixed by image::horizon_coverage where a pixel
/// straddles it, 0 where the camera sees nothing. `xyz_to_rgb` holds all factors. Negative results
/// become 0. The result does not depend on the number of threads.
void render_dome(const image::Camera& camera, const DomeRadiance& dome,
                 const glm::dmat3& xyz_to_rgb, const glm::dvec3& ground_rgb,
                 image::FrameBuffer& out);

/// The same for the rows [first_row, first_row + out.height()) of the camera's image; out.width()
/// is the camera's.
void render_dome_rows(const image::Camera& camera, const DomeRadiance& dome,
                      const glm::dmat3& xyz_to_rgb, const glm::dvec3& ground_rgb, int first_row,
                      image::FrameBuffer& out);

/// A disc of the sun's irradiance and limb darkening, dimmed by the transmittance of the air at a
/// wavelength and an elevation of 0 to 90 deg.
SunDisc dimmed_disc(const Direction<Enu>& sun, Angle radius,
                    const std::function<double(Wavelength, Angle elevation)>& transmittance);

}  // namespace skylapse::sky
