#pragma once
// Ownership of one GL object: deleted on its context's thread, whatever thread lets go of it. An
// object that outlives its context went with it.
#include <memory>
#include <utility>

#include "gpu/context.h"

namespace skylapse::gpu {

class Handle {
 public:
  using Deleter = void (*)(const Functions& gl, unsigned name);

  Handle() = default;
  Handle(Context& context, unsigned name, Deleter deleter)
      : context_(context.weak_from_this()), name_(name), deleter_(deleter) {}
  ~Handle() { release(); }
  Handle(Handle&& other) noexcept
      : context_(std::move(other.context_)),
        name_(std::exchange(other.name_, 0)),
        deleter_(other.deleter_) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this == &other) return *this;
    release();
    context_ = std::move(other.context_);
    name_ = std::exchange(other.name_, 0);
    deleter_ = other.deleter_;
    return *this;
  }
  [[nodiscard]] unsigned name() const { return name_; }

 private:
  void release() {
    if (name_ == 0) return;
    if (const auto context = context_.lock())
      context->post([name = name_, deleter = deleter_](const Functions& gl) { deleter(gl, name); });
    name_ = 0;
  }
  std::weak_ptr<Context> context_;
  unsigned name_ = 0;
  Deleter deleter_ = nullptr;
};

}  // namespace skylapse::gpu
