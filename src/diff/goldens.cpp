#include "diff/goldens.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "core/printable.h"
#include "diff/golden_file.h"
#include "diff/json_file.h"
#include "output/streamed_file.h"

namespace skylapse::diff {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The part of golden.json that is read, for messages: "goldens/3/variants/0".
class Place {
 public:
  Place(std::string file, std::string pointer)
      : file_(std::move(file)), pointer_(std::move(pointer)) {}
  [[nodiscard]] Place at(const std::string& key) const {
    return {file_, pointer_.empty() ? key : pointer_ + "/" + key};
  }
  [[nodiscard]] Error error(const std::string& why) const {
    return {.code = ErrorCode::missing_input,
            .message = printable(file_) + ": " + (pointer_.empty() ? "" : pointer_ + ": ") +
                       printable(why)};
  }

 private:
  std::string file_, pointer_;
};

/// A text of an object; one that may be left out is empty then.
Result<std::string> read_text(const json& object, const char* key, bool needed,
                              const Place& place) {
  const auto found = object.find(key);
  if (found == object.end()) {
    if (needed) return place.error(std::string("\"") + key + "\" is missing");
    return std::string();
  }
  if (!found->is_string()) return place.at(key).error("it is not a text");
  return found->get<std::string>();
}

Result<GoldenVariant> read_variant(const json& item, const Place& place) {
  if (!item.is_object()) return place.error("it is not an object");
  GoldenVariant variant;
  for (const GoldenKey& key : kGoldenKeys) {
    auto text = read_text(item, key.name, key.needed, place);
    if (!text) return text.error();
    variant.*key.value = *std::move(text);
  }
  if (!stays_below(variant.file) || variant.file == kGoldenFile)
    return place.at("file").error("'" + shown(variant.file) +
                                  "' is no file of a golden below the folder");
  return variant;
}

Result<Golden> read_golden(const json& item, const Place& place) {
  if (!item.is_object()) return place.error("it is not an object");
  Golden golden;
  auto name = read_text(item, "name", true, place);
  if (!name) return name.error();
  golden.name = *std::move(name);
  if (!stays_below(golden.name))
    return place.at("name").error("'" + shown(golden.name) + "' is not a path below a folder");
  const auto variants = item.find("variants");
  if (variants == item.end() || !variants->is_array() || variants->empty())
    return place.error("\"variants\" is not a list of at least one");
  std::set<std::string> renderers;
  for (size_t i = 0; i < variants->size(); ++i) {
    const Place here = place.at("variants").at(std::to_string(i));
    auto variant = read_variant((*variants)[i], here);
    if (!variant) return variant.error();
    if (!renderers.insert(variant->renderer).second)
      return here.error("the renderer \"" + shown(variant->renderer) + "\" comes twice");
    golden.variants.push_back(*std::move(variant));
  }
  return golden;
}

Result<std::vector<Golden>> read_golden_file(const fs::path& path) {
  const auto file = read_json(path);
  if (!file) return file.error();
  const Place top(path.native(), "");
  if (!file->is_object() || file->value("format", json()) != kGoldenFormat)
    return top.error(std::string("\"format\" is not \"") + kGoldenFormat + "\"");
  if (file->value("version", json()) != kGoldenVersion)
    return top.error("\"version\" is not " + std::to_string(kGoldenVersion));
  const auto list = file->find("goldens");
  if (list == file->end() || !list->is_array()) return top.error("\"goldens\" is not a list");
  std::vector<Golden> goldens;
  std::set<std::string> names, files;
  for (size_t i = 0; i < list->size(); ++i) {
    const Place here = top.at("goldens").at(std::to_string(i));
    auto golden = read_golden((*list)[i], here);
    if (!golden) return golden.error();
    if (!names.insert(golden->name).second)
      return here.error("the name '" + shown(golden->name) + "' comes twice");
    for (const GoldenVariant& variant : golden->variants)
      if (!files.insert(variant.file).second)
        return here.error("the file '" + shown(variant.file) + "' belongs to two goldens");
    goldens.push_back(*std::move(golden));
  }
  return goldens;
}

size_t common_beginning(const std::string& a, const std::string& b) {
  return size_t(std::ranges::mismatch(a, b).in1 - a.begin());
}

}  // namespace

Result<std::vector<Golden>> read_goldens(const std::string& folder) {
  std::error_code ec;
  const fs::path file = fs::path(folder) / kGoldenFile;
  if (fs::exists(fs::symlink_status(file, ec))) return read_golden_file(file);
  const auto images = list_files(folder, {});
  if (!images) return images.error();
  std::vector<Golden> goldens;
  for (const FilePair& image : images->pairs) {
    GoldenVariant variant;
    variant.file = image.name;
    variant.renderer = image.renderer_b;
    goldens.push_back({image.name, {variant}});
  }
  return goldens;
}

Result<bool> is_as_accepted(const std::string& folder, const GoldenVariant& variant) {
  if (variant.sha256.empty()) return true;
  const auto hash = output::hash_of_file(fs::path(folder) / variant.file);
  if (!hash) return hash.error();
  return hash->sha256 == variant.sha256;
}

std::string renderer_of(const FilePair& pair, const std::string& option) {
  if (!option.empty()) return option;
  return pair.renderer_b.empty() ? kUnknownRenderer : pair.renderer_b;
}

std::vector<GoldenVariant> variants_for(const Golden& golden, const std::string& renderer) {
  auto variants = golden.variants;
  std::ranges::stable_sort(variants, [&](const GoldenVariant& a, const GoldenVariant& b) {
    const bool own_a = a.renderer == renderer, own_b = b.renderer == renderer;
    if (own_a != own_b) return own_a;
    return common_beginning(a.renderer, renderer) > common_beginning(b.renderer, renderer);
  });
  return variants;
}

}  // namespace skylapse::diff
