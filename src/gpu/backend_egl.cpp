#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <cstring>
#include <map>
#include <mutex>

#include "gpu/backends.h"

namespace skylapse::gpu {
namespace {

struct Egl {
  decltype(&eglGetProcAddress) GetProcAddress = nullptr;
  decltype(&eglQueryString) QueryString = nullptr;
  decltype(&eglInitialize) Initialize = nullptr;
  decltype(&eglTerminate) Terminate = nullptr;
  decltype(&eglBindAPI) BindAPI = nullptr;
  decltype(&eglCreateContext) CreateContext = nullptr;
  decltype(&eglDestroyContext) DestroyContext = nullptr;
  decltype(&eglMakeCurrent) MakeCurrent = nullptr;
  decltype(&eglReleaseThread) ReleaseThread = nullptr;
  decltype(&eglGetError) GetError = nullptr;
  PFNEGLGETPLATFORMDISPLAYEXTPROC GetPlatformDisplayEXT = nullptr;
  PFNEGLQUERYDEVICESEXTPROC QueryDevicesEXT = nullptr;  // null where devices cannot be listed
  PFNEGLQUERYDEVICESTRINGEXTPROC QueryDeviceStringEXT = nullptr;
};

template <class Function>
void load(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
}

bool has_word(const char* list, const char* word) {
  const size_t length = std::strlen(word);
  for (const char* p = list; p != nullptr && (p = std::strstr(p, word)) != nullptr; p += length)
    if ((p == list || p[-1] == ' ') && (p[length] == '\0' || p[length] == ' ')) return true;
  return false;
}

Result<Egl> load_egl(const std::string& name) {
  const auto library = open_library(name);
  if (!library) return library.error();
  Egl egl;
  load(*library, "eglGetProcAddress", egl.GetProcAddress);
  load(*library, "eglQueryString", egl.QueryString);
  load(*library, "eglInitialize", egl.Initialize);
  load(*library, "eglTerminate", egl.Terminate);
  load(*library, "eglBindAPI", egl.BindAPI);
  load(*library, "eglCreateContext", egl.CreateContext);
  load(*library, "eglDestroyContext", egl.DestroyContext);
  load(*library, "eglMakeCurrent", egl.MakeCurrent);
  load(*library, "eglReleaseThread", egl.ReleaseThread);
  load(*library, "eglGetError", egl.GetError);
  if (!egl.GetProcAddress || !egl.QueryString || !egl.Initialize || !egl.Terminate ||
      !egl.BindAPI || !egl.CreateContext || !egl.DestroyContext || !egl.MakeCurrent ||
      !egl.ReleaseThread || !egl.GetError)
    return Error{ErrorCode::missing_backend, name + " is not EGL 1.5"};
  const char* client = egl.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (has_word(client, "EGL_EXT_platform_base"))
    egl.GetPlatformDisplayEXT = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
        egl.GetProcAddress("eglGetPlatformDisplayEXT"));
  if (!egl.GetPlatformDisplayEXT)
    return Error{ErrorCode::missing_backend, name + " lacks EGL_EXT_platform_base"};
  if (has_word(client, "EGL_EXT_device_query") || has_word(client, "EGL_EXT_device_base"))
    egl.QueryDeviceStringEXT = reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(
        egl.GetProcAddress("eglQueryDeviceStringEXT"));
  if (has_word(client, "EGL_EXT_device_enumeration") || has_word(client, "EGL_EXT_device_base"))
    egl.QueryDevicesEXT =
        reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(egl.GetProcAddress("eglQueryDevicesEXT"));
  return egl;
}

Error egl_error(const Egl& egl, const char* what) {
  return {ErrorCode::missing_backend, fmt::format("{} failed (EGL error 0x{:04x})", what,
                                                  static_cast<unsigned>(egl.GetError()))};
}

/// EGL gives the same display to all who ask for it, and one eglTerminate ends it for all of them:
/// displays are counted, the last user terminates.
class Display {
 public:
  static Result<std::unique_ptr<Display>> open(const Egl& egl, EGLenum platform, void* native) {
    const std::lock_guard lock(mutex());
    const EGLDisplay display = egl.GetPlatformDisplayEXT(platform, native, nullptr);
    if (display == EGL_NO_DISPLAY) return egl_error(egl, "eglGetPlatformDisplay");
    if (users()[display] == 0 && !egl.Initialize(display, nullptr, nullptr))
      return egl_error(egl, "eglInitialize");
    ++users()[display];
    return std::unique_ptr<Display>(new Display(egl, display));
  }
  ~Display() {
    const std::lock_guard lock(mutex());
    if (--users()[display_] == 0) egl_.Terminate(display_);
  }
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;
  [[nodiscard]] EGLDisplay get() const { return display_; }

