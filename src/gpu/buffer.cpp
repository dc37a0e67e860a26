#include "gpu/buffer.h"

#include <algorithm>
#include <cassert>

#include "gpu/functions.h"

namespace skylapse::gpu {

Buffer Buffer::create(const Functions& gl, size_t bytes, const void* data) {
  GLuint name = 0;
  gl.CreateBuffers(1, &name);
  Buffer buffer;
  buffer.handle_ =
      Handle(*gl.context, name, [](const Functions& f, unsigned n) { f.DeleteBuffers(1, &n); });
  buffer.bytes_ = std::max<size_t>(bytes, 1);
  gl.NamedBufferStorage(name, GLsizeiptr(buffer.bytes_), bytes == 0 ? nullptr : data,
                        GL_DYNAMIC_STORAGE_BIT);
  if (data == nullptr) buffer.clear(gl);
  return buffer;
}

void Buffer::write(const Functions& gl, size_t offset, size_t bytes, const void* data) const {
  assert(offset + bytes <= bytes_);
  if (bytes > 0) gl.NamedBufferSubData(handle_.name(), GLintptr(offset), GLsizeiptr(bytes), data);
}

void Buffer::read(const Functions& gl, size_t offset, size_t bytes, void* data) const {
  assert(offset + bytes <= bytes_);
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  if (bytes > 0)
    gl.GetNamedBufferSubData(handle_.name(), GLintptr(offset), GLsizeiptr(bytes), data);
}

void Buffer::clear(const Functions& gl) const {
  gl.ClearNamedBufferData(handle_.name(), GL_R8, GL_RED, GL_UNSIGNED_BYTE, nullptr);
}

void Buffer::bind_uniform(const Functions& gl, unsigned binding) const {
  gl.BindBufferBase(GL_UNIFORM_BUFFER, binding, handle_.name());
}

void Buffer::bind_storage(const Functions& gl, unsigned binding) const {
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, handle_.name());
}

}  // namespace skylapse::gpu
