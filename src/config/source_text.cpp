#include "config/source_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "core/printable.h"

namespace skylapse::config {
namespace {

constexpr size_t kLongestShownLine = 240;

bool is_control(char c) { return (c >= 0 && c < 0x20 && c != '\t') || c == 0x7F; }

/// Values are quoted in messages: one line, nothing that would steer a terminal.
std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', '?');
  return printable(text);
}

}  // namespace

int SourceSet::add(std::string name, std::string text) {
  sources_.push_back({std::move(name), {}, {}, {}});
  const int source = int(sources_.size()) - 1;
  set_text(source, std::move(text));
  return source;
}

void SourceSet::set_text(int source, std::string text) {
  Source& s = sources_[source];
  s.text = std::move(text);
  s.line_starts = {0};
  s.continuations.clear();
  for (size_t i = 0; i < s.text.size(); ++i) {
    if (s.text[i] == '\n') s.line_starts.push_back(i + 1);
    if ((s.text[i] & 0xC0) == 0x80) s.continuations.push_back(i);
  }
}

std::string_view SourceSet::line(int source, int line) const {
  const Source& s = sources_[source];
  if (line < 1 || size_t(line) > s.line_starts.size()) return {};
  const size_t begin = s.line_starts[line - 1];
  const size_t end = size_t(line) < s.line_starts.size() ? s.line_starts[line] - 1 : s.text.size();
  return std::string_view(s.text).substr(begin, end - begin);
}

/// By the sorted list of continuing bytes: a file in one long line must not make spans costly.
int SourceSet::characters_in(const Source& source, size_t begin, size_t end) {
  const auto& bytes = source.continuations;
  const auto first = std::lower_bound(bytes.begin(), bytes.end(), begin);
  const auto last = std::lower_bound(first, bytes.end(), end);
  return int(end - begin) - int(last - first);
}

SourceSpan SourceSet::span(const Place& place) const {
  if (place.source < 0 || size_t(place.source) >= sources_.size()) return {};
  if (place.line <= 0) return {sources_[place.source].name, 0, 0, 1, {}};
  const Source& source = sources_[place.source];
  const std::string_view text = line(place.source, place.line);
  const size_t line_start = text.empty() ? 0 : size_t(text.data() - source.text.data());
  const size_t begin = std::min(size_t(std::max(place.column, 1) - 1), text.size());
  const size_t end = std::min(begin + size_t(std::max(place.length, 0)), text.size());
  const int column = characters_in(source, line_start, line_start + begin) + 1;
  const int length = characters_in(source, line_start + begin, line_start + end);
  SourceSpan span{source.name, place.line, column, std::max(1, length), {}};
  const bool near_start = text.size() <= kLongestShownLine || begin + 20 < kLongestShownLine;
  if (place.length == 0 || !near_start) return span;
  size_t cut = std::min(text.size(), kLongestShownLine);
  while (cut < text.size() && cut > 0 && (text[cut] & 0xC0) == 0x80) --cut;
  const std::string_view shown = text.substr(0, cut);
  if (std::any_of(shown.begin(), shown.end(), is_control)) return span;
  span.source_line = printable(shown);
  if (shown.size() == text.size()) return span;
  span.source_line += " ...";
  span.length = std::min(span.length, int(kLongestShownLine - begin));
  return span;
}

void ErrorList::add(const Place& place, std::string message, std::string hint, ErrorCode code) {
  if (full())
    ++left_out_;
  else
    kept_.push_back({place, code, one_line(std::move(message)), one_line(std::move(hint))});
}

Diagnostics ErrorList::diagnostics(const SourceSet& sources) const {
  std::vector<Entry> sorted = kept_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Entry& a, const Entry& b) {
    return std::tuple(a.place.source, a.place.line, a.place.column) <
           std::tuple(b.place.source, b.place.line, b.place.column);
  });
  Diagnostics all;
  for (const Entry& e : sorted) all.push_back({e.code, e.message, sources.span(e.place), e.hint});
  if (left_out_ > 0)
    all.push_back({ErrorCode::invalid_input,
                   fmt::format("{} more errors in this job are not listed", left_out_),
                   {sources.name(0), 0, 0, 1, {}},
                   "correct the ones above first"});
  return all;
}

}  // namespace skylapse::config
