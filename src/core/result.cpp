#include "core/result.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/printable.h"

namespace skylapse {
namespace {

size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = std::exchange(row[0], i);
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

/// Keeps tabs, so that the caret stands under the character whatever the tab width is.
std::string caret_indent(const std::string& line, int column) {
  std::string indent;
  for (int i = 0; i + 1 < column; ++i)
    indent += (static_cast<size_t>(i) < line.size() && line[i] == '\t') ? '\t' : ' ';
  return indent;
}

}  // namespace

std::string format_error(const Error& error) {
  const SourceSpan& s = error.span;
  std::string text;
  if (s.line > 0)
    text = fmt::format("{}:{}:{}: error: {}", s.file, s.line, s.column, error.message);
  else
    text = fmt::format("{}{}error: {}", s.file, s.file.empty() ? "" : ": ", error.message);
  if (s.line > 0 && !s.source_line.empty()) {
    const int tildes = std::max(0, s.length - 1);
    text += fmt::format("\n{:5} | {}\n      | {}^{}", s.line, s.source_line,
                        caret_indent(s.source_line, s.column), std::string(tildes, '~'));
    if (!error.hint.empty()) text += "  " + error.hint;
  } else if (!error.hint.empty()) {
    text += "\n  " + error.hint;
  }
  return printable(text);
}

std::optional<std::string> nearest_name(const std::string& word,
                                        const std::vector<std::string>& candidates) {
  std::optional<std::string> best;
  size_t best_distance = 1 + std::max<size_t>(1, word.size() / 3);
  for (const std::string& candidate : candidates) {
    const size_t d = edit_distance(word, candidate);
    if (d < best_distance) best_distance = d, best = candidate;
  }
  return best;
}

}  // namespace skylapse
