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

/// Text to stdout as it is.
void print(const std::string& text);

/// Flushes stdout; a full disk or closed pipe there is an error of its own.
ExitCode finish_stdout(ExitCode code);

}  // namespace skylapse::cli
