#pragma once
// One side of a comparison: the images that a path stands for, and what manifests tell of them.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/result.h"
#include "diff/diff_result.h"
#include "diff/manifest_facts.h"

namespace skylapse::diff {

struct ComparisonSide {
  enum class Kind { file, folder, manifest };
  Kind kind = Kind::file;
  std::filesystem::path root;                      // folder that the names start from
  std::vector<std::string> names{};                // "/" between folders
  std::map<std::string, ManifestFile> files{};     // by name
  std::map<std::string, std::string> renderers{};  // by name
  std::vector<Finding> findings{};                 // "manifest": one that cannot be read

  [[nodiscard]] std::string path_of(const std::string& name) const;
  [[nodiscard]] const ManifestFile* told(const std::string& name) const;  // null: nothing
  [[nodiscard]] std::string renderer_of(const std::string& name) const;
};

/// A folder, a manifest (*.json) or a file. Errors: missing_input.
Result<ComparisonSide> read_side(const std::string& path);

}  // namespace skylapse::diff
