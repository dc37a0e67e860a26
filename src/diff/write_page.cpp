#include <filesystem>

#include "diff/page.h"

namespace skylapse::diff {

Status write_page(const DiffResult& result, const std::string& folder, const PageOptions& options) {
  const auto path = std::filesystem::path(folder) / "index.html";
  return write_report(path.string(), page_of(result, read_evidence, options));
}

}  // namespace skylapse::diff
