#include "study/machine.h"

#include <malloc.h>
#include <sys/utsname.h>

#include <cstdlib>
#include <fstream>

#include "core/parallel.h"
#include "core/version.h"

namespace skylapse::study {
namespace {

/// The rest of the first line of a file that begins with `key`, without blanks and colons.
std::string line_of(const char* file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(key)) continue;
    const size_t begin = line.find_first_not_of(" \t:", key.size());
    return begin == std::string::npos ? "" : line.substr(begin);
  }
  return "";
}

/// A value of /proc/self/status, given there in kB.
std::optional<int64_t> status_bytes(const std::string& key) {
  const std::string text = line_of("/proc/self/status", key);
  if (text.empty()) return {};
  return std::stoll(text) * 1024;
}

}  // namespace

Machine this_machine() {
  Machine machine;
  machine.cpu = line_of("/proc/cpuinfo", "model name");
  if (machine.cpu.empty()) machine.cpu = "unknown";
  machine.cores = available_cores();
  utsname names{};
  if (uname(&names) == 0)
    machine.system = std::string(names.sysname) + " " + names.release + " " + names.machine;
  machine.version = kVersion;
  machine.source_hash = kSourceHash;
  double load = 0;
  if (getloadavg(&load, 1) == 1) machine.load = load;
  return machine;
}

MemoryRise::MemoryRise() {
  malloc_trim(0);
  std::ofstream reset("/proc/self/clear_refs");
  reset << "5" << std::flush;  // proc(5): resets VmHWM to VmRSS
  if (reset) before_ = status_bytes("VmRSS:");
}

std::optional<int64_t> MemoryRise::bytes() const {
  const auto peak = status_bytes("VmHWM:");
  if (!before_ || !peak) return {};
  return std::max<int64_t>(0, *peak - *before_);
}

}  // namespace skylapse::study
