#include "output/imageio/isolated_read.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <mutex>
#include <type_traits>
#include <utility>

#include "output/imageio/reader_choice.h"

namespace skylapse::output::imageio {
namespace {

constexpr unsigned kSeconds = 10;

/// Values through a pipe, in the order in which they are given; false once anything failed.
class PipeEnd {
 public:
  enum class Way { out, in };
  PipeEnd(int file, Way way) : file_(file), way_(way) {}
  [[nodiscard]] bool good() const { return good_; }

  void bytes(void* data, size_t size) {
    auto* at = static_cast<char*>(data);
    while (good_ && size > 0) {
      const ssize_t done = way_ == Way::out ? ::write(file_, at, size) : ::read(file_, at, size);
      if (done < 0 && errno == EINTR) continue;
      good_ = done > 0;
      if (!good_) break;
      at += done;
      size -= size_t(done);
    }
  }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void value(T& v) { bytes(&v, sizeof v); }
  void value(std::string& text) { container(text); }
  void value(std::vector<float>& numbers) { container(numbers); }
  template <class T>
  void value(std::vector<T>& list) {
    resize(list);
    for (T& item : list) value(item);
  }
  void value(Attribute& a) {
    value(a.name);
    size_t kind = a.value.index();
    value(kind);
    if (way_ == Way::in) a.value = of_kind(kind);
    std::visit([this](auto& v) { value(v); }, a.value);
  }
  void value(ReadImage& image) {
    value(image.format);
    value(image.compression);
    value(image.part_name);
    value(image.parts);
    value(image.width);
    value(image.height);
    value(image.channels);
    value(image.storage);
    value(image.samples);
    value(image.attributes);
  }

 private:
  static decltype(Attribute::value) of_kind(size_t kind) {
    switch (kind) {
      case 1:
        return 0.0F;
      case 2:
        return 0.0;
      case 3:
        return std::string();
      case 4:
        return std::vector<float>();
      default:
        return 0;
    }
  }
  template <class Container>
  void resize(Container& container) {
    uint64_t size = container.size();
    value(size);
    if (way_ == Way::in && good_) container.resize(size);
  }
  template <class Container>
  void container(Container& container) {
    resize(container);
    if (good_) bytes(container.data(), container.size() * sizeof(container[0]));
  }
  int file_;
  Way way_;
  bool good_ = true;
};

/// Memory of this process and what a picture may take, twice over.
void bound_resources(const ReadLimits& limits) {
  rlimit time{kSeconds, kSeconds};
  ::setrlimit(RLIMIT_CPU, &time);
  ::alarm(2 * kSeconds);
  rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const uint64_t page = uint64_t(::sysconf(_SC_PAGESIZE));
  const rlim_t most =
      pages * page + 2 * std::min<uint64_t>(limits.bytes, 1ull << 40) + (1ull << 30);
  rlimit memory{most, most};
  ::setrlimit(RLIMIT_AS, &memory);
#else
  (void)limits;
#endif
}

[[noreturn]] void run_child(int pipe, const ReadLimits& limits,
                            const std::function<Result<ReadImage>()>& read) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGALRM, SIGXCPU})
    std::signal(signal, SIG_DFL);
  std::signal(SIGINT, SIG_IGN);  // the parent decides
  if (const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0)
    ::dup2(nowhere, STDERR_FILENO);
  bound_resources(limits);
  auto result = read();
  PipeEnd out(pipe, PipeEnd::Way::out);
  bool ok = result.ok();
  out.value(ok);
  if (ok) {
    out.value(result.value());
  } else {
    Error error = result.error();
    out.value(error.message);
  }
  ::_exit(0);
}

std::string why_it_ended(int status) {
  if (!WIFSIGNALED(status)) return "it is damaged";
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU || signal == SIGALRM || signal == SIGKILL)
    return "reading it takes too long";
  return "it is damaged: its reader crashed (signal " + std::to_string(signal) + ")";
}

}  // namespace

std::shared_mutex& library_in_use() {
  static std::shared_mutex mutex;
  return mutex;
}

Result<ReadImage> read_in_child(const std::string& path, const ReadLimits& limits,
                                const std::function<Result<ReadImage>()>& read) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return unreadable(path, std::strerror(errno));
  pid_t child = -1;
  {
    const std::unique_lock alone(library_in_use());
    child = ::fork();
    if (child == 0) {
      ::close(ends[0]);
      run_child(ends[1], limits, read);
    }
  }
  const int failed = errno;
  ::close(ends[1]);
  if (child < 0) {
    ::close(ends[0]);
    return unreadable(path, std::strerror(failed));
  }
  PipeEnd in(ends[0], PipeEnd::Way::in);
  bool ok = false;
  ReadImage image;
  std::string why;
  in.value(ok);
  if (ok)
    in.value(image);
  else
    in.value(why);
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!in.good()) return unreadable(path, why_it_ended(status));
  if (!ok) return Error{.code = ErrorCode::missing_input, .message = why};
  return image;
}

}  // namespace skylapse::output::imageio
