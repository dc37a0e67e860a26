#include "study/delta_e.h"

#include <cmath>
#include <numbers>

#include "color/rgb_space.h"

namespace skylapse::study {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// IEC 61966-2-1, encoded to linear.
double linear_of(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// CIE 15:2004, 8.2.1.1: the cube root, straight near black.
double lab_curve(double t) {
  constexpr double kLimit = 6.0 / 29;
  return t > kLimit * kLimit * kLimit ? std::cbrt(t) : t / (3 * kLimit * kLimit) + 4.0 / 29;
}

/// Hue in degrees, [0, 360); 0 of a grey.
double hue_deg(double b, double a) {
  if (a == 0 && b == 0) return 0;
  const double h = std::atan2(b, a) / kDegree;
  return h < 0 ? h + 360 : h;
}

double seventh_power_share(double chroma) {
  const double c7 = std::pow(chroma, 7);
  return std::sqrt(c7 / (c7 + std::pow(25.0, 7)));
}

/// Eq. (10), (14) of Sharma et al.: difference and mean of two hues; greys have none.
struct Hues {
  double difference, mean;
};
Hues hues_of(double h1, double h2, bool grey) {
  if (grey) return {0, h1 + h2};
  double difference = h2 - h1;
  if (difference > 180) difference -= 360;
  if (difference < -180) difference += 360;
  if (std::abs(h1 - h2) <= 180) return {difference, (h1 + h2) / 2};
  return {difference, (h1 + h2 + (h1 + h2 < 360 ? 360 : -360)) / 2};
}

}  // namespace

glm::dvec3 lab_of_srgb(const glm::dvec3& encoded) {
  const glm::dvec3 e = glm::clamp(encoded, 0.0, 1.0);
  const glm::dvec3 linear(linear_of(e.x), linear_of(e.y), linear_of(e.z));
  const glm::dmat3& to_xyz = color::rgb_to_xyz(color::RgbSpace::rec709);
  const glm::dvec3 t = (to_xyz * linear) / (to_xyz * glm::dvec3(1));
  const double x = lab_curve(t.x), y = lab_curve(t.y), z = lab_curve(t.z);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double ciede2000(const glm::dvec3& lab1, const glm::dvec3& lab2) {
  const double mean_c = (std::hypot(lab1.y, lab1.z) + std::hypot(lab2.y, lab2.z)) / 2;
  const double g = 0.5 * (1 - seventh_power_share(mean_c));
  const double a1 = (1 + g) * lab1.y, a2 = (1 + g) * lab2.y;
  const double c1 = std::hypot(a1, lab1.z), c2 = std::hypot(a2, lab2.z);
  const auto [dh, mean_h] = hues_of(hue_deg(lab1.z, a1), hue_deg(lab2.z, a2), c1 == 0 || c2 == 0);
  const double dl = lab2.x - lab1.x, dc = c2 - c1;
  const double dhue = 2 * std::sqrt(c1 * c2) * std::sin(dh / 2 * kDegree);
  const double mean_l = (lab1.x + lab2.x) / 2, mean_cp = (c1 + c2) / 2;
  const double t =
      1 - 0.17 * std::cos((mean_h - 30) * kDegree) + 0.24 * std::cos(2 * mean_h * kDegree) +
      0.32 * std::cos((3 * mean_h + 6) * kDegree) - 0.20 * std::cos((4 * mean_h - 63) * kDegree);
  const double turn = (mean_h - 275) / 25;
  const double theta = 30 * std::exp(-turn * turn);
  const double l50 = (mean_l - 50) * (mean_l - 50);
  const double sl = 1 + 0.015 * l50 / std::sqrt(20 + l50);
  const double sc = 1 + 0.045 * mean_cp, sh = 1 + 0.015 * mean_cp * t;
  const double rt = -std::sin(2 * theta * kDegree) * 2 * seventh_power_share(mean_cp);
  const double l = dl / sl, c = dc / sc, h = dhue / sh;
  return std::sqrt(l * l + c * c + h * h + rt * c * h);
}

}  // namespace skylapse::study
