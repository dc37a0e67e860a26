#include "output/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <utility>

#include "output/signal_guard.h"

extern char** environ;

namespace skylapse::output {
namespace {

Error cannot_start(const std::string& program, int error_number) {
  return {
      .code = ErrorCode::internal,
      .message = "cannot start " + program + ": " + std::generic_category().message(error_number)};
}

/// What the child starts with: its own group, default signals, nothing blocked.
class SpawnAttributes {
 public:
  SpawnAttributes() {
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setpgroup(&attributes_, 0);
    sigset_t set;
    sigemptyset(&set);
    posix_spawnattr_setsigmask(&attributes_, &set);
    for (const int signal : {SIGPIPE, SIGINT, SIGTERM, SIGHUP}) sigaddset(&set, signal);
    posix_spawnattr_setsigdefault(&attributes_, &set);
    posix_spawnattr_setflags(
        &attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~SpawnAttributes() { posix_spawnattr_destroy(&attributes_); }
  SpawnAttributes(const SpawnAttributes&) = delete;
  SpawnAttributes& operator=(const SpawnAttributes&) = delete;
  [[nodiscard]] const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_;
};

int spawn(const std::string& program, const std::vector<std::string>& arguments, int input,
          int print, pid_t* pid) {
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, print, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, print, STDERR_FILENO);
  const SpawnAttributes attributes;
  const int e = posix_spawn(pid, program.c_str(), &actions, attributes.get(), argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return e;
}

}  // namespace

std::optional<std::string> find_program(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "";
  while (!rest.empty()) {
    const size_t colon = rest.find(':');
    const std::string_view folder = rest.substr(0, colon);
    rest.remove_prefix(colon == std::string_view::npos ? rest.size() : colon + 1);
    if (!folder.starts_with('/')) continue;
    const std::string candidate = std::string(folder) + "/" + name;
    struct stat info {};
    if (::stat(candidate.c_str(), &info) == 0 && S_ISREG(info.st_mode) &&
        ::access(candidate.c_str(), X_OK) == 0)
      return candidate;
  }
  return {};
}

Result<ChildProcess> ChildProcess::start(const std::string& program,
                                         const std::vector<std::string>& arguments) {
  int ends[2] = {-1, -1};
  const int print = ::memfd_create("skylapse-child", MFD_CLOEXEC);
  if (print < 0) return cannot_start(program, errno);
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    const int e = errno;
    ::close(print);
    return cannot_start(program, e);
  }
  ::fcntl(ends[1], F_SETPIPE_SZ, 1 << 20);  // fewer switches between us and the child; may fail
  pid_t pid = -1;
  const int e = spawn(program, arguments, ends[0], print, &pid);
  ::close(ends[0]);
  if (e != 0) {
    ::close(ends[1]);
    ::close(print);
    return cannot_start(program, e);
  }
  return ChildProcess(pid, ends[1], print);
}

int ChildProcess::write(std::span<const std::byte> bytes) {
  const SignalGuard no_sigpipe(SIGPIPE);
  while (!bytes.empty()) {
    const ssize_t n = ::write(input_, bytes.data(), bytes.size());
    if (n < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    bytes = bytes.subspan(static_cast<size_t>(n));
  }
  return 0;
}

int ChildProcess::wait() {
  close_input();
  if (pid_ <= 0) return -1;  // already waited for; waitpid would take it for "any child"
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0)
    if (errno != EINTR) return -1;  // somebody else reaped it (SIGCHLD ignored)
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string ChildProcess::printed() const {
  const off_t size = ::lseek(print_, 0, SEEK_END);
  std::string text(static_cast<size_t>(size > 0 ? size : 0), ' ');
  const ssize_t n = ::pread(print_, text.data(), text.size(), 0);
  text.resize(static_cast<size_t>(n > 0 ? n : 0));
  return text;
}

void ChildProcess::close_input() {
  if (const int fd = std::exchange(input_, -1); fd >= 0) ::close(fd);
}

void ChildProcess::kill_and_close() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    wait();
  }
  close_input();
  if (const int fd = std::exchange(print_, -1); fd >= 0) ::close(fd);
}

ChildProcess::ChildProcess(ChildProcess&& o) noexcept
    : pid_(std::exchange(o.pid_, -1)),
      input_(std::exchange(o.input_, -1)),
      print_(std::exchange(o.print_, -1)) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& o) noexcept {
  if (this != &o) {
    kill_and_close();
    pid_ = std::exchange(o.pid_, -1);
    input_ = std::exchange(o.input_, -1);
    print_ = std::exchange(o.print_, -1);
  }
  return *this;
}

ChildProcess::~ChildProcess() { kill_and_close(); }

}  // namespace skylapse::output
