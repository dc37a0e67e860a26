#include "plan/path_template.h"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <utility>

namespace skylapse::plan {
namespace {

constexpr std::array<std::pair<const char*, std::string PathValues::*>, 11> kTokens{{
    {"site", &PathValues::site},
    {"date", &PathValues::date},
    {"time", &PathValues::time},
    {"camera", &PathValues::camera},
    {"turbidity", &PathValues::turbidity},
    {"albedo", &PathValues::albedo},
    {"sun_elevation", &PathValues::sun_elevation},
    {"half", &PathValues::half},
    {"size", &PathValues::size},
    {"face", &PathValues::face},
    {"level", &PathValues::level},
}};

std::string file_safe(const std::string& value) {
  std::string safe;
  for (const unsigned char c : value)
    safe += (std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-' || c == '+' || c >= 0x80)
                ? char(c)
                : '-';
  return safe;
}

}  // namespace

std::string expand_tokens(const std::string& path, const PathValues& values) {
  std::string text = path;
  for (const auto& [name, member] : kTokens) {
    if ((values.*member).empty()) continue;
    const std::string token = fmt::format("{{{}}}", name);
    const std::string value = file_safe(values.*member);
    for (size_t at = text.find(token); at != std::string::npos; at = text.find(token, at)) {
      text.replace(at, token.size(), value);
      at += value.size();
    }
  }
  return text;
}

std::string expand_number(const std::string& path, long number) {
  const size_t first = path.find('#');
  if (first == std::string::npos) return path;
  const size_t last = path.find_first_not_of('#', first);
  const size_t length = (last == std::string::npos ? path.size() : last) - first;
  return path.substr(0, first) + fmt::format("{:0{}}", number, length) +
         path.substr(first + length);
}

const std::vector<std::string>& face_names() {
  static const std::vector<std::string> names{"px", "nx", "py", "ny", "pz", "nz"};
  return names;
}

}  // namespace skylapse::plan
