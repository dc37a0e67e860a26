#include "diff_cases/render.h"

#include <cstdlib>
#include <functional>
#include <stdexcept>

namespace skylapse::diff_cases {
namespace {

/// In single quotes for the shell.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

void render(const RenderRequest& r) {
  std::string command = "env";
  std::string arithmetic;
  for (const std::string& e : r.environment) {
    command += " " + quoted(e);
    arithmetic += e + " ";
  }
  for (const std::string& option : r.options)
    if (option == "osmesa") arithmetic += option;
  const auto cache =
      r.output.parent_path() / ("cache-" + std::to_string(std::hash<std::string>{}(arithmetic)));
  command +=
      " " + quoted("XDG_CACHE_HOME=" + cache.string()) + " " + quoted(r.program.string()) +
      " render --quiet " +
      quoted(std::string(SKYLAPSE_SOURCE_DIR) + "/tests/diff_cases/scenes/" + r.scene + ".yaml") +
      " --output " + quoted(r.output.string());
  for (const std::string& option : r.options) command += " " + quoted(option);
  if (std::system(command.c_str()) != 0) throw std::runtime_error("this failed: " + command);
}

}  // namespace skylapse::diff_cases
