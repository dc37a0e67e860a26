#pragma once
// Small jobs as text, and what the config makes of them.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "config/job_config.h"

namespace skylapse::config::test {

/// The smallest job: everything else has a default.
inline const std::string kSmallJob =
    "location: {latitude: 50.0755 deg, longitude: 14.4378 deg}\n"
    "time: {zone: Europe/Prague, date: 2026-06-21, step: 10 min}\n"
    "camera: {look_at: west}\n"
    "outputs: [{image: sky.####.png}]\n";

/// `text` with the first `from` replaced; an empty text if `from` is not there, which no job is.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  return at == std::string::npos ? std::string() : text.replace(at, from.size(), to);
}

/// What the caret line of a message underlines.
inline std::string underlined(const SourceSpan& span) {
  std::string text;
  int character = 0;
  for (const char c : span.source_line) {
    if ((c & 0xC0) != 0x80) ++character;
    if (character >= span.column && character < span.column + span.length) text += c;
  }
  return text;
}

/// "line [underlined text] message | hint" of every error, in order; nothing for a good job.
inline std::vector<std::string> errors_of(const std::string& text,
                                          const std::vector<Override>& overrides = {}) {
  std::vector<std::string> lines;
  const auto job = parse_job(text, "job.yaml", overrides);
  if (job) return lines;
  for (const Error& e : job.error()) {
    const std::string file = e.span.file == "job.yaml" ? "" : e.span.file + ":";
    lines.push_back(
        fmt::format("{}{} [{}] {} | {}", file, e.span.line, underlined(e.span), e.message, e.hint));
  }
  return lines;
}

/// The only error of a text; all of them, joined, if there is not just one.
inline std::string error_of(const std::string& text, const std::vector<Override>& overrides = {}) {
  const auto errors = errors_of(text, overrides);
  return errors.empty() ? "no error" : fmt::format("{}", fmt::join(errors, "\n"));
}

}  // namespace skylapse::config::test
