#include "config/source_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace skylapse::config {
namespace {

constexpr size_t kLongestShownLine = 240;

bool is_control(char c) { return (c >= 0 && c < 0x20 && c != '\t') || c == 0x7F; }

/// Values are quoted in messages: what would steer a terminal is replaced.
std::string printable(std::string text) {
  std::replace_if(text.begin(), text.end(), is_control, '?');
  return text;
}

/// UTF-8 characters in `text`: bytes that do not continue a character.
int characters_in(std::string_view text) {
  return int(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

int SourceSet::add(std::string name, std::string text) {
  sources_.push_back({std::move(name), {}, {}});
  const int source = int(sources_.size()) - 1;
  set_text(source, std::move(text));
  return source;
}

void SourceSet::set_text(int source, std::string text) {
  Source& s = sources_[source];
  s.text = std::move(text);
  s.line_starts = {0};
  for (size_t i = 0; i < s.text.size(); ++i)
    if (s.text[i] == '\n') s.line_starts.push_back(i + 1);
}

std::string_view SourceSet::line(int source, int line) const {
  const Source& s = sources_[source];
  if (line < 1 || size_t(line) > s.line_starts.size()) return {};
  const size_t begin = s.line_starts[line - 1];
  const size_t end = size_t(line) < s.line_starts.size() ? s.line_starts[line] - 1 : s.text.size();
  return std::string_view(s.text).substr(begin, end - begin);
}

SourceSpan SourceSet::span(const Place& place) const {
  if (place.source < 0 || size_t(place.source) >= sources_.size()) return {};
  if (place.line <= 0) return {sources_[place.source].name, 0, 0, 1, {}};
  const std::string_view text = line(place.source, place.line);
  const size_t begin = std::min(size_t(std::max(place.column, 1) - 1), text.size());
  SourceSpan span{sources_[place.source].name,
                  place.line,
                  characters_in(text.substr(0, begin)) + 1,
                  std::max(1, characters_in(text.substr(begin, place.length))),
                  {}};
  const bool shown = place.length > 0 && std::none_of(text.begin(), text.end(), is_control);
  if (shown && text.size() <= kLongestShownLine) {
    span.source_line = text;
  } else if (shown && begin + 20 < kLongestShownLine) {
    span.source_line = std::string(text.substr(0, kLongestShownLine)) + " ...";
    span.length = std::min(span.length, int(kLongestShownLine - begin));
  }
  return span;
}

void ErrorList::add(const Place& place, std::string message, std::string hint, ErrorCode code) {
  if (full())
    ++left_out_;
  else
    kept_.push_back({place, code, printable(std::move(message)), printable(std::move(hint))});
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
