#include "diff/comparison_side.h"

#include <algorithm>

#include "core/printable.h"
#include "diff/folder_listing.h"
#include "output/image_writer.h"

namespace skylapse::diff {
namespace {

namespace fs = std::filesystem;

constexpr int kFoldersAbove = 4;
constexpr const char* kManifest = "manifest.json";

/// What a manifest tells of the names; its paths begin with `prefix` below our root, or, of a
/// manifest further up, lose `beyond`.
void add_told(ManifestFacts facts, const std::string& prefix, const std::string& beyond,
              ComparisonSide& side) {
  for (auto& [path, file] : facts.files) {
    if (!path.starts_with(beyond)) continue;
    const std::string name = prefix + path.substr(beyond.size());
    side.renderers.emplace(name, facts.renderer);
    side.files.emplace(name, std::move(file));  // the nearest manifest, added first, stands
  }
}

/// Manifests of the folders above, which may tell of files in this one.
void add_manifests_above(ComparisonSide& side) {
  std::error_code ec;
  fs::path folder = fs::weakly_canonical(side.root, ec);
  if (ec) return;
  std::string beyond;
  for (int i = 0; i < kFoldersAbove && folder.has_relative_path(); ++i) {
    beyond = folder.filename().native() + "/" + beyond;
    folder = folder.parent_path();
    if (!fs::exists(folder / kManifest, ec)) continue;
    if (auto facts = read_manifest(folder / kManifest); facts && facts->ours)
      add_told(*std::move(facts), "", beyond, side);
  }
}

Result<ComparisonSide> read_folder(const fs::path& path, const output::ImageIo& io) {
  ComparisonSide side{.kind = ComparisonSide::Kind::folder, .root = path};
  auto listing = list_folder(path, io.readable_extensions());
  if (!listing) return listing.error();
  side.names = std::move(listing->images);
  // The deepest first: it is nearest to its files.
  for (auto name = listing->manifests.rbegin(); name != listing->manifests.rend(); ++name) {
    auto facts = read_manifest(path / *name);
    if (!facts) {
      side.findings.push_back({.severity = Verdict::warning,
                               .check = "manifest",
                               .message = format_error(facts.error()),
                               .place = {}});
      continue;
    }
    const std::string prefix = name->substr(0, name->size() - std::string(kManifest).size());
    if (facts->ours) add_told(*std::move(facts), prefix, "", side);
  }
  add_manifests_above(side);
  return side;
}

Result<ComparisonSide> read_manifest_side(const fs::path& path, const output::ImageIo& io) {
  auto facts = read_manifest(path);
  if (!facts) return facts.error();
  if (!facts->ours)
    return Error{.code = ErrorCode::missing_input,
                 .message = "'" + printable(path.native()) + "' is no manifest of skylapse"};
  ComparisonSide side{.kind = ComparisonSide::Kind::manifest, .root = path.parent_path()};
  const auto extensions = io.readable_extensions();
  for (const std::string& name : facts->order)
    if (is_image_name(name, extensions)) side.names.push_back(name);
  add_told(*std::move(facts), "", "", side);
  return side;
}

ComparisonSide read_single(const fs::path& path) {
  ComparisonSide side{.kind = ComparisonSide::Kind::file, .root = path.parent_path()};
  side.names.push_back(path.filename().native());
  std::error_code ec;
  const fs::path beside = side.root / kManifest;
  if (fs::exists(beside, ec))
    if (auto facts = read_manifest(beside); facts && facts->ours)
      add_told(*std::move(facts), "", "", side);
  add_manifests_above(side);
  return side;
}

}  // namespace

std::string ComparisonSide::path_of(const std::string& name) const {
  return (root / name).native();
}

const ManifestFile* ComparisonSide::told(const std::string& name) const {
  const auto found = files.find(name);
  return found == files.end() ? nullptr : &found->second;
}

std::string ComparisonSide::renderer_of(const std::string& name) const {
  const auto found = renderers.find(name);
  return found == renderers.end() ? std::string() : found->second;
}

Result<ComparisonSide> read_side(const std::string& path) {
  const auto io = output::open_image_io();
  if (!io) return io.error();
  std::error_code ec;
  const fs::file_status status = fs::status(path, ec);
  if (!fs::exists(status))
    return Error{.code = ErrorCode::missing_input,
                 .message = "cannot read '" + printable(path) +
                            "': " + (ec ? ec.message() : "there is no such file or folder")};
  if (fs::is_directory(status)) return read_folder(path, **io);
  if (fs::path(path).extension() == ".json") return read_manifest_side(path, **io);
  return read_single(path);
}

}  // namespace skylapse::diff
