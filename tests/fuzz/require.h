#pragma once
// Laws in fuzz targets: on in every build, and fatal so that the fuzzer keeps the input.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "core/result.h"

namespace skylapse::fuzz {

inline void require(bool holds, std::string_view law, std::string_view detail = {}) {
  if (holds) return;
  const std::string line = "broken law: " + std::string(law) + ": " + std::string(detail) + "\n";
  std::fputs(line.c_str(), stderr);
  std::abort();
}

/// Well-formed UTF-8 without control characters other than tab and line end (RFC 3629).
bool is_clean_text(std::string_view text);

/// Laws of every message that a user may see: it has words, clean text, a place that makes sense,
/// and can be printed.
void require_printable(const Diagnostics& errors);

}  // namespace skylapse::fuzz
