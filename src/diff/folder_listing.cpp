#include "diff/folder_listing.h"

#include <sys/stat.h>

#include <algorithm>
#include <utility>

#include "core/printable.h"
#include "diff/file_names.h"

namespace skylapse::diff {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostEntries = 1'000'000;

Error cannot_list(const fs::path& folder, const std::string& why) {
  return {.code = ErrorCode::missing_input,
          .message = "cannot read the folder '" + printable(folder.native()) + "': " + why};
}

class Lister {
 public:
  explicit Lister(const std::vector<std::string>& extensions) : extensions_(extensions) {}

  Status walk(const fs::path& folder, const std::string& prefix) {
    struct stat facts {};
    if (::stat(folder.c_str(), &facts) != 0) return Done{};  // gone meanwhile
    const std::pair<dev_t, ino_t> self{facts.st_dev, facts.st_ino};
    if (std::ranges::find(open_, self) != open_.end()) return Done{};  // a loop of links
    open_.push_back(self);
    std::error_code ec;
    fs::directory_iterator entries(folder, ec);
    for (; !ec && entries != fs::directory_iterator(); entries.increment(ec)) {
      if (++seen_ > kMostEntries)
        return cannot_list(folder, "it holds more than a million entries");
      if (const Status taken = take(*entries, prefix); !taken) return taken;
    }
    open_.pop_back();
    if (ec) return cannot_list(folder, ec.message());
    return Done{};
  }

  FolderListing result() {
    std::ranges::sort(listing_.images, comes_before);
    std::ranges::sort(listing_.manifests, comes_before);
    return std::move(listing_);
  }

 private:
  Status take(const fs::directory_entry& entry, const std::string& prefix) {
    const std::string name = entry.path().filename().native();
    if (name.starts_with('.')) return Done{};
    std::error_code ignored;
    if (entry.is_directory(ignored)) return walk(entry.path(), prefix + name + "/");
    if (is_image_name(name, extensions_))
      listing_.images.push_back(prefix + name);
    else if (name == "manifest.json")
      listing_.manifests.push_back(prefix + name);
    return Done{};
  }

  const std::vector<std::string>& extensions_;
  FolderListing listing_;
  std::vector<std::pair<dev_t, ino_t>> open_;  // the folders that lead to where we are
  size_t seen_ = 0;
};

}  // namespace

bool is_image_name(const std::string& name, const std::vector<std::string>& extensions) {
  std::string extension = fs::path(name).extension().native();
  if (extension.size() < 2) return false;
  extension.erase(0, 1);
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return std::ranges::find(extensions, extension) != extensions.end();
}

Result<FolderListing> list_folder(const fs::path& folder,
                                  const std::vector<std::string>& extensions) {
  Lister lister(extensions);
  if (const Status walked = lister.walk(folder, ""); !walked) return walked.error();
  return lister.result();
}

}  // namespace skylapse::diff
