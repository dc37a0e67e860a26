#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "diff/goldens.h"
#include "diff/json_file.h"
#include "diff/manifest_facts.h"
#include "fuzz/require.h"
#include "fuzz/targets.h"
#include "output/image_writer.h"

namespace skylapse::fuzz {
namespace {

constexpr size_t kMaxBytes = 1 << 16;

/// A folder of this process alone, removed at its end.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "skylapse-fuzz-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path write(const char* name, std::string_view bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

const Folder& folder() {
  static const Folder the_folder;
  return the_folder;
}

const output::ImageIo& image_io() {
  static const auto io = output::open_image_io();
  require(io.ok(), "the image module is there");
  return **io;
}

}  // namespace

void image(std::string_view bytes) {
  if (bytes.size() > kMaxBytes) return;
  constexpr output::ReadLimits kLimits{.pixels = 1 << 16, .bytes = 1 << 20, .channels = 16};
  const auto path = folder().write("picture", bytes);
  const auto read = image_io().read(path.native(), 0, kLimits);
  if (!read) return require_printable({read.error()});
  const uint64_t pixels = uint64_t(read->width) * uint64_t(read->height);
  require(read->width > 0 && read->height > 0 && pixels <= kLimits.pixels, "pixels have a limit");
  require(!read->channels.empty() && int(read->channels.size()) <= kLimits.channels &&
              read->storage.size() == read->channels.size(),
          "channels have a limit");
  require(read->samples.size() == pixels * read->channels.size(), "a picture is whole");
  require(read->parts >= 1, "a file has a part");
}

void manifest(std::string_view bytes) {
  if (bytes.size() > kMaxBytes) return;
  const auto facts = diff::read_manifest(folder().write("manifest.json", bytes));
  if (!facts) return require_printable({facts.error()});
  require(facts->ours || facts->files.empty(), "files are told by skylapse alone");
  require(facts->order.size() == facts->files.size(), "each file is listed once");
  for (const auto& [path, file] : facts->files) {
    require(diff::stays_below(path), "files stay below the folder", path);
    require(nlohmann::json::accept(file.entry), "entries are JSON", file.entry);
  }
}

void golden(std::string_view bytes) {
  if (bytes.size() > kMaxBytes) return;
  const auto path = folder().write("golden.json", bytes);
  const auto goldens = diff::read_goldens(folder().path().native());
  std::filesystem::remove(path);
  if (!goldens) return require_printable({goldens.error()});
  for (const diff::Golden& golden : *goldens) {
    require(diff::stays_below(golden.name) && !golden.variants.empty(), "goldens have variants");
    std::set<std::string> renderers;
    for (const diff::GoldenVariant& variant : golden.variants) {
      require(diff::stays_below(variant.file), "files stay below the folder", variant.file);
      require(renderers.insert(variant.renderer).second, "a renderer has one variant");
    }
  }
}

}  // namespace skylapse::fuzz
