#include "sky/bruneton/table_cache.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <system_error>
#include <vector>

#include "core/sha256.h"
#include "core/version.h"
#include "sky/bruneton/table_file.h"

namespace skylapse::sky::bruneton {
namespace fs = std::filesystem;
namespace {

constexpr const char* kSuffix = ".skytables";

std::string key_of(const atmosphere::Medium& medium, const Settings& settings,
                   const std::string& maker) {
  atmosphere::Medium shaping = medium;
  for (atmosphere::SpectralBand& band : shaping.bands) band.xyz_weight = {0, 0, 0};
  return sha256_hex(canonical_text(shaping) + '\0' + canonical_text(settings) + '\0' + maker +
                    '\0' + kSourceHash);
}

/// "512M" as bytes.
std::optional<uint64_t> parse_size(const std::string& text) {
  uint64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{}) return std::nullopt;
  const std::string unit(rest, end);
  const int shift = unit.empty() ? 0 : unit == "K" ? 10 : unit == "M" ? 20 : unit == "G" ? 30 : -1;
  if (shift < 0 || value > UINT64_MAX >> shift) return std::nullopt;
  return value << shift;
}

/// An absolute path in the environment; the XDG specification has relative ones ignored.
std::optional<fs::path> path_in_environment(const char* name) {
  const char* value = std::getenv(name);
  if (value == nullptr || value[0] != '/') return std::nullopt;
  return fs::path(value);
}

struct Kept {
  fs::path path;
  uint64_t bytes;
  fs::file_time_type used;
};

std::vector<Kept> kept_files(const fs::path& folder) {
  std::vector<Kept> files;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (it->path().extension() != kSuffix) continue;
    // Another process may take the file away in between: then it does not count.
    std::error_code gone;
    const uint64_t bytes = it->file_size(gone);
    if (gone) continue;
    const fs::file_time_type used = it->last_write_time(gone);
    if (!gone) files.push_back({it->path(), bytes, used});
  }
  return files;
}

}  // namespace

TableCache::TableCache(fs::path folder, uint64_t limit_bytes)
    : folder_(std::move(folder)), limit_(limit_bytes) {}

TableCache TableCache::standard() {
  TableCache cache({});
  // Relative paths are to be ignored (XDG Base Directory Specification 0.8).
  if (const auto base = path_in_environment("XDG_CACHE_HOME"); base && base->is_absolute())
    cache.folder_ = *base / "skylapse";
  else if (const auto home = path_in_environment("HOME"))
    cache.folder_ = *home / ".cache" / "skylapse";
  else
    cache.note_ = "neither XDG_CACHE_HOME nor HOME is set: tables are not kept";
  if (const char* limit = std::getenv("SKYLAPSE_CACHE_LIMIT")) {
    if (const auto bytes = parse_size(limit))
      cache.limit_ = *bytes;
    else
      cache.note_ = std::string("SKYLAPSE_CACHE_LIMIT=") + limit +
                    " is no size (such as 500M or 2G): 2G is used";
  }
  return cache;
}

fs::path TableCache::path_of(const atmosphere::Medium& medium, const Settings& settings,
                             const std::string& maker) const {
  return folder_ / (key_of(medium, settings, maker) + kSuffix);
}

std::optional<Tables> TableCache::find(const atmosphere::Medium& medium, const Settings& settings,
                                       const std::string& maker) const {
  if (!enabled()) return std::nullopt;
  const fs::path path = path_of(medium, settings, maker);
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  std::optional<Tables> tables =
      read_tables(path, key_of(medium, settings, maker), medium, settings);
  if (tables)
    fs::last_write_time(path, fs::file_time_type::clock::now(), error);  // used just now
  else
    fs::remove(path, error);
  return tables;
}

Status TableCache::store(const Tables& tables, const std::string& maker) const {
  if (!enabled()) return Done{};
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error)
    return Error{ErrorCode::write_failed,
                 "cannot keep tables in " + folder_.string() + ": " + error.message(),
                 {},
                 "set XDG_CACHE_HOME to a folder that can be written"};
  const fs::path path = path_of(tables.medium, tables.settings, maker);
  const Status written = write_tables(path, key_of(tables.medium, tables.settings, maker), tables);
  if (written.ok()) evict(path);
  return written;
}

void TableCache::evict(const fs::path& newest) const {
  remove_stale_table_temporaries(folder_);
  std::vector<Kept> files = kept_files(folder_);
  // Larger than all room by itself: the others stay.
  for (const Kept& file : files)
    if (file.path == newest && file.bytes > limit_) {
      std::error_code ignored;
      fs::remove(file.path, ignored);
      return;
    }
  std::sort(files.begin(), files.end(), [&](const Kept& a, const Kept& b) {
    const bool a_newest = a.path == newest, b_newest = b.path == newest;
    if (a_newest != b_newest) return b_newest;
    return a.used != b.used ? a.used < b.used : a.path < b.path;
  });
  uint64_t total = 0;
  for (const Kept& file : files) total += file.bytes;
  for (const Kept& file : files) {
    if (total <= limit_) return;
    std::error_code ignored;
    fs::remove(file.path, ignored);
    total -= file.bytes;
  }
}

}  // namespace skylapse::sky::bruneton
