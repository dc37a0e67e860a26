#pragma once
// Images as files hold them, for comparing: all channels, and how their numbers are stored.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/frames.h"
#include "core/quantity.h"
#include "image/camera/camera.h"

namespace skylapse::image {

/// How a file keeps its samples, which says what the smallest step between two of them is.
struct SampleStorage {
  enum class Kind { integer, half_float, float32, rgbe };
  Kind kind = Kind::float32;
  int bits = 32;       // of a sample; 8, 10, 16... of integers
  bool lossy = false;  // JPEG, DWAA, B44...: rounding spreads over neighbours
  bool operator==(const SampleStorage&) const = default;
};

/// Interleaved floats, row 0 at the top. Integers are scaled to 0..1.
struct Picture {
  int width = 0, height = 0;
  /// R, G, B first where the file has them (else Y), then A, then all others in the order of their
  /// names, whatever the order in the file.
  std::vector<std::string> channels;
  std::vector<float> samples;
  SampleStorage storage;
  /// Values made for a display (integers by custom): differences count in code values, not as
  /// shares of the light.
  bool display_referred = false;

  [[nodiscard]] size_t pixel_count() const { return size_t(width) * size_t(height); }
  [[nodiscard]] int channel_count() const { return int(channels.size()); }
  /// Leading channels that are colour: 3 (R, G, B), or 1.
  [[nodiscard]] int colour_count() const {
    return channels.size() >= 3 && channels[0] == "R" ? 3 : 1;
  }
  [[nodiscard]] const float* pixel(int x, int y) const {
    return samples.data() + (size_t(y) * size_t(width) + size_t(x)) * channels.size();
  }
};

/// What is known of where a picture looks, and what it shows.
struct SkyView {
  std::optional<Camera> camera;
  std::optional<Direction<Enu>> sun;  // apparent
  Angle sun_radius = 0.2666 * deg;    // mean, where the file does not say
};

}  // namespace skylapse::image
