#include "pipeline/ledger.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "output/atomic_file.h"
#include "output/signal_guard.h"
#include "output/streamed_file.h"

namespace skylapse::pipeline {
namespace {

using nlohmann::json;

std::string to_line(const LedgerEntry& entry) {
  json line = {{"path", entry.path},     {"fingerprint", entry.fingerprint},
               {"sha256", entry.sha256}, {"bytes", entry.bytes},
               {"ms", entry.times.ms},   {"encoding", entry.encoding},
               {"light", entry.light}};
  if (!entry.noise.empty()) line["noise"] = entry.noise;
  return line.dump() + "\n";
}

std::optional<LedgerEntry> from_line(const std::string& text) {
  const json line = json::parse(text, nullptr, false);
  if (line.is_discarded() || !line.is_object()) return {};
  LedgerEntry entry;
  try {
    entry.path = line.at("path");
    entry.fingerprint = line.at("fingerprint");
    entry.sha256 = line.at("sha256");
    entry.bytes = line.at("bytes");
    entry.times.ms = line.at("ms");
    entry.encoding = line.at("encoding").get<std::map<std::string, double>>();
    entry.light = line.at("light").get<std::map<std::string, double>>();
    if (line.contains("noise")) entry.noise = line.at("noise").get<std::map<std::string, double>>();
  } catch (const json::exception&) {
    return {};
  }
  return entry;
}

std::filesystem::path folder_of(const std::filesystem::path& output_folder) {
  return output_folder / ".skylapse";
}

}  // namespace

Ledger::Ledger(std::filesystem::path folder, std::filesystem::path own_file)
    : output_folder_(std::move(folder)),
      own_file_(std::move(own_file)),
      mutex_(std::make_unique<std::mutex>()) {}

Ledger::Ledger(Ledger&& other) noexcept
    : output_folder_(std::move(other.output_folder_)),
      own_file_(std::move(other.own_file_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      entries_(std::move(other.entries_)),
      mutex_(std::move(other.mutex_)) {}

Ledger::~Ledger() {
  if (descriptor_ >= 0) close(descriptor_);
}

Result<Ledger> Ledger::open(const std::filesystem::path& output_folder, const std::string& writer) {
  Ledger ledger(output_folder, folder_of(output_folder) / ("ledger." + writer + ".jsonl"));
  const Status folder = output::make_parent_folders(ledger.own_file_);
  if (!folder) return folder.error();
  ledger.descriptor_ =
      ::open(ledger.own_file_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (ledger.descriptor_ < 0) return output::write_error(ledger.own_file_, errno);
  const Status read = ledger.refresh();
  if (!read) return read.error();
  return ledger;
}

Status Ledger::refresh() {
  const std::lock_guard lock(*mutex_);
  std::error_code error;
  std::filesystem::directory_iterator files(folder_of(output_folder_), error);
  if (error) return output::write_error(folder_of(output_folder_), error.value());
  for (const auto& file : files) {
    if (file.path().extension() != ".jsonl") continue;
    std::ifstream lines(file.path());
    for (std::string line; std::getline(lines, line);)
      if (auto entry = from_line(line)) entries_[{entry->path, entry->fingerprint}] = *entry;
  }
  return Done{};
}

Status Ledger::record(const LedgerEntry& entry) {
  // A line of its own even after a torn one.
  const std::string line = "\n" + to_line(entry);
  const std::lock_guard lock(*mutex_);
  const output::SignalGuard no_size_signal(SIGXFSZ);
  const ssize_t written = ::write(descriptor_, line.data(), line.size());
  if (written != ssize_t(line.size()))
    return output::write_error(own_file_, written < 0 ? errno : ENOSPC);
  entries_[{entry.path, entry.fingerprint}] = entry;
  return Done{};
}

bool Ledger::knows(const std::string& path) const {
  const std::lock_guard lock(*mutex_);
  const auto entry = entries_.lower_bound({path, ""});
  return entry != entries_.end() && entry->first.first == path;
}

std::optional<LedgerEntry> Ledger::find(const std::string& path,
                                        const std::string& fingerprint) const {
  const std::lock_guard lock(*mutex_);
  const auto entry = entries_.find({path, fingerprint});
  return entry == entries_.end() ? std::nullopt : std::optional(entry->second);
}

std::optional<LedgerEntry> Ledger::finished(const std::string& path,
                                            const std::string& fingerprint) const {
  const auto entry = find(path, fingerprint);
  if (!entry) return {};
  std::error_code missing;
  if (std::filesystem::file_size(output_folder_ / path, missing) != entry->bytes) return {};
  const auto hash = output::hash_of_file(output_folder_ / path);
  if (!hash || hash->bytes != entry->bytes || hash->sha256 != entry->sha256) return {};
  return entry;
}

Result<FolderLock> FolderLock::take(const std::filesystem::path& output_folder) {
  const std::filesystem::path file = folder_of(output_folder) / "lock";
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) return output::write_error(file, errno);
  while (flock(descriptor, LOCK_EX) != 0)
    if (errno != EINTR) {
      const int reason = errno;
      close(descriptor);
      return output::write_error(file, reason);
    }
  return FolderLock(descriptor);
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace skylapse::pipeline
