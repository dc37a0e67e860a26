#pragma once
// A sky as glossy surfaces of growing roughness mirror it: the first half of the split sum of Karis
// 2013, "Real Shading in Unreal Engine 4", for N = V = R:
//   L'(R) = integral of L(l) k(R l) dl / integral of k(R l) dl,
//   k(c) = D(h) c for c > 0,  D(h) = a2 / (pi (h^2 (a2 - 1) + 1)^2),  h^2 = (1 + c) / 2 = (N H)^2,
//   a2 = alpha^2, alpha = roughness^2:
// what its sum of samples of the GGX distribution, weighted with N L, tends to. It is a convolution
// with a kernel about each direction, so an even sky stays even and the sum of L' over all
// directions is that of L.
// Instead of samples, which sparkle where a sky is bright, the integral is summed over pieces of a
// pyramid of means that grow with their distance from R: smooth, and the same every time.
#include <span>
#include <vector>

#include "image/camera/camera.h"
#include "image/frame_buffer.h"
#include "image/lighting/point_light.h"
#include "image/lighting/zonal_kernel.h"

namespace skylapse::image {

/// Roughness of a level: 0 for the first, 1 for the last, in even steps.
double roughness_of_level(int level, int levels);
/// alpha = roughness^2 (Disney's, as Karis 2013).
double alpha_of_roughness(double roughness);

/// The kernel per steradian, with integral 1 over the sphere. alpha in (0, 1].
class GgxKernel {
 public:
  explicit GgxKernel(double alpha);
  /// At an angle with the cosine c.
  [[nodiscard]] double at_cosine(double c) const { return at_chord2(2 * (1 - c)); }
  /// By the square of the chord, 2 (1 - c): keeps its digits about the peak.
  [[nodiscard]] double at_chord2(double chord2) const {
    const double shape = a2_ + 0.25 * (1 - a2_) * chord2, c = 1 - 0.5 * chord2;
    return c > 0 ? scale_ * c / (shape * shape) : 0;
  }

 private:
  double a2_, scale_;
};

/// A sky ready to be filtered.
class SpecularSource {
 public:
  /// `sky`: vertical strip of a cube, heading as `camera`. No lower alpha will be asked for.
  SpecularSource(const Camera& camera, const FrameBuffer& sky, double lowest_alpha);

  /// A cube of `side` (vertical strip, same heading) filtered with alpha in [lowest, 1]. Each pixel
  /// is the kernel's value at its centre, of sides below 32 the mean over the pixel; then each
  /// channel is scaled by the little (below 1e-3, measured) that its sum over the sphere is off.
  [[nodiscard]] FrameBuffer filtered(int side, double alpha) const;

 private:
  struct Node {
    kernel::Source light;
    float reach;  // chord from the middle to the farthest corner
  };
  Camera camera_;
  std::vector<std::vector<Node>> levels_;  // finest first; sides are powers of two
  glm::dvec3 reference_{0}, flux_{0};

  void gather(const glm::vec3& middle, float reach, float alpha, std::vector<Node>& out) const;
  void fill_tile(int side, int face, int x0, int y0, double alpha, FrameBuffer& out) const;
};

/// Adds point lights filtered with alpha to a cube (vertical strip): pixels hold the kernel's mean
/// over themselves, and the sum over the sphere is that of the lights' irradiance. Lights lie near
/// each other (a disc): seen from afar they count as one.
void add_filtered_lights(const Camera& camera, std::span<const PointLight> lights, double alpha,
                         FrameBuffer& strip);

/// The lowest alpha for which the filtered lights are nowhere brighter than `brightest`.
double alpha_for_peak(std::span<const PointLight> lights, double brightest);

}  // namespace skylapse::image
