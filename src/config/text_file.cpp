#include "config/text_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "config/yaml_reader.h"

namespace skylapse::config {
namespace {

namespace fs = std::filesystem;

Diagnostics unreadable(const std::string& path, std::string why, std::string hint) {
  return {{ErrorCode::missing_input, fmt::format("{}: {}", path, why), {}, std::move(hint)}};
}

}  // namespace

Result<std::string, Diagnostics> read_text_file(const std::string& path, const std::string& what) {
  std::error_code status;
  if (!fs::exists(path, status))
    return unreadable(path, "there is no such file", "check the name and the current folder");
  if (fs::is_directory(path, status))
    return unreadable(path, "this is a folder", fmt::format("name the {} file itself", what));
  if (!fs::is_regular_file(path, status))  // reading a pipe would wait for its other end
    return unreadable(path, "this is not a regular file",
                      fmt::format("save the {} in a file and name it", what));
  std::ifstream file(path, std::ios::binary);
  if (!file)
    return unreadable(path, fmt::format("cannot be opened ({})", std::strerror(errno)),
                      "check its permissions");
  // One byte more than allowed is enough to know that it is too long.
  std::string text(YamlLimits{}.bytes + 1, '\0');
  file.read(text.data(), std::streamsize(text.size()));
  if (file.bad()) return unreadable(path, "cannot be read", "check the disk it lies on");
  text.resize(size_t(file.gcount()));
  return text;
}

}  // namespace skylapse::config
