#pragma once
// Small images that are made and spoilt on purpose, and the files they go into. Written with
// OpenImageIO directly: the product's own writer refuses much of what must be written here.
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace skylapse::diff_cases {

/// Interleaved samples, row 0 at the top. Integer images hold their code values.
struct Image {
  int width = 0, height = 0;
  std::vector<std::string> channels{"R", "G", "B"};
  std::vector<float> samples;
  int bits = 32;                        // 8 or 16: code values of integers; 32: floats
  std::filesystem::path attributes_of;  // a file whose attributes it is written with; empty: none

  Image() = default;
  Image(int columns, int rows, float value = 0)
      : width(columns), height(rows), samples(size_t(columns) * size_t(rows) * 3, value) {}
  [[nodiscard]] int channel_count() const { return int(channels.size()); }
  [[nodiscard]] float& at(int x, int y, int c) { return samples[index(x, y, c)]; }
  [[nodiscard]] float at(int x, int y, int c) const { return samples[index(x, y, c)]; }

 private:
  [[nodiscard]] size_t index(int x, int y, int c) const {
    return (size_t(y) * size_t(width) + size_t(x)) * channels.size() + size_t(c);
  }
};

/// A copy with each sample replaced by change(x, y, channel, value); computed in double if that is
/// what `change` answers with, and rounded to float once.
template <class Change>
Image changed(const Image& image, Change change) {
  Image out = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < image.channel_count(); ++c)
        out.at(x, y, c) = static_cast<float>(change(x, y, c, image.at(x, y, c)));
  return out;
}

/// The pixel at (x, y) comes from source(x, y) -> {x, y}, wrapped round sideways and held at the
/// edges above and below.
template <class Source>
Image moved(const Image& image, Source source) {
  return changed(image, [&](int x, int y, int c, float) {
    const auto [from_x, from_y] = source(x, y);
    const int column = ((from_x % image.width) + image.width) % image.width;
    return image.at(column, from_y < 0 ? 0 : from_y >= image.height ? image.height - 1 : from_y, c);
  });
}

/// How a file holds an image.
struct FileOptions {
  std::string type;                 // "half", "float", "uint8", "uint16"; empty: as the image is
  std::string compression = "zip";  // of EXR and TIFF; "jpeg:92"
  int tile = 0;                     // edge of the tiles of an EXR; 0: scanlines
  bool bottom_first = false;        // order of the scanlines of an EXR
  std::vector<std::pair<std::string, std::string>> text;  // attributes
  std::vector<std::pair<std::string, int>> numbers;
  std::vector<std::pair<std::string, float>> floats;
  std::vector<std::string> without;  // attributes that are left out
};

/// Writes a file; the extension says in which format. Throws what went wrong.
void write_image(const std::filesystem::path& path, const Image& image,
                 const FileOptions& options = {});

/// Reads the first part of a file, integers as code values; what is written of it has the file's
/// attributes. Throws what went wrong.
Image read_image(const std::filesystem::path& path);

/// Filtered by a normalised Gaussian kernel of `size` pixels, as OpenImageIO makes it.
Image blurred(const Image& image, float size);

/// Half floats carried in floats: samples beyond 65504 become infinite.
Image as_half(const Image& image);

/// Pseudo-random numbers in [0, 1), a sample each: row by row, channel by channel, by the linear
/// congruential generator s -> 1664525 s + 1013904223 (Numerical Recipes), its upper 24 bits.
class Noise {
 public:
  Noise(int width, int height, uint32_t seed);
  [[nodiscard]] double operator()(int x, int y, int c) const {
    return values_[(size_t(y) * size_t(width_) + size_t(x)) * 3 + size_t(c)];
  }

 private:
  int width_;
  std::vector<double> values_;
};

}  // namespace skylapse::diff_cases
