#pragma once
// Small skies and their errors, for the tests of pages.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "diff/evidence.h"

namespace skylapse::diff {

/// A clear sky with the sun's disc 5000 times as bright at column `sun` of 256, row 40 of 128 (or
/// the same in another size), and darker ground below row 100.
inline image::Picture sample_sky(double sun, double disc = 5000, int width = 256,
                                 int height = 128) {
  image::Picture picture;
  picture.width = width, picture.height = height;
  picture.channels = {"R", "G", "B"};
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      const double x = (i + 0.5) * 256 / width - 0.5, y = (j + 0.5) * 128 / height - 0.5;
      const double v = (y + 0.5) / 128, d = std::pow(x - sun, 2) + std::pow(y - 40, 2);
      const double k = d <= 9 ? disc * (1 - 0.05 * d) : 0, ground = y >= 100 ? 0.15 : 1;
      picture.samples.push_back(float(ground * (0.2 + 0.5 * v * v + 6 / (1 + d / 60) + k)));
      picture.samples.push_back(
          float(ground * (0.35 + 0.45 * v * v + 5 / (1 + d / 60) + 0.95 * k)));
      picture.samples.push_back(float(ground * (0.8 + 0.2 * v * v + 4 / (1 + d / 60) + 0.85 * k)));
    }
  return picture;
}

inline image::Picture changed(image::Picture picture,
                              const std::function<void(float* rgb, int x, int y)>& change) {
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      change(picture.samples.data() + 3 * (size_t(y) * picture.width + x), x, y);
  return picture;
}

/// The pictures with a map of their relative differences.
inline PairEvidence evidence_of(image::Picture a, image::Picture b) {
  PairEvidence e{std::move(a), std::move(b), {}, {}};
  if (e.a.samples.size() != e.b.samples.size() || e.a.width != e.b.width) return e;
  const size_t channels = e.a.channels.size();
  for (size_t i = 0; i < e.a.samples.size(); i += channels) {
    float worst = 0;
    for (size_t c = i; c < i + channels; ++c) {
      const float x = e.a.samples[c], y = e.b.samples[c];
      const float size = e.a.display_referred ? 1 / 255.f : std::max(std::abs(x), std::abs(y));
      const float error = std::isfinite(x) && std::isfinite(y)
                              ? (size > 0 ? std::abs(y - x) / size : 0)
                              : std::numeric_limits<float>::infinity();
      worst = std::max(worst, error);
    }
    e.error.push_back(worst);
    e.flip.push_back(std::min(1.f, worst));
  }
  return e;
}

/// The whole sphere, north in the middle.
inline image::Camera sample_camera(int width = 256, int height = 128) {
  image::Camera camera;
  camera.projection = image::Projection::lat_long;
  camera.width = width, camera.height = height;
  return camera;
}

}  // namespace skylapse::diff
