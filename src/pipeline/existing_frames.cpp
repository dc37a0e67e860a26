#include "pipeline/existing_frames.h"

#include <fmt/format.h>
#include <strings.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

namespace skylapse::pipeline {
namespace {

using nlohmann::json;

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return extension.empty() ? extension : extension.substr(1);
}

bool has_extension(const std::filesystem::path& path, const std::vector<std::string>& extensions) {
  return std::find(extensions.begin(), extensions.end(), extension_of(path)) != extensions.end();
}

/// "2026-06-21T04:30:00+02:00" and -3.21 give "06-21 04:30 sun -3.2".
std::string label_of(const json& frame) {
  const std::string local = frame.at("local");
  return fmt::format("{} {}  sun {:.1f}", local.substr(5, 5), local.substr(11, 5),
                     frame.at("sun").at("elevation_deg").get<double>());
}

std::vector<ExistingFrame> from_manifest(const std::filesystem::path& folder,
                                         const std::vector<std::string>& extensions) {
  std::ifstream file(folder / "manifest.json");
  const json manifest = json::parse(file, nullptr, false);
  std::vector<ExistingFrame> frames;
  if (manifest.is_discarded()) return frames;
  try {
    for (const json& frame : manifest.at("frames"))
      for (const json& output : frame.at("files")) {
        const std::filesystem::path path = output.at("path").get<std::string>();
        if (!has_extension(path, extensions) || !std::filesystem::exists(folder / path)) continue;
        frames.push_back({folder / path, label_of(frame)});
        break;
      }
  } catch (const json::exception&) {
    frames.clear();  // not a manifest of ours
  }
  return frames;
}

std::vector<ExistingFrame> by_name(const std::filesystem::path& folder,
                                   const std::vector<std::string>& extensions) {
  std::vector<ExistingFrame> frames;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
    if (entry.is_regular_file(ignored) && has_extension(entry.path(), extensions) &&
        entry.path().filename().string()[0] != '.')
      frames.push_back({entry.path(), entry.path().stem().string()});
  std::sort(frames.begin(), frames.end(), [](const ExistingFrame& a, const ExistingFrame& b) {
    return strverscmp(a.path.c_str(), b.path.c_str()) < 0;
  });
  return frames;
}

}  // namespace

Result<std::vector<ExistingFrame>> existing_frames(const std::filesystem::path& folder,
                                                   const std::vector<std::string>& extensions) {
  if (!std::filesystem::is_directory(folder))
    return Error{ErrorCode::missing_input, fmt::format("'{}' is no folder", folder.string())};
  auto frames = from_manifest(folder, extensions);
  if (frames.empty()) frames = by_name(folder, extensions);
  if (frames.empty())
    return Error{ErrorCode::missing_input,
                 fmt::format("there are no frames in '{}'", folder.string()),
                 {},
                 fmt::format("looked for: {}", fmt::join(extensions, ", "))};
  return frames;
}

}  // namespace skylapse::pipeline
