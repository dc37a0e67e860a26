#include "cli/console.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>

namespace skylapse::cli {

ExitCode exit_code_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::invalid_input:
      return ExitCode::invalid_input;
    case ErrorCode::missing_input:
      return ExitCode::missing_input;
    case ErrorCode::missing_backend:
      return ExitCode::missing_backend;
    case ErrorCode::write_failed:
      return ExitCode::write_failed;
    case ErrorCode::interrupted:
      return ExitCode::interrupted;
    case ErrorCode::internal:
      break;
  }
  return ExitCode::internal;
}

bool use_color(std::FILE* stream) {
  const char* no_color = std::getenv("NO_COLOR");
  return (no_color == nullptr || *no_color == '\0') && isatty(fileno(stream)) != 0;
}

ExitCode report(const Error& error) {
  std::string text = format_error(error);
  if (use_color(stderr))
    if (const size_t at = text.find("error:"); at != std::string::npos)
      text.replace(at, 6, "\033[1;31merror:\033[0m");
  std::fprintf(stderr, "%s\n", text.c_str());
  return exit_code_of(error.code);
}

ExitCode report(const Diagnostics& errors) {
  ExitCode code = ExitCode::internal;
  for (size_t i = 0; i < errors.size(); ++i) {
    const ExitCode this_code = report(errors[i]);
    if (i == 0) code = this_code;
  }
  if (errors.size() > 1) std::fprintf(stderr, "%zu errors\n", errors.size());
  return code;
}

void note(const ConsoleOptions& console, const std::string& text) {
  if (!console.quiet) std::fprintf(stderr, "%s\n", text.c_str());
}

namespace {

int g_stdout_error = 0;  // errno of the first write to stdout that failed

}  // namespace

void print(const std::string& text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() && g_stdout_error == 0)
    g_stdout_error = errno;
}

ExitCode finish_stdout(ExitCode code) {
  errno = 0;
  if (std::fflush(stdout) != 0 && g_stdout_error == 0) g_stdout_error = errno;
  if (g_stdout_error == 0 && std::ferror(stdout) == 0) return code;
  if (g_stdout_error == EPIPE) return code;
  std::fprintf(stderr, "error: standard output could not be written\n");
  return code == ExitCode::done ? ExitCode::write_failed : code;
}

}  // namespace skylapse::cli
