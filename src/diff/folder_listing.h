#pragma once
// The images below a folder.
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"

namespace skylapse::diff {

struct FolderListing {
  std::vector<std::string> images;     // by comes_before; "/" between folders
  std::vector<std::string> manifests;  // files named manifest.json, likewise
};

/// Everything below `folder` whose extension (in any case) is one of `extensions`, whatever it is:
/// a dangling link is an image that cannot be read. Hidden files and folders are passed over. Links
/// to folders are followed, but not back into a folder that leads to them.
/// Errors: missing_input: a folder that cannot be read; more than a million entries.
Result<FolderListing> list_folder(const std::filesystem::path& folder,
                                  const std::vector<std::string>& extensions);

/// Whether a file of this name is an image by its extension.
bool is_image_name(const std::string& name, const std::vector<std::string>& extensions);

}  // namespace skylapse::diff
