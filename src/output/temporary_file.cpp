// Names of hidden temporaries, and telling those of running processes from those left behind.
#include <unistd.h>

#include <atomic>
#include <cctype>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <optional>
#include <string_view>

#include "output/atomic_file.h"

namespace skylapse::output {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kMark = ".skylapse-";
constexpr std::string_view kSuffix = ".tmp";
constexpr size_t kLongestName = 255;  // NAME_MAX of the common Linux file systems

/// Start of process `pid` in clock ticks since boot (proc(5), field 22 of stat); 0 if there is
/// none. With the pid it names one process for good, also after the pid is used again.
uint64_t start_of(long pid) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  if (!std::getline(stat, line)) return 0;
  // Field 2, the program's name, may hold blanks: count from the last parenthesis.
  size_t at = line.rfind(')');
  for (int field = 2; field < 22 && at != std::string::npos; ++field) at = line.find(' ', at + 1);
  uint64_t start = 0;
  if (at == std::string::npos) return 0;
  std::from_chars(line.data() + at + 1, line.data() + line.size(), start);
  return start;
}

/// FNV-1a of the host name and the pid namespace: within one such machine pids can be compared.
std::string machine_key() {
  char text[512] = {};
  ::gethostname(text, 255);
  const size_t used = std::char_traits<char>::length(text);
  ::readlink("/proc/self/ns/pid", text + used, sizeof text - used - 1);
  uint32_t h = 2166136261U;
  for (const char* c = text; *c != 0; ++c) h = (h ^ static_cast<unsigned char>(*c)) * 16777619U;
  char hex[9];
  std::snprintf(hex, sizeof hex, "%08x", h);
  return hex;
}

struct Owner {
  std::string machine;
  long pid = 0;
  uint64_t start = 0;
};

/// The owner named in a temporary's file name; nothing if it is not one of ours.
std::optional<Owner> owner_of(std::string_view name) {
  if (!name.starts_with('.') || !name.ends_with(kSuffix)) return {};
  const size_t mark = name.rfind(kMark);
  if (mark == std::string_view::npos) return {};
  std::string_view rest = name.substr(mark + kMark.size());
  rest.remove_suffix(kSuffix.size());
  const auto number = [&rest](auto& value, bool last) {
    const auto [end, ec] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
    if (ec != std::errc{}) return false;
    rest.remove_prefix(static_cast<size_t>(end - rest.data()));
    if (last) return rest.empty();
    if (!rest.starts_with('-')) return false;
    rest.remove_prefix(1);
    return true;
  };
  if (rest.size() < 9 || rest[8] != '-') return {};
  Owner owner{.machine = std::string(rest.substr(0, 8))};
  rest.remove_prefix(9);
  unsigned count = 0;
  if (!number(owner.pid, false) || !number(owner.start, false) || !number(count, true)) return {};
  return owner;
}

bool older_than_a_day(const fs::path& path) {
  std::error_code ec;
  const auto written = fs::last_write_time(path, ec);
  return !ec && fs::file_time_type::clock::now() - written > std::chrono::hours(24);
}

}  // namespace

fs::path temporary_beside(const fs::path& path) {
  static std::atomic<unsigned> count{0};
  const long pid = ::getpid();  // asked each time: a forked child must not share names
  const std::string tail = std::string(kMark) + machine_key() + "-" + std::to_string(pid) + "-" +
                           std::to_string(start_of(pid)) + "-" + std::to_string(count++) +
                           std::string(kSuffix);
  std::string name = path.filename().string();
  if (1 + name.size() + tail.size() > kLongestName) name.resize(kLongestName - 1 - tail.size());
  return path.parent_path() / ("." + name + tail);
}

size_t remove_stale_temporaries(const fs::path& folder) {
  const std::string here = machine_key();
  size_t removed = 0;
  std::error_code ec;
  for (fs::directory_iterator it(folder, ec), end; !ec && it != end; it.increment(ec)) {
    const auto owner = owner_of(it->path().filename().string());
    if (!owner) continue;
    const bool stale = owner->machine == here ? start_of(owner->pid) != owner->start
                                              : older_than_a_day(it->path());
    std::error_code ignored;  // another process may have removed it first
    if (stale && fs::remove(it->path(), ignored)) ++removed;
  }
  return removed;
}

}  // namespace skylapse::output
