#pragma once
#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

namespace skylapse::image {

/// Float image, three interleaved channels of a linear space that the owner names.
/// Row 0 is the top. Values are absolute: channel sum of weights times 683 is cd/m^2.
class FrameBuffer {
 public:
  FrameBuffer() = default;
  FrameBuffer(int width, int height)
      : width_(width), height_(height), data_(size_t{3} * width * height) {
    assert(width > 0 && height > 0);
  }
  /// Takes the samples, three a pixel.
  FrameBuffer(int width, int height, std::vector<float> data)
      : width_(width), height_(height), data_(std::move(data)) {
    assert(width > 0 && height > 0 && data_.size() == size_t{3} * width * height);
  }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] size_t pixel_count() const { return size_t(width_) * height_; }
  [[nodiscard]] float* row(int y) { return data_.data() + size_t{3} * width_ * y; }
  [[nodiscard]] const float* row(int y) const { return data_.data() + size_t{3} * width_ * y; }
  [[nodiscard]] float* pixel(int x, int y) { return row(y) + size_t{3} * x; }
  [[nodiscard]] const float* pixel(int x, int y) const { return row(y) + size_t{3} * x; }
  [[nodiscard]] std::vector<float>& data() { return data_; }
  [[nodiscard]] const std::vector<float>& data() const { return data_; }

 private:
  int width_ = 0;
  int height_ = 0;
  std::vector<float> data_;
};

}  // namespace skylapse::image
