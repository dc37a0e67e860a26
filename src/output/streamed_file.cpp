#include "output/streamed_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <system_error>
#include <utility>
#include <vector>

#include "core/sha256.h"
#include "output/atomic_file.h"
#include "output/signal_guard.h"

namespace skylapse::output {
namespace {

class Stopwatch {
 public:
  explicit Stopwatch(double& milliseconds) : milliseconds_(milliseconds) {}
  ~Stopwatch() {
    milliseconds_ += std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& milliseconds_;
  Clock::time_point start_ = Clock::now();
};

/// 0 or the errno that stopped it.
int hash_all(int descriptor, FileHash& all) {
  constexpr size_t kPiece = size_t{1} << 20;
  std::vector<std::byte> piece(kPiece);
  Sha256 hash;
  for (;;) {
    const ssize_t n = ::pread(descriptor, piece.data(), piece.size(), off_t(all.bytes));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    if (n == 0) break;
    hash.update(std::span(piece).first(size_t(n)));
    all.bytes += uintmax_t(n);
  }
  all.sha256 = hash.hex();
  return 0;
}

}  // namespace

Result<FileHash> hash_of_file(const std::filesystem::path& path) {
  const auto failure = [&](int error_number) {
    return Error{.code = ErrorCode::missing_input,
                 .message = "cannot read '" + path.string() +
                            "': " + std::generic_category().message(error_number)};
  };
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return failure(errno);
  FileHash all;
  const int failed = hash_all(descriptor, all);
  ::close(descriptor);
  if (failed != 0) return failure(failed);
  return all;
}

StreamedFile::StreamedFile(std::filesystem::path path, std::filesystem::path temporary,
                           int descriptor)
    : path_(std::move(path)), temporary_(std::move(temporary)), descriptor_(descriptor) {}

Result<std::unique_ptr<StreamedFile>> StreamedFile::create(const std::filesystem::path& path) {
  if (!path.has_filename()) return write_error(path, EISDIR);
  if (const Status parents = make_parent_folders(path); !parents) return parents.error();
  const auto temporary = temporary_beside(path);
  const int descriptor = ::open(temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) return write_error(path, errno);
  return std::unique_ptr<StreamedFile>(new StreamedFile(path, temporary, descriptor));
}

StreamedFile::~StreamedFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(temporary_.c_str());
}

bool StreamedFile::write_at(uint64_t offset, std::span<const std::byte> bytes) {
  const Stopwatch watch(milliseconds_);
  const SignalGuard no_size_signal(SIGXFSZ);
  while (!bytes.empty() && error_number_ == 0) {
    const ssize_t n = ::pwrite(descriptor_, bytes.data(), bytes.size(), off_t(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      error_number_ = n < 0 ? errno : ENOSPC;
      break;
    }
    bytes = bytes.subspan(size_t(n));
    offset += uint64_t(n);
  }
  return error_number_ == 0;
}

Status StreamedFile::status() const {
  if (error_number_ != 0) return write_error(path_, error_number_);
  return Done{};
}

Result<FileHash> StreamedFile::publish() {
  const Stopwatch watch(milliseconds_);
  if (const Status so_far = status(); !so_far) return so_far.error();
  // Read again: a writer may have gone back to fill in its tables.
  FileHash all;
  if (const int failed = hash_all(descriptor_, all)) return write_error(path_, failed);
  // Delayed writes report here. EINTR counts as closed on Linux.
  const int closed = ::close(std::exchange(descriptor_, -1));
  if (closed != 0 && errno != EINTR) {
    const Error error = write_error(path_, errno);
    ::unlink(temporary_.c_str());
    return error;
  }
  if (const Status named = skylapse::output::publish(temporary_, path_); !named)
    return named.error();
  return all;
}

}  // namespace skylapse::output
