#include <string_view>

#include "diff/pairs.h"

namespace skylapse::diff {
namespace {

/// The place after a set "[abc]", "[a-z]", "[!a]" that begins at `pattern[0]`, 0 if it has no end;
/// `fits`: whether `c` is in it.
size_t end_of_set(std::string_view pattern, char c, bool& fits) {
  size_t at = 1;
  const bool inverted = at < pattern.size() && (pattern[at] == '!' || pattern[at] == '^');
  if (inverted) ++at;
  bool found = false;
  for (const size_t first = at; at < pattern.size() && (pattern[at] != ']' || at == first); ++at) {
    const bool range = at + 2 < pattern.size() && pattern[at + 1] == '-' && pattern[at + 2] != ']';
    const auto low = static_cast<unsigned char>(pattern[at]);
    const auto high = static_cast<unsigned char>(range ? pattern[at + 2] : pattern[at]);
    const auto value = static_cast<unsigned char>(c);
    found = found || (low <= value && value <= high);
    if (range) at += 2;
  }
  if (at >= pattern.size()) return 0;
  fits = found != inverted;
  return at + 1;
}

/// Steps over one character of both, if they fit.
bool step(std::string_view name, size_t& n, std::string_view pattern, size_t& p) {
  if (n >= name.size() || p >= pattern.size()) return false;
  if (pattern[p] == '?' && name[n] != '/') return ++n, ++p, true;
  if (pattern[p] == '[' && name[n] != '/') {
    bool fits = false;
    if (const size_t length = end_of_set(pattern.substr(p), name[n], fits); length > 0)
      return fits ? (++n, p += length, true) : false;
  }
  return pattern[p] == name[n] ? (++n, ++p, true) : false;
}

/// Where to go on if the rest does not fit: with one character more under the star.
struct Retry {
  size_t name = std::string_view::npos, pattern = 0;
  bool whole_folders = false;  // "**/": one folder more
  [[nodiscard]] bool possible() const { return name != std::string_view::npos; }
};

/// Quadratic in the lengths at most: only the latest star of each kind takes more.
bool fits_whole(std::string_view name, std::string_view pattern) {
  size_t n = 0, p = 0;
  Retry within, across;
  while (true) {
    if (n == name.size() && p == pattern.size()) return true;
    if (pattern.substr(p).starts_with("**")) {
      p += 2;
      const bool folders = p < pattern.size() && pattern[p] == '/';  // none at all fits, too
      p += folders ? 1 : 0;
      across = {n, p, folders};
      within = {};
    } else if (p < pattern.size() && pattern[p] == '*') {
      within = {n, ++p};
    } else if (!step(name, n, pattern, p)) {
      if (within.possible() && within.name < name.size() && name[within.name] != '/') {
        n = ++within.name;
        p = within.pattern;
      } else if (across.possible() && across.name < name.size()) {
        ++across.name;
        if (across.whole_folders) {
          const size_t slash = name.find('/', across.name - 1);
          if (slash == name.npos) return false;
          across.name = slash + 1;
        }
        n = across.name;
        p = across.pattern;
        within = {};
      } else {
        return false;
      }
    }
  }
}

}  // namespace

bool fits_glob(const std::string& name, const std::string& pattern) {
  if (pattern.find('/') == pattern.npos) {
    const size_t slash = name.rfind('/');
    return fits_whole(slash == name.npos ? name : name.substr(slash + 1), pattern);
  }
  return fits_whole(name, pattern.back() == '/' ? pattern + "**" : pattern);
}

}  // namespace skylapse::diff
