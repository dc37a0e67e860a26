#include "config/yaml_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/yaml_reader.h"
#include "core/printable.h"

namespace skylapse::config {
namespace {

/// Where the quote that `rest` begins with is closed; its size if it is not.
size_t closing_quote(std::string_view rest) {
  const char quote = rest[0];
  size_t at = 1;
  while (at < rest.size()) {
    const bool escape = quote == '"'
                            ? rest[at] == '\\'
                            : rest[at] == quote && at + 1 < rest.size() && rest[at + 1] == quote;
    if (!escape && rest[at] == quote) return at;
    at += escape ? 2 : 1;
  }
  return rest.size();
}

}  // namespace

std::string normalised_text(std::string text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  if (text.find('\r') == std::string::npos) return text;
  std::string lines;
  lines.reserve(text.size());
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\r')
      lines += text[i];
    else if (i + 1 == text.size() || text[i + 1] != '\n')
      lines += '\n';
  }
  return lines;
}

ScalarExtent scalar_extent(std::string_view rest, std::string_view value) {
  ScalarExtent extent;
  while (extent.begin < rest.size() && (rest[extent.begin] == '&' || rest[extent.begin] == '!')) {
    const size_t blank = rest.find_first_of(" \t", extent.begin);
    const size_t next = rest.find_first_not_of(" \t", std::min(blank, rest.size()));
    if (next == std::string_view::npos) break;
    extent.begin = next;
  }
  rest.remove_prefix(std::min(extent.begin, rest.size()));
  if (!rest.empty() && (rest[0] == '"' || rest[0] == '\'')) {
    extent.quotes = true;
    const size_t end = closing_quote(rest);
    extent.closed = end < rest.size();
    extent.length = std::min(end + 1, rest.size());
    extent.verbatim = extent.closed && rest.substr(1, end - 1) == value;
  } else if (!value.empty() && rest.starts_with(value)) {
    extent.length = value.size();
    extent.verbatim = true;
  } else {
    const size_t last = rest.find_last_not_of(" \t");
    extent.length = last == std::string_view::npos ? 1 : last + 1;
  }
  return extent;
}

std::optional<BadByte> first_bad_byte(std::string_view text) {
  for (size_t i = 0; i < text.size();) {
    const auto b = static_cast<unsigned char>(text[i]);
    if ((b < 0x20 && b != '\t' && b != '\n') || b == 0x7F)
      return BadByte{
          i, fmt::format("this is not a text file: it holds the control character 0x{:02x}", b)};
    const size_t length = utf8_length(text, i);
    if (length == 0)
      return BadByte{i, fmt::format("this is not text in UTF-8: byte 0x{:02x} is out of place", b)};
    i += length;
  }
  return std::nullopt;
}

Place place_of_byte(const SourceSet& sources, int source, size_t offset) {
  const std::string& text = sources.text(source);
  const auto at = text.begin() + std::min(offset, text.size());
  const size_t line_start = text.rfind('\n', offset == 0 ? std::string::npos : offset - 1);
  const bool first_line = offset == 0 || line_start == std::string::npos;
  return {source, int(std::count(text.begin(), at, '\n')) + 1,
          int(first_line ? offset : offset - line_start - 1) + 1, 1};
}

}  // namespace skylapse::config