 private:
  Display(const Egl& egl, EGLDisplay display) : egl_(egl), display_(display) {}
  // Never destroyed: a context in a static variable may live longer than any other static.
  static std::mutex& mutex() {
    static auto& instance = *new std::mutex;
    return instance;
  }
  static std::map<EGLDisplay, int>& users() {
    static auto& instance = *new std::map<EGLDisplay, int>;
    return instance;
  }
  Egl egl_;
  EGLDisplay display_;
};

class EglSurface : public Surface {
 public:
  EglSurface(const Egl& egl, std::unique_ptr<Display> display, EGLContext context)
      : egl_(egl), display_(std::move(display)), context_(context) {}
  ~EglSurface() override {
    egl_.MakeCurrent(display_->get(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    egl_.DestroyContext(display_->get(), context_);
    egl_.ReleaseThread();
  }
  Status make_current() override {
    if (!egl_.MakeCurrent(display_->get(), EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      return egl_error(egl_, "eglMakeCurrent");
    return Done{};
  }
  void* proc_address(const char* name) const override {
    return reinterpret_cast<void*>(egl_.GetProcAddress(name));
  }

 private:
  Egl egl_;
  std::unique_ptr<Display> display_;
  EGLContext context_;
};

Result<std::unique_ptr<Surface>> open_surface(const Egl& egl, EGLenum platform, void* native) {
  auto display = Display::open(egl, platform, native);
  if (!display) return display.error();
  const EGLDisplay handle = (*display)->get();
  const char* extensions = egl.QueryString(handle, EGL_EXTENSIONS);
  for (const char* needed : {"EGL_KHR_surfaceless_context", "EGL_KHR_no_config_context"})
    if (!has_word(extensions, needed))
      return Error{ErrorCode::missing_backend, std::string("the display lacks ") + needed};
  if (!egl.BindAPI(EGL_OPENGL_API)) return egl_error(egl, "eglBindAPI(EGL_OPENGL_API)");
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               4,
                               EGL_CONTEXT_MINOR_VERSION,
                               5,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
  const EGLContext context =
      egl.CreateContext(handle, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
  if (context == EGL_NO_CONTEXT) return egl_error(egl, "eglCreateContext for OpenGL 4.5 core");
  return std::unique_ptr<Surface>(new EglSurface(egl, std::move(display).value(), context));
}

}  // namespace

std::vector<Candidate> egl_candidates(const std::string& library) {
  const auto loaded = load_egl(library);
  if (!loaded) {
    const Error error = loaded.error();
    return {{"EGL", [error]() -> Result<std::unique_ptr<Surface>> { return error; }}};
  }
  const Egl egl = *loaded;
  std::vector<Candidate> candidates;
  const bool surfaceless =
      has_word(egl.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_MESA_platform_surfaceless");
  candidates.push_back(
      {"EGL surfaceless", [egl, surfaceless]() {
         if (!surfaceless)
           return Result<std::unique_ptr<Surface>>(
               Error{ErrorCode::missing_backend, "no driver offers EGL_MESA_platform_surfaceless"});
         return open_surface(egl, EGL_PLATFORM_SURFACELESS_MESA, nullptr);
       }});
  EGLint count = 0;
  if (egl.QueryDevicesEXT == nullptr || !egl.QueryDevicesEXT(0, nullptr, &count)) return candidates;
  std::vector<EGLDeviceEXT> devices(count);
  if (!egl.QueryDevicesEXT(count, devices.data(), &count)) return candidates;
  for (EGLint i = 0; i < count; ++i) {
    EGLDeviceEXT device = devices[i];
    const bool software =
        egl.QueryDeviceStringEXT == nullptr ||
        has_word(egl.QueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
    candidates.push_back(
        {fmt::format("EGL device {}", i),
         [egl, device] { return open_surface(egl, EGL_PLATFORM_DEVICE_EXT, device); }, !software});
  }
  return candidates;
}

}  // namespace skylapse::gpu
