#pragma once
// Places in the texts that make up a job (the file and each --set), and the errors found there.
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace skylapse::config {

/// A stretch of one line of one text; light enough to be kept with every node of a file.
struct Place {
  int source = 0;  // index of the text in its SourceSet
  int line = 0;    // from 1; 0: no place known
  int column = 1;  // from 1, in bytes
  int length = 1;  // in bytes; 0: the line itself says nothing about the error
};

/// The texts of a job. The first is the file, the others are overrides.
class SourceSet {
 public:
  /// Keeps `text` (line ends must be "\n") under the name that messages use.
  int add(std::string name, std::string text);
  void set_text(int source, std::string text);
  [[nodiscard]] const std::string& text(int source) const { return sources_[source].text; }
  [[nodiscard]] const std::string& name(int source) const { return sources_[source].name; }
  /// Line `line` (from 1) without its end; empty beyond the text.
  [[nodiscard]] std::string_view line(int source, int line) const;
  /// The place as users see it: columns count characters, not bytes; very long source lines are
  /// cut and those with control characters left out, so that a message stays readable.
  [[nodiscard]] SourceSpan span(const Place& place) const;

 private:
  struct Source {
    std::string name;
    std::string text;
    std::vector<size_t> line_starts;
    std::vector<size_t> continuations;  // bytes that continue a UTF-8 character
  };
  static int characters_in(const Source& source, size_t begin, size_t end);
  std::vector<Source> sources_;
};

/// What is wrong with a value, before it is known where the value stands.
struct Problem {
  std::string message;
  std::string hint{};
  size_t begin = 0;   // the part of the value's text that is wrong
  size_t length = 0;  // 0: all of it
};

/// Errors of one job in order of their places, with a bound on their number.
class ErrorList {
 public:
  /// Errors beyond this many are counted, not kept: hostile files must not make long reports.
  static constexpr size_t kMax = 100;

  void add(const Place& place, std::string message, std::string hint = {},
           ErrorCode code = ErrorCode::invalid_input);
  /// Full lists take no more text; callers may skip costly hints.
  [[nodiscard]] bool full() const { return kept_.size() >= kMax; }
  [[nodiscard]] bool empty() const { return kept_.empty(); }
  [[nodiscard]] size_t count() const { return kept_.size() + left_out_; }
  [[nodiscard]] Diagnostics diagnostics(const SourceSet& sources) const;

 private:
  struct Entry {
    Place place;
    ErrorCode code;
    std::string message, hint;
  };
  std::vector<Entry> kept_;
  size_t left_out_ = 0;
};

}  // namespace skylapse::config
