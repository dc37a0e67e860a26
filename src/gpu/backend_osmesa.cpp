#include <dlfcn.h>

#include <array>

#include "gpu/backends.h"

namespace skylapse::gpu {
namespace {

// From GL/osmesa.h, which is packaged apart and includes the desktop GL header.
using OsMesaContext = struct osmesa_context*;
constexpr int kOsMesaFormat = 0x22, kOsMesaRgba = 0x1908, kOsMesaProfile = 0x33,
              kOsMesaCoreProfile = 0x34, kOsMesaMajorVersion = 0x36, kOsMesaMinorVersion = 0x37;
constexpr unsigned kUnsignedByte = 0x1401;

struct OsMesa {
  OsMesaContext (*CreateContextAttribs)(const int*, OsMesaContext) = nullptr;
  unsigned char (*MakeCurrent)(OsMesaContext, void*, unsigned, int, int) = nullptr;
  void (*DestroyContext)(OsMesaContext) = nullptr;
  void* (*GetProcAddress)(const char*) = nullptr;
};

template <class Function>
void load(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
}

class OsMesaSurface : public Surface {
 public:
  OsMesaSurface(const OsMesa& functions, OsMesaContext context)
      : functions_(functions), context_(context) {}
  ~OsMesaSurface() override { functions_.DestroyContext(context_); }
  Status make_current() override {
    // Nothing is drawn, but OSMesa wants pixels to draw on.
    if (!functions_.MakeCurrent(context_, pixels_.data(), kUnsignedByte, kSide, kSide))
      return Error{ErrorCode::missing_backend, "OSMesaMakeCurrent failed"};
    return Done{};
  }
  void* proc_address(const char* name) const override { return functions_.GetProcAddress(name); }

 private:
  static constexpr int kSide = 4;
  OsMesa functions_;
  OsMesaContext context_;
  std::array<unsigned char, 4 * kSide * kSide> pixels_{};
};

Result<std::unique_ptr<Surface>> open_surface(const std::string& name) {
  const auto library = open_library(name);
  if (!library) return library.error();
  OsMesa functions;
  load(*library, "OSMesaCreateContextAttribs", functions.CreateContextAttribs);
  load(*library, "OSMesaMakeCurrent", functions.MakeCurrent);
  load(*library, "OSMesaDestroyContext", functions.DestroyContext);
  load(*library, "OSMesaGetProcAddress", functions.GetProcAddress);
  if (!functions.CreateContextAttribs || !functions.MakeCurrent || !functions.DestroyContext ||
      !functions.GetProcAddress)
    return Error{ErrorCode::missing_backend, name + " is older than Mesa 12"};
  const int attributes[] = {kOsMesaFormat,
                            kOsMesaRgba,
                            kOsMesaProfile,
                            kOsMesaCoreProfile,
                            kOsMesaMajorVersion,
                            4,
                            kOsMesaMinorVersion,
                            5,
                            0};
  const OsMesaContext context = functions.CreateContextAttribs(attributes, nullptr);
  if (context == nullptr)
    return Error{ErrorCode::missing_backend, "OSMesa makes no OpenGL 4.5 core context"};
  return std::unique_ptr<Surface>(new OsMesaSurface(functions, context));
}

}  // namespace

Candidate osmesa_candidate(const std::string& library) {
  return {"OSMesa", [library] { return open_surface(library); }};
}

}  // namespace skylapse::gpu
