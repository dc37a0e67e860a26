#pragma once
// A headless OpenGL 4.5 core context, on EGL or OSMesa, both loaded at run time.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"

namespace skylapse::gpu {

enum class Backend { automatic, egl, osmesa };

/// What was tried, in order, and why it was passed over; the reason of the last is empty if it
/// works.
struct Attempt {
  std::string what;    // "EGL surfaceless", "EGL device 0", "OSMesa"
  std::string reason;  // empty: taken
};

struct ContextInfo {
  std::string backend;  // "EGL surfaceless", "EGL device 1", "OSMesa"
  std::string vendor, renderer, version;
  bool software = false;  // llvmpipe, softpipe, swrast
  int max_texture_3d = 0;
  std::vector<Attempt> attempts;
};

struct Functions;  // gpu/functions.h: the GL entry points of one context

/// One context with its own thread; everything that talks to GL runs there, in the order asked.
/// Two contexts, in one process or in two, do not disturb each other.
class Context : public std::enable_shared_from_this<Context> {
 public:
  /// Error missing_backend with the package to install when nothing works; `automatic` tries EGL
  /// surfaceless, each EGL device, then OSMesa. Never the default display. A graphics card among
  /// the EGL devices wins over a surfaceless context in software.
  static Result<std::shared_ptr<Context>> create(Backend backend);
  virtual ~Context() = default;

  [[nodiscard]] virtual const ContextInfo& info() const = 0;
  /// Runs `work` on the context's thread with the context current and waits for it. Errors that GL
  /// reports meanwhile (debug messages of type error) become the result's error. Work may call run
  /// again: it is then run at once.
  virtual Status run(const std::function<Status(const Functions&)>& work) = 0;
  /// Queues `work` without waiting, for the release of GL objects.
  virtual void post(std::function<void(const Functions&)> work) = 0;
  /// What GL's errors are blamed on from now on, e.g. the shader that is about to run; only on the
  /// context's thread.
  virtual void set_activity(std::string activity) = 0;
};

}  // namespace skylapse::gpu
