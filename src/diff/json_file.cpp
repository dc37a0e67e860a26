#include "diff/json_file.h"

#include <algorithm>
#include <span>

#include "core/printable.h"
#include "output/atomic_file.h"

namespace skylapse::diff {
namespace {

constexpr uintmax_t kMostBytes = uintmax_t{512} << 20;
constexpr int kMostLevels = 64;

Error bad_file(const std::string& name, const std::string& why, SourceSpan span = {}) {
  return {.code = ErrorCode::missing_input,
          .message = "cannot read '" + printable(name) + "': " + printable(why),
          .span = std::move(span)};
}

SourceSpan place_of(std::string_view text, size_t byte, const std::string& name) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  const size_t line_begin = before.rfind('\n') + 1;  // 0 if there is none
  return {.file = printable(name),
          .line = 1 + int(std::ranges::count(before, '\n')),
          .column = int(before.size() - line_begin) + (before.size() == line_begin ? 1 : 0)};
}

}  // namespace

bool stays_below(const std::string& path) {
  const std::filesystem::path p(path);
  if (path.empty() || path.find('\0') != path.npos || p.is_absolute()) return false;
  return std::ranges::none_of(p, [](const auto& part) { return part == ".."; });
}

Result<nlohmann::json> parse_json(std::string_view text, const std::string& name) {
  bool deep = false;
  const auto shallow = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    deep = deep || depth > kMostLevels;
    return depth <= kMostLevels;
  };
  try {
    auto json = nlohmann::json::parse(text.begin(), text.end(), shallow);
    if (deep) return bad_file(name, "it is nested deeper than 64 levels");
    return json;
  } catch (const nlohmann::json::parse_error& error) {
    return bad_file(name, "it is no JSON", place_of(text, error.byte, name));
  } catch (const nlohmann::json::exception& error) {
    return bad_file(name, error.what());
  }
}

Result<nlohmann::json> read_json(const std::filesystem::path& path) {
  std::error_code ec;
  if (!std::filesystem::is_regular_file(path, ec))
    return bad_file(path.native(), ec ? ec.message() : "it is not a file");
  const uintmax_t bytes = std::filesystem::file_size(path, ec);
  if (!ec && bytes > kMostBytes) return bad_file(path.native(), "it is larger than 512 MiB");
  const auto text = output::read_file(path);
  if (!text) return text.error();
  return parse_json({reinterpret_cast<const char*>(text->data()), text->size()}, path.native());
}

}  // namespace skylapse::diff
