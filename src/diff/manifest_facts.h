#pragma once
// What a manifest of skylapse tells of each of its files.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/result.h"

namespace skylapse::diff {

struct ManifestFile {
  std::string entry;     // JSON: "frame", "file", "camera", "output", "color", "site", "renderer",
                         // "program", "source_hash", "config"
  std::string sequence;  // files of one output, camera and place share it
  std::string key;       // of the frame and the file within it, whatever the file is named
  double frame = 0;      // its number
};

struct ManifestFacts {
  bool ours = false;  // made by skylapse; another file of that name tells nothing
  std::string renderer;
  std::map<std::string, ManifestFile> files;  // by path below the manifest's folder
  std::vector<std::string> order;             // their paths, as the manifest lists them
};

/// Errors: missing_input, with the place: not there, no JSON, frames or files that are not what
/// they should be, paths that leave the folder, larger than 512 MiB, nested deeper than 64.
Result<ManifestFacts> read_manifest(const std::filesystem::path& path);

}  // namespace skylapse::diff
