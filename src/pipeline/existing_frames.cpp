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

/// "2026-06-21T04:30:00+02:00" and -3.21 give "06-21 04:30  sun -3.2" and what is left of it when
/// the date goes, then the sun. A face of a cube is named with the time.
ExistingFrame labelled(const json& frame, std::filesystem::path path, const std::string& face) {
  const std::string local = frame.at("local");
  const std::string time = local.substr(11, 5) + (face.empty() ? "" : " " + face);
  const std::string sun =
      fmt::format("  sun {:.1f}", frame.at("sun").at("elevation_deg").get<double>());
  return {std::move(path), local.substr(5, 5) + " " + time + sun, {time + sun, time}};
}

/// "px" if `path` is the face +X of a cube whose other faces lie beside it, else "".
std::string face_of(const std::string& path, const json& files) {
  const auto is_there = [&](const std::string& other) {
    return std::any_of(files.begin(), files.end(),
                       [&](const json& file) { return file.at("path") == other; });
  };
  for (size_t at = path.find("px"); at != std::string::npos; at = path.find("px", at + 1)) {
    bool all = true;
    for (const char* face : {"nx", "py", "ny", "pz", "nz"})
      all = all && is_there(std::string(path).replace(at, 2, face));
    if (all) return "px";
  }
  return "";
}

/// The number at the end of a name, so that "frame_of_a_long_name_0042" can be told apart by 0042.
std::vector<std::string> number_at_end(const std::string& name) {
  const size_t last = name.find_last_not_of("0123456789");
  if (last == std::string::npos || last + 1 == name.size()) return {};
  return {name.substr(last + 1)};
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
        const std::string name = output.at("path");
        const std::filesystem::path path = name;
        if (!has_extension(path, extensions) || !std::filesystem::exists(folder / path)) continue;
        frames.push_back(labelled(frame, folder / path, face_of(name, frame.at("files"))));
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
      frames.push_back({entry.path(), entry.path().stem().string(),
                        number_at_end(entry.path().stem().string())});
  std::sort(frames.begin(), frames.end(), [](const ExistingFrame& a, const ExistingFrame& b) {
    return strverscmp(a.path.c_str(), b.path.c_str()) < 0;
  });
  return frames;
}

}  // namespace

bool has_extension(const std::filesystem::path& path, const std::vector<std::string>& extensions) {
  return std::find(extensions.begin(), extensions.end(), extension_of(path)) != extensions.end();
}

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
