#include "diff/file_names.h"

#include <algorithm>
#include <map>
#include <optional>

namespace skylapse::diff {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

size_t end_of_digits(std::string_view text, size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

/// Negative, 0, positive; numbers of any length.
int compare_numbers(std::string_view a, std::string_view b) {
  a.remove_prefix(std::min(a.find_first_not_of('0'), a.size()));
  b.remove_prefix(std::min(b.find_first_not_of('0'), b.size()));
  if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
  return a.compare(b);
}

/// A run of digits of a name, or a date and time written with several.
struct Number {
  size_t begin, end;
};

/// Whether the digits that begin at `next` carry on a time that began with `first` digits.
bool carries_on(std::string_view name, size_t first, size_t end, size_t next) {
  const bool begins_with_year = first == 4 || first == 8;
  const size_t digits = end_of_digits(name, next) - next;
  if (!begins_with_year || next != end + 1 || digits < 2 || digits > 6) return false;
  return std::string_view("-:T_").find(name[end]) != std::string_view::npos;
}

std::vector<Number> numbers_in(std::string_view name) {
  std::vector<Number> numbers;
  for (size_t at = 0; at < name.size();) {
    if (!is_digit(name[at])) {
      ++at;
      continue;
    }
    Number number{at, end_of_digits(name, at)};
    const size_t first = number.end - number.begin;
    while (number.end + 1 < name.size() && is_digit(name[number.end + 1]) &&
           carries_on(name, first, number.end, number.end + 1))
      number.end = end_of_digits(name, number.end + 1);
    numbers.push_back(number);
    at = number.end;
  }
  return numbers;
}

/// The name with "#" for the `hidden`-th number, or for all of them.
std::string pattern_of(std::string_view name, std::optional<size_t> hidden) {
  const auto numbers = numbers_in(name);
  std::string pattern;
  size_t at = 0;
  for (size_t i = 0; i < numbers.size(); ++i) {
    if (hidden && i != *hidden) continue;
    pattern += name.substr(at, numbers[i].begin - at);
    pattern += '\0';  // in no name
    at = numbers[i].end;
  }
  return pattern += name.substr(at);
}

/// The last of the numbers in which names of one pattern differ.
std::optional<size_t> last_that_differs(const std::vector<std::string>& names,
                                        const std::vector<size_t>& group) {
  const std::string& first = names[group.front()];
  const auto numbers = numbers_in(first);
  std::optional<size_t> last;
  for (const size_t member : group) {
    const std::string& name = names[member];
    const auto others = numbers_in(name);
    for (size_t i = 0; i < numbers.size(); ++i)
      if (std::string_view(first).substr(numbers[i].begin, numbers[i].end - numbers[i].begin) !=
          std::string_view(name).substr(others[i].begin, others[i].end - others[i].begin))
        last = std::max(last.value_or(0), i);
  }
  return last;
}

}  // namespace

bool comes_before(std::string_view a, std::string_view b) {
  size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const size_t end_a = end_of_digits(a, i), end_b = end_of_digits(b, j);
      const int order = compare_numbers(a.substr(i, end_a - i), b.substr(j, end_b - j));
      if (order != 0) return order < 0;
      i = end_a;
      j = end_b;
    } else {
      const auto ca = static_cast<unsigned char>(a[i++]), cb = static_cast<unsigned char>(b[j++]);
      if (ca != cb) return ca < cb;
    }
  }
  if (i < a.size() || j < b.size()) return j < b.size();
  return a < b;
}

std::vector<int> sequences_of(const std::vector<std::string>& names) {
  std::map<std::string, std::vector<size_t>> by_pattern;
  for (size_t i = 0; i < names.size(); ++i)
    by_pattern[pattern_of(names[i], std::nullopt)].push_back(i);
  std::vector<int> sequences(names.size(), -1);
  std::map<std::string, std::vector<size_t>> by_rest;
  for (const auto& [pattern, group] : by_pattern) {
    const auto number = last_that_differs(names, group);
    if (!number) continue;
    for (const size_t i : group) by_rest[pattern_of(names[i], number)].push_back(i);
  }
  int next = 0;
  for (const auto& [rest, group] : by_rest) {
    if (group.size() < 2) continue;
    for (const size_t i : group) sequences[i] = next;
    ++next;
  }
  return sequences;
}

}  // namespace skylapse::diff
