#pragma once
// The light of a whole sphere in real spherical harmonics of the degrees 0, 1 and 2.
//
// Basis    orthonormal over the sphere, in the order (l, m) = (0, 0) (1, -1) (1, 0) (1, 1) (2, -2)
//          (2, -1) (2, 0) (2, 1) (2, 2), of the unit vector (x, y, z), without the Condon-Shortley
//          sign, as Ramamoorthi & Hanrahan 2001, "An Efficient Representation for Irradiance
//          Environment Maps", Eq. (3), and three.js:
//            Y00   = sqrt(1 / 4 pi)          Y2-2 = sqrt(15 / 4 pi) x y
//            Y1-1  = sqrt(3 / 4 pi) y        Y2-1 = sqrt(15 / 4 pi) y z
//            Y10   = sqrt(3 / 4 pi) z        Y20  = sqrt(5 / 16 pi) (3 z^2 - 1)
//            Y11   = sqrt(3 / 4 pi) x        Y21  = sqrt(15 / 4 pi) x z
//                                            Y22  = sqrt(15 / 16 pi) (x^2 - y^2)
// Light    L(w) = sum of L_lm Y_lm(w) as far as nine terms go; L_lm = integral of L Y_lm dw.
// Error    Of the irradiance: the clamped cosine goes on in the degrees 4, 6, 8... For a point
// light
//          of the irradiance E, nine terms give a surface at the angle t to it
//            E (1/4 + cos(t)/2 + 5/32 (3 cos^2(t) - 1)) instead of E max(0, cos t):
//          1/16 E too much facing it and facing away, 3/32 E = 9.4 % at right angles, and never
//          more.
#include <array>
#include <glm/glm.hpp>
#include <span>

#include "image/camera/camera.h"
#include "image/frame_buffer.h"
#include "image/lighting/point_light.h"

namespace skylapse::image {

inline constexpr int kHarmonics = 9;

/// The nine functions at a unit vector.
std::array<double, kHarmonics> harmonics_at(const glm::dvec3& unit);

/// Coefficients L_lm, per channel.
using Harmonics = std::array<glm::dvec3, kHarmonics>;

/// Of a picture of the whole sphere: the sum of L Y Omega over pixel centres with
/// pixel_solid_angle, in double, the same for any number of threads. `enu_to_axes` (orthogonal)
/// turns directions into the axes of (x, y, z). `camera` and `image` have one size (asserted).
Harmonics project_picture(const Camera& camera, const FrameBuffer& image,
                          const glm::dmat3& enu_to_axes);

/// Of point lights: the sum of E Y.
Harmonics project_lights(std::span<const PointLight> lights, const glm::dmat3& enu_to_axes);

Harmonics sum_of(const Harmonics& a, const Harmonics& b);

/// Factors of the degrees 0, 1, 2 that turn light into irradiance: pi, 2 pi / 3, pi / 4
/// (Ramamoorthi & Hanrahan 2001, Eq. 8).
inline constexpr std::array<double, 3> kCosineFactors{
    3.14159265358979323846, 2.09439510239319549231, 0.78539816339744830962};

/// Irradiance of a surface with the unit normal `normal` in the coefficients' axes.
glm::dvec3 irradiance_of(const Harmonics& light, const glm::dvec3& normal);

/// Coefficients of the irradiance itself: each degree times its factor.
Harmonics cosine_convolved(const Harmonics& light);

}  // namespace skylapse::image
