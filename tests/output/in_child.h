#pragma once
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

namespace skylapse::output {

/// Exit status of a child that could not set up what it wanted to test.
inline constexpr int kCannotSetUp = 77;

/// Runs `body` in a forked child and returns its exit status (128 + signal if it was killed).
/// The child shares nothing that the test could damage: limits, mounts, user ids.
inline int in_child(const std::function<int()>& body) {
  const pid_t pid = ::fork();
  if (pid == 0) ::_exit(body());
  int status = 0;
  ::waitpid(pid, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace skylapse::output
