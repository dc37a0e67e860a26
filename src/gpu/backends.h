#pragma once
// How contexts come to be: one surface per way to get GL without a window.
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"
#include "gpu/context.h"

namespace skylapse::gpu {

/// A context of the platform, not yet current anywhere. make_current, and the destructor after it,
/// belong on one thread.
class Surface {
 public:
  virtual ~Surface() = default;
  virtual Status make_current() = 0;
  virtual void* proc_address(const char* name) const = 0;
};

/// One way to a context; `open` is called on the thread that the context will live on.
struct Candidate {
  std::string what;  // as in Attempt
  std::function<Result<std::unique_ptr<Surface>>()> open;
  bool hardware = false;  // the driver says, before it is opened, that it is a graphics card
};

/// Names for dlopen; tests give others to see what happens where there is no GL.
struct Libraries {
  std::string egl = "libEGL.so.1";
  std::string osmesa = "libOSMesa.so.8";
};

/// EGL surfaceless and each EGL device; one candidate that says why if EGL cannot be loaded.
std::vector<Candidate> egl_candidates(const std::string& library);
Candidate osmesa_candidate(const std::string& library);

/// Context::create with other libraries.
Result<std::shared_ptr<Context>> create_context(Backend backend, const Libraries& libraries);

/// dlopen with RTLD_LOCAL; kept until the process ends, because drivers do not survive dlclose.
Result<void*> open_library(const std::string& name);

}  // namespace skylapse::gpu
