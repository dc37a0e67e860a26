#pragma once
// Tables that shaders interpolate in: textures of four numbers a texel, filtered linearly and
// clamped at their edges.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/result.h"
#include "gpu/handle.h"

namespace skylapse::gpu {

struct TextureSize {
  int width = 1, height = 1;
  int depth = 0;  // 0: a sampler2D, whose lookup costs half of a sampler3D's
  [[nodiscard]] size_t texels() const {
    return size_t(width) * size_t(height) * size_t(depth == 0 ? 1 : depth);
  }
};

/// Of each of the four numbers of a texel.
enum class TexelFormat { float32, float16 };

/// Members with a `gl` run inside Context::run.
class Texture {
 public:
  Texture() = default;
  /// RGBA32F; `texels` (4 floats each, x fastest) may be null: the content is then undefined.
  /// Refuses a size above the context's limit, naming it.
  static Result<Texture> create(const Functions& gl, TextureSize size, const float* texels);
  /// RGBA16F from the bits of half floats, not null.
  static Result<Texture> create_half(const Functions& gl, TextureSize size,
                                     const std::uint16_t* texels);

  void write(const Functions& gl, const float* texels) const;
  /// Four floats a texel. Waits for the shaders that write it.
  [[nodiscard]] std::vector<float> read(const Functions& gl) const;
  /// For sampler2D or sampler3D at `unit`.
  void bind(const Functions& gl, unsigned unit) const;
  /// For image2D or image3D (rgba32f) at `unit`, to be written.
  void bind_image(const Functions& gl, unsigned unit) const;
  [[nodiscard]] TextureSize size() const { return size_; }

 private:
  static Result<Texture> create_empty(const Functions& gl, TextureSize size, TexelFormat format);
  void write(const Functions& gl, const void* texels, TexelFormat format) const;

  Handle handle_;
  TextureSize size_;
};

}  // namespace skylapse::gpu
