#include "gpu/texture.h"

#include <fmt/format.h>

#include <algorithm>

#include "gpu/functions.h"

namespace skylapse::gpu {

Result<Texture> Texture::create_empty(const Functions& gl, TextureSize size, TexelFormat format) {
  const int limit = gl.context->info().max_texture_3d;
  const auto [smallest, largest] =
      std::minmax({size.width, size.height, size.depth == 0 ? 1 : size.depth});
  if (smallest < 1 || largest > limit)
    return Error{ErrorCode::internal,
                 fmt::format("a table of {} x {} x {} texels does not fit this OpenGL, whose limit "
                             "is {} along each axis",
                             size.width, size.height, size.depth, limit)};
  GLuint name = 0;
  gl.CreateTextures(size.depth == 0 ? GL_TEXTURE_2D : GL_TEXTURE_3D, 1, &name);
  Texture texture;
  texture.handle_ =
      Handle(*gl.context, name, [](const Functions& f, unsigned n) { f.DeleteTextures(1, &n); });
  texture.size_ = size;
  const GLenum stored = format == TexelFormat::float32 ? GL_RGBA32F : GL_RGBA16F;
  if (size.depth == 0)
    gl.TextureStorage2D(name, 1, stored, size.width, size.height);
  else
    gl.TextureStorage3D(name, 1, stored, size.width, size.height, size.depth);
  gl.TextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    gl.TextureParameteri(name, axis, GL_CLAMP_TO_EDGE);
  return texture;
}

Result<Texture> Texture::create(const Functions& gl, TextureSize size, const float* texels) {
  auto texture = create_empty(gl, size, TexelFormat::float32);
  if (texture && texels != nullptr) texture->write(gl, texels);
  return texture;
}

Result<Texture> Texture::create_half(const Functions& gl, TextureSize size,
                                     const std::uint16_t* texels) {
  auto texture = create_empty(gl, size, TexelFormat::float16);
  if (texture) texture->write(gl, texels, TexelFormat::float16);
  return texture;
}

void Texture::write(const Functions& gl, const float* texels) const {
  write(gl, texels, TexelFormat::float32);
}

void Texture::write(const Functions& gl, const void* texels, TexelFormat format) const {
  const GLenum type = format == TexelFormat::float32 ? GL_FLOAT : GL_HALF_FLOAT;
  if (size_.depth == 0)
    gl.TextureSubImage2D(handle_.name(), 0, 0, 0, size_.width, size_.height, GL_RGBA, type, texels);
  else
    gl.TextureSubImage3D(handle_.name(), 0, 0, 0, 0, size_.width, size_.height, size_.depth,
                         GL_RGBA, type, texels);
}

std::vector<float> Texture::read(const Functions& gl) const {
  std::vector<float> texels(4 * size_.texels());
  gl.MemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  gl.GetTextureImage(handle_.name(), 0, GL_RGBA, GL_FLOAT, GLsizei(texels.size() * sizeof(float)),
                     texels.data());
  return texels;
}

void Texture::bind(const Functions& gl, unsigned unit) const {
  gl.BindTextureUnit(unit, handle_.name());
}

void Texture::bind_image(const Functions& gl, unsigned unit) const {
  gl.BindImageTexture(unit, handle_.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA32F);
}

}  // namespace skylapse::gpu
