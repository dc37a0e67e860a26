#pragma once
// What a person sees: data on stdout, messages and progress on stderr.
#include <cstdio>
#include <string>

#include "cli/exit_code.h"
#include "core/result.h"

namespace skylapse::cli {

struct ConsoleOptions {
  bool quiet = false;
  bool json = false;  // stdout carries one JSON document and nothing else
};

/// True if `stream` is a terminal and NO_COLOR is not set.
bool use_color(std::FILE* stream);

/// Prints each error to stderr; returns the exit code of the first.
ExitCode report(const Diagnostics& errors);
ExitCode report(const Error& error);

/// A message to stderr, unless quiet.
void note(const ConsoleOptions& console, const std::string& text);

/// Text to stdout as it is. What cannot be written is reported by finish_stdout.
void print(const std::string& text);

/// A JSON document as text. Names of files need not be UTF-8, JSON must be: other bytes are
/// replaced.
template <class Json>
std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Flushes stdout. A full disk or a closed descriptor there is an error of its own (exit 6). A
/// reader that has gone (`skylapse plan scene.yaml | head`) is none: it has what it wanted, so the
/// command ends quietly with the code of its own work.
ExitCode finish_stdout(ExitCode code);

}  // namespace skylapse::cli
