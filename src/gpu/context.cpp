#include "gpu/context.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <future>
#include <mutex>
#include <thread>

#include "gpu/backends.h"
#include "gpu/functions.h"

namespace skylapse::gpu {
namespace {

constexpr const char* kInstallEgl = "install the packages libegl1 and libgl1-mesa-dri";
constexpr const char* kInstallOsMesa = "install the package libosmesa6";

/// Runs tasks one after the other on one thread of its own.
class Worker {
 public:
  Worker() : thread_([this] { loop(); }) {}
  ~Worker() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }
  [[nodiscard]] bool is_current() const { return std::this_thread::get_id() == thread_.get_id(); }
  void post(std::function<void()> task) {
    {
      const std::lock_guard lock(mutex_);
      tasks_.push_back(std::move(task));
    }
    wake_.notify_one();
  }
  Status run(const std::function<Status()>& task) {
    std::packaged_task<Status()> packaged(task);
    auto result = packaged.get_future();
    post([&packaged] { packaged(); });
    return result.get();
  }

 private:
  void loop() {
    std::unique_lock lock(mutex_);
    while (true) {
      wake_.wait(lock, [this] { return stopping_ || !tasks_.empty(); });
      if (tasks_.empty()) return;
      const auto task = std::move(tasks_.front());
      tasks_.pop_front();
      lock.unlock();
      task();
      lock.lock();
    }
  }
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> tasks_;
  bool stopping_ = false;
  std::thread thread_;  // last: it uses all of the above
};

Status load_functions(const Surface& surface, Functions& functions) {
  std::string missing;
#define SKYLAPSE_GL_LOAD(name, upper)                                                      \
  functions.name = reinterpret_cast<PFNGL##upper##PROC>(surface.proc_address("gl" #name)); \
  if (functions.name == nullptr) missing += " gl" #name;
  SKYLAPSE_GL_FUNCTIONS(SKYLAPSE_GL_LOAD)
#undef SKYLAPSE_GL_LOAD
  if (!missing.empty()) return Error{ErrorCode::missing_backend, "the driver lacks" + missing};
  return Done{};
}

std::string text_of(const Functions& gl, GLenum name) {
  const auto* text = gl.GetString(name);
  return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

bool is_software(const std::string& renderer) {
  return std::ranges::any_of(
      std::vector<std::string>{"llvmpipe", "softpipe", "swrast", "SWR", "Software Rasterizer"},
      [&](const std::string& name) { return renderer.find(name) != std::string::npos; });
}

class ThreadedContext : public Context {
 public:
  ~ThreadedContext() override {
    if (worker_->is_current()) {
      // The last reference was let go by work of the context itself: a thread cannot join itself.
      surface_.reset();
      std::thread([worker = std::move(worker_)] {}).detach();
      return;
    }
    worker_->post([this] { surface_.reset(); });
    worker_.reset();
  }

  Status open(const Candidate& candidate) {
    return worker_->run([&]() -> Status {
      auto surface = candidate.open();
      if (!surface) return surface.error();
      surface_ = std::move(surface).value();
      Status status = surface_->make_current();
      if (status) status = load_functions(*surface_, functions_);
      if (status) status = learn(candidate.what);
      if (!status) surface_.reset();
      return status;
    });
  }

  [[nodiscard]] const ContextInfo& info() const override { return info_; }
  void set_attempts(std::vector<Attempt> attempts) { info_.attempts = std::move(attempts); }

  Status run(const std::function<Status(const Functions&)>& work) override {
    if (worker_->is_current()) return work(functions_);  // the outer run looks at the errors
    return worker_->run([&] { return guarded(work); });
  }
  void post(std::function<void(const Functions&)> work) override {
    if (worker_->is_current()) return work(functions_);
    worker_->post([this, work = std::move(work)] { work(functions_); });
  }
  void set_activity(std::string activity) override { activity_ = std::move(activity); }

 private:
  Status learn(const std::string& what) {
    const Functions& gl = functions_;
    GLint major = 0, minor = 0;
    gl.GetIntegerv(GL_MAJOR_VERSION, &major);
    gl.GetIntegerv(GL_MINOR_VERSION, &minor);
    if (major * 10 + minor < 45)
      return Error{ErrorCode::missing_backend,
                   fmt::format("OpenGL {}.{} where 4.5 is needed", major, minor)};
    functions_.context = this;
    info_.backend = what;
    info_.vendor = text_of(gl, GL_VENDOR);
    info_.renderer = text_of(gl, GL_RENDERER);
    info_.version = text_of(gl, GL_VERSION);
    info_.software = is_software(info_.renderer);
    gl.GetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &info_.max_texture_3d);
    gl.Enable(GL_DEBUG_OUTPUT);
    gl.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    // Compilers report through the program's log, where lines can be mapped (gpu/program.h).
    gl.DebugMessageControl(GL_DEBUG_SOURCE_SHADER_COMPILER, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr,
                           GL_FALSE);
    gl.DebugMessageCallback(&ThreadedContext::on_message, this);
    return Done{};
  }

  static void APIENTRY on_message(GLenum, GLenum type, GLuint, GLenum, GLsizei length,
                                  const GLchar* text, const void* user) {
    if (type != GL_DEBUG_TYPE_ERROR && type != GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR) return;
    auto* self = static_cast<ThreadedContext*>(const_cast<void*>(user));
    self->messages_.push_back(
        (self->activity_.empty() ? "" : self->activity_ + ": ") +
        std::string(text, length >= 0 ? size_t(length) : std::char_traits<char>::length(text)));
  }

  /// Work, then what GL said about it. glGetError catches drivers that send no messages.
  Status guarded(const std::function<Status(const Functions&)>& work) {
    messages_.clear();
    Status status = work(functions_);
    const GLenum code = functions_.GetError();
    if (code != GL_NO_ERROR && messages_.empty())
      messages_.push_back(
          fmt::format("{}{}error 0x{:04x}", activity_, activity_.empty() ? "" : ": ", code));
    while (functions_.GetError() != GL_NO_ERROR) {
    }
    activity_.clear();
    if (!status || messages_.empty()) return status;
    return Error{ErrorCode::internal,
                 fmt::format("OpenGL ({}): {}", info_.renderer, fmt::join(messages_, "; "))};
  }

  ContextInfo info_;
  Functions functions_;
  std::string activity_;
  std::vector<std::string> messages_;
  std::unique_ptr<Surface> surface_;
  std::unique_ptr<Worker> worker_ = std::make_unique<Worker>();
};

std::vector<Candidate> candidates_for(Backend backend, const Libraries& libraries) {
  std::vector<Candidate> candidates;
  if (backend != Backend::osmesa) candidates = egl_candidates(libraries.egl);
  if (backend != Backend::egl) candidates.push_back(osmesa_candidate(libraries.osmesa));
  return candidates;
}

Error nothing_works(Backend backend, const std::vector<Attempt>& attempts) {
  std::string message = "no OpenGL 4.5 context";
  for (const Attempt& attempt : attempts)
    message += fmt::format("; {}: {}", attempt.what, attempt.reason);
  const std::string hint = backend == Backend::egl ? kInstallEgl
                           : backend == Backend::osmesa
                               ? kInstallOsMesa
                               : fmt::format("{}, or {}", kInstallEgl, "libosmesa6");
  return {ErrorCode::missing_backend, message, {}, hint};
}

}  // namespace

