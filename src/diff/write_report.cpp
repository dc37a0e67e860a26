#include "diff/reports.h"
#include "output/atomic_file.h"

namespace skylapse::diff {

Status write_report(const std::string& path, const std::string& text) {
  return output::write_file_atomically(path, std::as_bytes(std::span(text)));
}

}  // namespace skylapse::diff
