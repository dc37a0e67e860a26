#pragma once
// Where a study ran, and what a piece of it took of memory.
#include <cstdint>
#include <optional>
#include <string>

namespace skylapse::study {

struct Machine {
  std::string cpu;  // model, "unknown" where the system does not say
  int cores = 0;    // this process may use
  std::string system;
  std::string version;      // of this program
  std::string source_hash;  // of the sources it was built from
  double load = 0;  // mean number of busy threads over the last minute, this program's included
};
Machine this_machine();

/// The rise of the process's resident memory over what it was at the start: the peak that the
/// kernel records (VmHWM), set back at the start. What the process had freed and can use again
/// does not count as a rise, though it is handed back to the system first where possible. Linux
/// only: elsewhere, or where the kernel refuses, there is no value.
class MemoryRise {
 public:
  MemoryRise();
  [[nodiscard]] std::optional<int64_t> bytes() const;

 private:
  std::optional<int64_t> before_;
};

}  // namespace skylapse::study
