#pragma once
// Finished tables on disk, so that a second run starts at once.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/result.h"
#include "sky/bruneton/tables.h"

namespace skylapse::sky::bruneton {

/// A folder of table files, each named by the SHA-256 of everything that shapes it: medium (its
/// weights for XYZ aside, which tables do not hold), settings, who computed it, and the sources of
/// this program. Several processes may use one folder. Nothing here is needed for a right result:
/// where the folder cannot be used, find() finds nothing and store() says why.
class TableCache {
 public:
  static constexpr uint64_t kDefaultLimit = uint64_t{2} << 30;

  /// `folder` is made when first written to; empty: no cache. Files are kept below `limit_bytes`
  /// together; 0: no cache.
  explicit TableCache(std::filesystem::path folder, uint64_t limit_bytes = kDefaultLimit);

  /// $XDG_CACHE_HOME/skylapse, else ~/.cache/skylapse. SKYLAPSE_CACHE_LIMIT bounds it: bytes, or
  /// with K, M, G for powers of 1024; 0 switches it off.
  static TableCache standard();

  [[nodiscard]] bool enabled() const { return !folder_.empty() && limit_ > 0; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] uint64_t limit_bytes() const { return limit_; }
  /// What was wrong with the environment that standard() read; empty if nothing.
  [[nodiscard]] const std::string& note() const { return note_; }

  /// The tables of a medium and settings, made by `maker` (such as the renderer's name and version,
  /// for its rounding is its own). A damaged file is removed and not found.
  [[nodiscard]] std::optional<Tables> find(const atmosphere::Medium& medium,
                                           const Settings& settings,
                                           const std::string& maker = {}) const;
  /// Keeps `tables`, then removes the files that have not been used for longest until the limit is
  /// kept. Tables larger than the limit are not kept, which is no error.
  Status store(const Tables& tables, const std::string& maker = {}) const;

  /// Where the tables of a medium and settings are kept.
  [[nodiscard]] std::filesystem::path path_of(const atmosphere::Medium& medium,
                                              const Settings& settings,
                                              const std::string& maker = {}) const;

 private:
  void evict(const std::filesystem::path& newest) const;

  std::filesystem::path folder_;
  uint64_t limit_;
  std::string note_;
};

}  // namespace skylapse::sky::bruneton