Result<void*> open_library(const std::string& name) {
  void* library = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* reason = dlerror();
    return Error{ErrorCode::missing_backend, reason == nullptr ? name + " not found" : reason};
  }
  return library;
}

Result<std::shared_ptr<Context>> create_context(Backend backend, const Libraries& libraries) {
  std::vector<Attempt> attempts;
  std::shared_ptr<ThreadedContext> taken;
  size_t taken_at = 0;
  for (const Candidate& candidate : candidates_for(backend, libraries)) {
    // A context in software is kept while a graphics card may still follow.
    if (taken && !candidate.hardware) continue;
    auto context = std::make_shared<ThreadedContext>();
    const Status opened = context->open(candidate);
    attempts.push_back({candidate.what, opened ? "" : opened.error().message});
    if (opened && taken && context->info().software) attempts.back().reason = "in software too";
    if (!opened || (taken && context->info().software)) continue;
    if (taken) attempts[taken_at].reason = "in software, and a graphics card was found";
    taken = std::move(context);
    taken_at = attempts.size() - 1;
    if (!taken->info().software) break;
  }
  if (!taken) return nothing_works(backend, attempts);
  std::rotate(attempts.begin() + taken_at, attempts.begin() + taken_at + 1, attempts.end());
  taken->set_attempts(attempts);
  return std::shared_ptr<Context>(std::move(taken));
}

Result<std::shared_ptr<Context>> Context::create(Backend backend) {
  return create_context(backend, {});
}

}  // namespace skylapse::gpu
