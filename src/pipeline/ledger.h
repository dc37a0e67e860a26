#pragma once
// The record of finished files, so that a job can be taken up where it stopped.
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "core/result.h"
#include "pipeline/stage_times.h"

namespace skylapse::pipeline {

struct LedgerEntry {
  std::string path;  // relative to the output folder
  std::string fingerprint;
  std::string sha256;
  uintmax_t bytes = 0;
  StageTimes times;  // sky and disc of the frame, the rest of the file's own output
  /// What encoding did to the picture (sun policy), the light of the frame, and how sure it is
  /// where it was drawn at random: for the manifest.
  std::map<std::string, double> encoding{}, light{}, noise{};
};

/// Lines of JSON in OUT/.skylapse, one file per writing process, appended in one write each. A torn
/// last line (the process was killed) is passed over: its file counts as unfinished.
class Ledger {
 public:
  /// Reads what all processes of this output folder have recorded. `writer` names this process's
  /// file, for example "shard-2-of-8".
  static Result<Ledger> open(const std::filesystem::path& output_folder, const std::string& writer);
  Ledger(Ledger&&) noexcept;
  ~Ledger();

  /// Thread-safe. Errors: write_failed.
  Status record(const LedgerEntry& entry);

  /// The entry if the file exists with that fingerprint and its bytes still have that hash.
  [[nodiscard]] std::optional<LedgerEntry> finished(const std::string& path,
                                                    const std::string& fingerprint) const;
  /// The entry as recorded, the file not looked at.
  [[nodiscard]] std::optional<LedgerEntry> find(const std::string& path,
                                                const std::string& fingerprint) const;

  /// True if any record names the path, whatever its fingerprint: a quick no for most frames.
  [[nodiscard]] bool knows(const std::string& path) const;

  /// Reads again what other processes have recorded meanwhile.
  Status refresh();

 private:
  Ledger(std::filesystem::path folder, std::filesystem::path own_file);
  std::filesystem::path output_folder_;
  std::filesystem::path own_file_;
  int descriptor_ = -1;
  // By path and fingerprint: another process's older record of a path never hides a newer one.
  std::map<std::pair<std::string, std::string>, LedgerEntry> entries_;
  std::unique_ptr<std::mutex> mutex_;
};

/// Holds the folder's lock (OUT/.skylapse/lock) while alive: one process at a time.
class FolderLock {
 public:
  static Result<FolderLock> take(const std::filesystem::path& output_folder);
  FolderLock(FolderLock&& other) noexcept;
  ~FolderLock();

 private:
  explicit FolderLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

}  // namespace skylapse::pipeline
