#pragma once
// Pictures that lie in a folder, for contact sheets and movies.
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"

namespace skylapse::pipeline {

struct ExistingFrame {
  std::filesystem::path path;
  std::string label;  // "06-21 04:30  sun -3.2" from the manifest; else the file's name
  std::vector<std::string> shorter{};  // for narrow pictures, longest first: "04:30  sun -3.2"
};

/// Whether the file's extension, in lower case and without its dot, is one of `extensions`.
bool has_extension(const std::filesystem::path& path, const std::vector<std::string>& extensions);

/// The frames of a folder in order. With a manifest.json: the files of the first output whose
/// format is in `extensions`, by frame number. Without: all files of those formats by name, digits
/// compared as numbers. Of a cube whose faces lie apart the face px stands for the frame, and its
/// label says so. Errors: no such folder, no such files.
Result<std::vector<ExistingFrame>> existing_frames(const std::filesystem::path& folder,
                                                   const std::vector<std::string>& extensions);

}  // namespace skylapse::pipeline
