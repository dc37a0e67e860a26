#pragma once
// Small pictures and the image module, for tests.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "output/image_writer.h"
#include "support/temporary_folder.h"

namespace skylapse::output {

inline const ImageIo& image_io() {
  static const Result<const ImageIo*> io = open_image_io();
  if (!io) throw std::runtime_error(io.error().message);
  return **io;
}

inline constexpr int kWidth = 37;
inline constexpr int kHeight = 23;

/// Smooth colours from 0.001 to about 900.
inline std::vector<float> gradient() {
  std::vector<float> rgb;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (int c = 0; c < 3; ++c)
        rgb.push_back(
            std::exp2(static_cast<float>(x + y) / 3.0f - 10.0f + static_cast<float>(c) / 4));
  return rgb;
}

template <class T>
std::vector<T> codes() {
  std::vector<T> rgb(size_t{3} * kWidth * kHeight);
  for (size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<T>(i * 2654435761U >> 7);
  return rgb;
}

inline EncodeRequest request(const std::string& format, SampleType type, const void* pixels) {
  EncodeRequest r;
  r.format = format;
  r.width = kWidth;
  r.height = kHeight;
  r.type = type;
  r.pixels = pixels;
  return r;
}

/// Writes bytes to a file of that extension and reads it through the module.
inline Result<DecodedImage> decode_bytes(const std::vector<std::byte>& bytes,
                                         const std::string& extension) {
  const TemporaryFolder folder;
  const auto path = folder / ("image." + extension);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  return image_io().decode(path.string());
}

}  // namespace skylapse::output
