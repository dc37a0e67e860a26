#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "astro/time/instant.h"
#include "core/printable.h"
#include "core/sha256.h"
#include "diff/facts.h"
#include "diff/file_names.h"
#include "diff/golden_file.h"
#include "diff/json_file.h"
#include "diff/told_values.h"
#include "output/atomic_file.h"
#include "output/streamed_file.h"

namespace skylapse::diff {
namespace {

namespace fs = std::filesystem;

/// Name of the folder of a renderer's files: its letters and digits, and, where that is not all of
/// it, the beginning of its hash.
std::string folder_of(const std::string& renderer) {
  std::string folder;
  for (const char c : renderer) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.';
    if (plain && !(c == '.' && folder.empty()))
      folder += c;
    else if (c >= 'A' && c <= 'Z')
      folder += char(c - 'A' + 'a');
    else if (!folder.empty() && folder.back() != '-')
      folder += '-';
  }
  folder.resize(std::min<size_t>(folder.size(), 60));
  while (folder.ends_with('-')) folder.pop_back();
  if (folder == renderer) return folder;
  return folder + (folder.empty() ? "" : "-") + sha256_hex(renderer).substr(0, 8);
}

std::string now_utc() {
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  return astro::format_utc({.utc = now});
}

/// A variant of the tested file with its provenance.
Result<GoldenVariant> new_variant(const GoldenUpdate& update, const FilePair& tested) {
  auto entry = parse_json(tested.manifest_entry_b.empty() ? "{}" : tested.manifest_entry_b,
                          "manifest of " + tested.b);
  if (!entry) return entry.error();
  const auto picture = read_picture(tested.b, ReadLimits{}, &*entry);
  if (!picture) return picture.error();
  const auto hash = output::hash_of_file(tested.b);
  if (!hash) return hash.error();
  const std::vector<output::Attribute> none;
  const ToldValues told(none, &*entry);
  GoldenVariant variant;
  variant.renderer = renderer_of(tested, update.renderer);
  variant.file = folder_of(variant.renderer) + "/" + tested.name;
  variant.sha256 = hash->sha256;
  variant.accepted_utc = now_utc();
  variant.note = update.note;
  variant.program = told.text("", "/program");
  variant.source_hash = told.text("", "/source_hash");
  variant.config = told.text("", "/config");
  variant.model = picture->facts.file.model;
  variant.utc = picture->facts.file.utc;
  if (variant.program.empty()) variant.program = picture->facts.program;
  return variant;
}

/// Puts a variant in the place of the one of its renderer, whose file it takes over. One with the
/// same bytes stays as it is. Returns the file.
std::string put(GoldenVariant variant, Golden& golden) {
  const auto old = std::ranges::find(golden.variants, variant.renderer, &GoldenVariant::renderer);
  std::string file = variant.file;
  if (old == golden.variants.end()) {
    golden.variants.push_back(std::move(variant));
  } else {
    file = variant.file = old->file;
    if (old->sha256 != variant.sha256) *old = std::move(variant);
  }
  std::ranges::sort(golden.variants, {}, &GoldenVariant::renderer);
  return file;
}

nlohmann::ordered_json to_json(const std::map<std::string, Golden>& goldens) {
  std::vector<const Golden*> ordered;
  for (const auto& [name, golden] : goldens) ordered.push_back(&golden);
  std::ranges::sort(ordered, [](auto* a, auto* b) { return comes_before(a->name, b->name); });
  auto list = nlohmann::ordered_json::array();
  for (const Golden* golden : ordered) {
    auto variants = nlohmann::ordered_json::array();
    for (const GoldenVariant& variant : golden->variants) {
      nlohmann::ordered_json item = nlohmann::ordered_json::object();
      for (const GoldenKey& key : kGoldenKeys)
        if (key.needed || !(variant.*key.value).empty()) item[key.name] = variant.*key.value;
      variants.push_back(item);
    }
    list.push_back({{"name", golden->name}, {"variants", variants}});
  }
  return {{"format", kGoldenFormat}, {"version", kGoldenVersion}, {"goldens", list}};
}

/// What golden.json lists, or the plain images of a folder that has none yet.
Result<std::map<std::string, Golden>> accepted_so_far(const std::string& folder) {
  std::map<std::string, Golden> goldens;
  std::error_code ec;
  const bool listed = fs::exists(fs::symlink_status(fs::path(folder) / kGoldenFile, ec));
  auto read = read_goldens(folder);
  if (!read && listed) return read.error();
  if (!read) return goldens;  // a new folder
  for (Golden& golden : *read) {
    for (GoldenVariant& variant : golden.variants)
      if (variant.renderer.empty()) variant.renderer = kUnknownRenderer;
    goldens.emplace(golden.name, std::move(golden));
  }
  return goldens;
}

Error name_not_utf8(const std::string& name) {
  return {.code = ErrorCode::missing_input,
          .message = "golden.json cannot hold the name '" + printable(name) + "'",
          .hint = "name the file in UTF-8"};
}

}  // namespace

Status update_goldens(const GoldenUpdate& update, const std::vector<FilePair>& tested) {
  auto goldens = accepted_so_far(update.folder);
  if (!goldens) return goldens.error();
  std::vector<std::string> files;  // below the folder, of each tested file
  for (const FilePair& pair : tested) {
    if (printable(pair.name) != pair.name) return name_not_utf8(pair.name);
    auto variant = new_variant(update, pair);
    if (!variant) return variant.error();
    Golden& golden = (*goldens)[pair.name];
    golden.name = pair.name;
    files.push_back(put(*std::move(variant), golden));
  }
  for (size_t i = 0; i < tested.size(); ++i) {
    const auto bytes = output::read_file(tested[i].b);
    if (!bytes) return bytes.error();
    const Status written =
        output::write_file_atomically(fs::path(update.folder) / files[i], *bytes);
    if (!written) return written;
  }
  if (update.prune) {
    std::set<std::string> names;
    for (const FilePair& pair : tested) names.insert(pair.name);
    std::erase_if(*goldens, [&](const auto& golden) { return !names.contains(golden.first); });
  }
  using Handler = nlohmann::ordered_json::error_handler_t;
  const std::string text = to_json(*goldens).dump(1, ' ', false, Handler::replace) + "\n";
  return output::write_file_atomically(fs::path(update.folder) / kGoldenFile,
                                       std::as_bytes(std::span(text)));
}

}  // namespace skylapse::diff
