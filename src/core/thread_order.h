#pragma once
// What ThreadSanitizer cannot see: how oneTBB, which is not instrumented, hands work over and back.
// Without the sanitizer all this is nothing.

#if defined(__SANITIZE_THREAD__)
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
/// Of a function that reads a task's own fields before it can say what it comes after.
#define SKYLAPSE_UNWATCHED __attribute__((no_sanitize("thread")))
#else
#define SKYLAPSE_UNWATCHED
#endif

namespace skylapse {

/// A moment, which its address stands for: what threads did before `reached` is seen by those that
/// go on after `passed`.
class Moment {
 public:
  void reached() {
#if defined(__SANITIZE_THREAD__)
    __tsan_release(&place_);
#endif
  }
  void passed() {
#if defined(__SANITIZE_THREAD__)
    __tsan_acquire(&place_);
#endif
  }

 private:
  [[maybe_unused]] char place_ = 0;
};

}  // namespace skylapse
