#include "config/path_template.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "core/printable.h"

namespace skylapse::config {
namespace {

constexpr size_t kLongestPath = 1000;
constexpr size_t kLongestName = 200;  // of a file or folder: 255 bytes on common file systems

std::string token_list() {
  return fmt::format("tokens: {{{}}}", fmt::join(path_token_names(), "} {"));
}

std::optional<Problem> token_problem(std::string_view path, size_t open) {
  const size_t close = path.find_first_of("{}/", open + 1);
  if (close == std::string_view::npos || path[close] != '}')
    return Problem{"a { is not closed", token_list(), open, 1};
  const std::string name(path.substr(open + 1, close - open - 1));
  const auto& known = path_token_names();
  if (std::find(known.begin(), known.end(), name) != known.end()) return std::nullopt;
  const auto nearest = name.size() <= 40 ? nearest_name(name, known) : std::nullopt;
  return Problem{fmt::format("the token {{{}}} is not known", shown(name)),
                 nearest ? fmt::format("did you mean {{{}}}?", *nearest) : token_list(), open,
                 close - open + 1};
}

}  // namespace

const std::vector<std::string>& path_token_names() {
  static const std::vector<std::string> names{"site",          "date",   "time", "camera",
                                              "turbidity",     "albedo", "face", "level",
                                              "sun_elevation", "half",   "size"};
  return names;
}

std::vector<std::string> tokens_in(std::string_view path) {
  std::vector<std::string> tokens;
  for (size_t i = 0; i < path.size(); ++i) {
    if (path[i] == '#') {
      tokens.emplace_back("#");
      i = std::min(path.find_first_not_of('#', i), path.size()) - 1;
    } else if (path[i] == '{') {
      const size_t close = path.find('}', i);
      if (close == std::string_view::npos) break;
      tokens.emplace_back(path.substr(i + 1, close - i - 1));
      i = close;
    }
  }
  return tokens;
}

std::optional<Problem> path_template_problem(std::string_view path) {
  if (path.size() > kLongestPath)
    return Problem{"the name is too long", fmt::format("allowed: at most {} bytes", kLongestPath)};
  if (path.empty() || path.back() == '/')
    return Problem{"there is no file name", "such as sky.####.png"};
  size_t numbers = 0, name_begin = 0;
  for (size_t i = 0; i < path.size(); ++i) {
    const auto c = static_cast<unsigned char>(path[i]);
    if (c < 0x20 || c == 0x7F) return Problem{"the name holds a control character", {}, i, 1};
    if (c == ' ' && path[0] != '/')
      return Problem{"the name holds a space", "use - or _: a space splits names in scripts", i, 1};
    if (c == '\\') return Problem{"the name holds a backslash", "folders are divided by /", i, 1};
    if (c == '?')
      return Problem{"the name holds a question mark",
                     "it means something to image libraries and to shells", i, 1};
    if (c == '/') name_begin = i + 1;
    if (i >= name_begin + kLongestName)
      return Problem{"the name of a file or folder is too long",
                     fmt::format("allowed: at most {} bytes", kLongestName)};
    if (c == '}') return Problem{"a } was not opened", token_list(), i, 1};
    if (c == '{') {
      if (auto problem = token_problem(path, i)) return problem;
      i = path.find('}', i);
    } else if (c == '#' && (i == 0 || path[i - 1] != '#')) {
      const size_t end = std::min(path.find_first_not_of('#', i), path.size());
      if (++numbers > 1)
        return Problem{"the name holds two frame numbers", "use one run of #", i, end - i};
      if (end - i > 12)
        return Problem{"the frame number has too many digits", "such as ####", i, end - i};
    }
  }
  return std::nullopt;
}

bool leaves_folder(std::string_view path) {
  if (path.starts_with('/')) return true;
  int depth = 0;
  while (!path.empty()) {
    const size_t slash = std::min(path.find('/'), path.size());
    const std::string_view part = path.substr(0, slash);
    if (part == "..")
      --depth;
    else if (!part.empty() && part != ".")
      ++depth;
    if (depth < 0) return true;
    path.remove_prefix(std::min(slash + 1, path.size()));
  }
  return false;
}

std::string normalised_path(const std::string& path) {
  return std::filesystem::path(path).lexically_normal().generic_string();
}

bool is_reserved_path(std::string_view path) {
  const std::string_view first = path.substr(0, path.find('/'));
  return first == "manifest.json" || first == ".skylapse";
}

std::string extension_of(std::string_view path) {
  const size_t slash = path.rfind('/');
  const std::string_view name = slash == std::string_view::npos ? path : path.substr(slash + 1);
  const size_t point = name.rfind('.');
  if (point == std::string_view::npos || point == 0) return {};
  std::string extension(name.substr(point + 1));
  for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

}  // namespace skylapse::config
