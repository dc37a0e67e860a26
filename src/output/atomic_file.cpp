#include "output/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "output/signal_guard.h"

namespace skylapse::output {
namespace fs = std::filesystem;
namespace {

/// A file descriptor that closes itself; close() reports what the delayed writes ran into.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return fd_; }
  [[nodiscard]] bool valid() const { return fd_ >= 0; }
  /// 0 or an errno. EINTR counts as closed on Linux.
  int close() {
    const int fd = std::exchange(fd_, -1);
    return ::close(fd) == 0 || errno == EINTR ? 0 : errno;
  }

 private:
  int fd_;
};

/// 0 or the errno that stopped it.
int write_all(int fd, std::span<const std::byte> bytes) {
  const SignalGuard no_xfsz(SIGXFSZ);
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    bytes = bytes.subspan(static_cast<size_t>(n));
  }
  return 0;
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

enum class Attempt { done, failed, unsupported };

struct Outcome {
  Attempt attempt;
  int error_number = 0;
};

/// Gives the nameless file behind `fd` the name `path`, replacing what is there.
Outcome link_into_place(int fd, const fs::path& path) {
  const std::string self = "/proc/self/fd/" + std::to_string(fd);
  const auto link_as = [&](const fs::path& name) {
    return ::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0 ? 0
                                                                                            : errno;
  };
  int e = link_as(path);
  if (e == 0) return {Attempt::done};
  // ENOENT: no /proc. The others: file systems that have nameless files but cannot link them.
  if (e == ENOENT || e == EOPNOTSUPP || e == EXDEV) return {Attempt::unsupported};
  if (e != EEXIST) return {Attempt::failed, e};
  const fs::path hidden = temporary_beside(path);
  if ((e = link_as(hidden)) != 0) return {Attempt::failed, e};
  if (::rename(hidden.c_str(), path.c_str()) == 0) return {Attempt::done};
  e = errno;
  ::unlink(hidden.c_str());
  return {Attempt::failed, e};
}

Outcome write_nameless(const fs::path& path, std::span<const std::byte> bytes) {
  Descriptor file(::open(folder_of(path).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666));
  if (!file.valid()) {
    // open(2): EOPNOTSUPP from the file system, EISDIR and ENOENT from kernels before O_TMPFILE.
    const bool unsupported =
        errno == EOPNOTSUPP || errno == EISDIR || errno == ENOENT || errno == EINVAL;
    return unsupported ? Outcome{Attempt::unsupported} : Outcome{Attempt::failed, errno};
  }
  if (const int e = write_all(file.get(), bytes)) return {Attempt::failed, e};
  return link_into_place(file.get(), path);
}

Outcome write_hidden(const fs::path& path, std::span<const std::byte> bytes) {
  const fs::path hidden = temporary_beside(path);
  Descriptor file(::open(hidden.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!file.valid()) return {Attempt::failed, errno};
  int e = write_all(file.get(), bytes);
  if (const int late = file.close(); e == 0) e = late;
  if (e == 0 && ::rename(hidden.c_str(), path.c_str()) != 0) e = errno;
  if (e == 0) return {Attempt::done};
  ::unlink(hidden.c_str());
  return {Attempt::failed, e};
}

std::string hint_for(int error_number) {
  switch (error_number) {
    case ENOSPC:
      return "the disk is full: free some space and run the same command again";
    case EDQUOT:
      return "your disk quota is used up: free some space and run the command again";
    case EFBIG:
      return "the file would pass the size limit (ulimit -f, or of the file system)";
    case EACCES:
    case EPERM:
      return "you may not write there: choose another output folder or change its rights";
    case EROFS:
      return "that file system is read-only: choose another output folder";
    case ENOTDIR:
    case EEXIST:
      return "a part of the path is a file, not a folder: rename one of them";
    case EISDIR:
      return "there is a folder of that name: choose another file name";
    case ENAMETOOLONG:
      return "choose a shorter name";
    case EMFILE:
    case ENFILE:
      return "too many open files: raise the limit (ulimit -n) or use fewer --jobs";
    case EIO:
      return "the storage device reported a fault";
    default:
      return "check the output folder and run the same command again";
  }
}

}  // namespace

Error write_error(const fs::path& path, int error_number) {
  return {.code = ErrorCode::write_failed,
          .message = "cannot write '" + path.string() +
                     "': " + std::generic_category().message(error_number),
          .hint = hint_for(error_number)};
}

Status make_parent_folders(const fs::path& path) {
  std::error_code ec;
  const fs::path folder = folder_of(path);
  fs::create_directories(folder, ec);
  if (!ec && !fs::is_directory(folder, ec) && !ec)
    ec = std::make_error_code(std::errc::not_a_directory);
  if (ec) return write_error(path, ec.value());
  return Done{};
}

Status publish(const fs::path& temporary, const fs::path& path) {
  if (::rename(temporary.c_str(), path.c_str()) == 0) return Done{};
  const Error error = write_error(path, errno);
  ::unlink(temporary.c_str());
  return error;
}

Status write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
  if (!path.has_filename()) return write_error(path, EISDIR);
  if (Status parents = make_parent_folders(path); !parents) return parents;
  Outcome outcome = write_nameless(path, bytes);
  if (outcome.attempt == Attempt::unsupported) outcome = write_hidden(path, bytes);
  if (outcome.attempt == Attempt::failed) return write_error(path, outcome.error_number);
  return Done{};
}

Result<std::vector<std::byte>> read_file(const fs::path& path) {
  const auto failure = [&](int error_number) {
    return Error{.code = ErrorCode::missing_input,
                 .message = "cannot read '" + path.string() +
                            "': " + std::generic_category().message(error_number)};
  };
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.valid()) return failure(errno);
  struct stat info {};
  if (::fstat(file.get(), &info) != 0) return failure(errno);
  // One byte beyond the size, so that the end of an unchanged file shows without growing.
  std::vector<std::byte> bytes(info.st_size > 0 ? static_cast<size_t>(info.st_size) + 1 : 4096);
  size_t used = 0;
  for (;;) {
    const ssize_t n = ::read(file.get(), bytes.data() + used, bytes.size() - used);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return failure(errno);
    if (n == 0) break;
    used += static_cast<size_t>(n);
    if (used == bytes.size()) bytes.resize(2 * used);
  }
  bytes.resize(used);
  return bytes;
}

}  // namespace skylapse::output
