#include "output/streamed_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
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

}  // namespace

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

/// Read again: a writer may have gone back to fill in its tables.
Result<StreamedFile::Published> StreamedFile::hashed() {
  constexpr size_t kPiece = size_t{1} << 20;
  std::vector<std::byte> piece(kPiece);
  Sha256 hash;
  Published all;
  for (;;) {
    const ssize_t n = ::pread(descriptor_, piece.data(), piece.size(), off_t(all.bytes));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return write_error(path_, errno);
    if (n == 0) break;
    hash.update(std::span(piece).first(size_t(n)));
    all.bytes += uintmax_t(n);
  }
  all.sha256 = hash.hex();
  return all;
}

Result<StreamedFile::Published> StreamedFile::publish() {
  const Stopwatch watch(milliseconds_);
  if (const Status so_far = status(); !so_far) return so_far.error();
  auto all = hashed();
  if (!all) return all;
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
