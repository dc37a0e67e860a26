#pragma once
// A program run as a child, fed through its standard input. No shell is involved.
#include <sys/types.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"

namespace skylapse::output {

/// The first executable file `name` along PATH. Relative entries of PATH are passed over.
std::optional<std::string> find_program(const std::string& name);

/// A running child. What it prints (standard output and error) is kept in memory. It forms a
/// process group of its own, so that a Ctrl-C meant for us does not end it half way. A child that
/// is not waited for is killed by the destructor.
class ChildProcess {
 public:
  /// `arguments` without the program's name. Error: internal, with the system's reason.
  static Result<ChildProcess> start(const std::string& program,
                                    const std::vector<std::string>& arguments);
  /// Hands bytes to the child's standard input; 0 or an errno (EPIPE: it reads no more).
  int write(std::span<const std::byte> bytes);
  /// Closes the child's input and waits for its end. Its exit status, or 128 + signal; -1 if it
  /// was waited for before.
  int wait();
  /// All it printed so far.
  [[nodiscard]] std::string printed() const;

  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  ~ChildProcess();

 private:
  ChildProcess(pid_t pid, int input, int print) : pid_(pid), input_(input), print_(print) {}
  void close_input();
  void kill_and_close();

  pid_t pid_ = -1;
  int input_ = -1;
  int print_ = -1;
};

}  // namespace skylapse::output
