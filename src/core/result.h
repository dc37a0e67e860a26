#pragma once
// Errors as values: what went wrong, where in the input, and what to do about it.
#include <cassert>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace skylapse {

/// Place in a text input. Lines and columns count from 1; line 0 means "no place known".
struct SourceSpan {
  std::string file;  // as the user named it; "--set air.turbidity" for an override
  int line = 0;
  int column = 0;
  int length = 1;             // columns to underline
  std::string source_line{};  // the text of that line
};

/// Meaning of a failure; the command line maps each to one exit code.
enum class ErrorCode {
  invalid_input,    // exit 3
  missing_input,    // exit 4
  missing_backend,  // exit 5
  write_failed,     // exit 6
  internal,         // exit 7
  interrupted,      // exit 130 or 143
};

struct Error {
  ErrorCode code = ErrorCode::internal;
  std::string message;
  SourceSpan span{};
  std::string hint{};  // what is allowed, or what to do
};

/// All errors of one input, in the order of their places.
using Diagnostics = std::vector<Error>;

/// A value with the place it was read from.
template <class T>
struct Spanned {
  T value{};
  SourceSpan span{};
};

/// Either a value or an error. Reading the wrong side is an assert.
template <class T, class E = Error>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(E error) : state_(std::in_place_index<1>, std::move(error)) {}
  [[nodiscard]] bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }
  [[nodiscard]] const T& value() const& { return assert(ok()), std::get<0>(state_); }
  [[nodiscard]] T& value() & { return assert(ok()), std::get<0>(state_); }
  [[nodiscard]] T&& value() && { return assert(ok()), std::get<0>(std::move(state_)); }
  [[nodiscard]] const E& error() const& { return assert(!ok()), std::get<1>(state_); }
  [[nodiscard]] E&& error() && { return assert(!ok()), std::get<1>(std::move(state_)); }
  const T& operator*() const& { return value(); }
  T& operator*() & { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  const T* operator->() const { return &value(); }
  T* operator->() { return &value(); }

 private:
  std::variant<T, E> state_;
};

/// Success without a value.
struct Done {};
using Status = Result<Done>;

/// "file:line:col: error: message", the source line, and a caret line with the hint.
std::string format_error(const Error& error);

/// The candidate nearest to `word` by edit distance, if it is near enough to be a typing slip.
std::optional<std::string> nearest_name(const std::string& word,
                                        const std::vector<std::string>& candidates);

}  // namespace skylapse
