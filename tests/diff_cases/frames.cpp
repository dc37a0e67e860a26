#include "diff_cases/frames.h"

#include <array>
#include <cmath>

namespace skylapse::diff_cases {

Image day_sketch(const DaySketch& s) {
  constexpr int kDiscRadiusSquared = 9;
  return changed(Image(s.width, s.height), [&](int x, int y, int c, float) {
    const double v = (y + 0.5) / s.height;
    const double d =
        double(x - s.sun_column) * (x - s.sun_column) + double(y - s.sun_row) * (y - s.sun_row);
    const double disc = d <= kDiscRadiusSquared ? s.disc : 0;
    const std::array<double, 3> light{0.2 + 0.5 * v * v + 6 / (1 + d / 60) + disc,
                                      0.35 + 0.45 * v * v + 5 / (1 + d / 60) + 0.95 * disc,
                                      0.8 + 0.2 * v * v + 4 / (1 + d / 60) + 0.85 * disc};
    const bool ground = y * 128 >= kGroundRow * s.height;
    return light[size_t(c)] * s.gain * (ground ? 0.15 : 1);
  });
}

Image night_sketch(int dark_from) {
  return changed(Image(256, 128), [&](int x, int y, int c, float) {
    if (y >= dark_from) return 0.0;
    const double v = (y + 0.5) / 128;
    const bool has_star = (37 * x + 59 * y) % 997 == 0;
    const double star = has_star ? 0.01 + 0.3 * ((x * y) % 7) / 7 : 0;
    const std::array<double, 3> light{2e-4 * (1 + v) + star, 2.5e-4 * (1 + v) + 0.95 * star,
                                      4e-4 * (1 + v) + 0.9 * star};
    return light[size_t(c)];
  });
}

Image display_of(const Image& linear) {
  Image out = changed(linear, [](int, int, int, float sample) {
    const double a = sample;
    const double compressed = a / (1 + a);
    const double s = compressed <= 0.0031308 ? 12.92 * compressed
                                             : 1.055 * std::pow(compressed, 1 / 2.4) - 0.055;
    return std::floor(255 * s + 0.5);
  });
  out.bits = 8;
  return out;
}

Image sequence_frame(int i) {
  DaySketch sketch;
  sketch.sun_column = 120 + 10 * i;
  sketch.gain = 1 + 0.1 * i;
  return day_sketch(sketch);
}

Image cropped(const Image& image, int x, int y, int width, int height) {
  Image out(width, height);
  out.bits = image.bits;
  return changed(out, [&](int i, int j, int c, float) { return image.at(x + i, y + j, c); });
}

}  // namespace skylapse::diff_cases
