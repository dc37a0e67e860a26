#pragma once
// Memory of a context that shaders read and write: uniform (std140) and storage (std430) blocks.
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "gpu/handle.h"

namespace skylapse::gpu {

/// All members need the context's functions: they run inside Context::run.
class Buffer {
 public:
  Buffer() = default;
  /// `bytes` of zeros, or of what `data` points to. At least one byte is made, so that an empty
  /// list can be bound too.
  static Buffer create(const Functions& gl, size_t bytes, const void* data = nullptr);
  template <class T>
  static Buffer of(const Functions& gl, std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    return create(gl, values.size_bytes(), values.data());
  }
  template <class T>
  static Buffer of(const Functions& gl, const std::vector<T>& values) {
    return of(gl, std::span<const T>(values));
  }
  /// A block of one struct.
  template <class T>
  static Buffer of_block(const Functions& gl, const T& block) {
    return of(gl, std::span<const T>(&block, 1));
  }

  void write(const Functions& gl, size_t offset, size_t bytes, const void* data) const;
  /// Waits for the shaders that write it.
  void read(const Functions& gl, size_t offset, size_t bytes, void* data) const;
  void clear(const Functions& gl) const;
  void bind_uniform(const Functions& gl, unsigned binding) const;
  void bind_storage(const Functions& gl, unsigned binding) const;
  [[nodiscard]] size_t bytes() const { return bytes_; }

 private:
  Handle handle_;
  size_t bytes_ = 0;
};

}  // namespace skylapse::gpu
