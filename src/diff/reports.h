#pragma once
// What a comparison leaves behind: JSON, JUnit XML, a heat map, a page. All files appear whole.
#include <string>

#include "diff/diff_result.h"

namespace skylapse::diff {

/// The whole result as JSON (docs/diff.md); numbers that are not finite are strings.
std::string json_report(const DiffResult& result);

/// One test case a pair, and one for the findings of the whole. Warnings pass, with system-out.
std::string junit_report(const DiffResult& result);

/// Writes a text file by rename. Errors: write_failed.
Status write_report(const std::string& path, const std::string& text);

/// The errors of one pair in false colour with a scale beside it (.png), or as numbers (.exr: one
/// channel, the error). Errors: missing_input, write_failed, invalid_input (other extensions).
Status write_heat_map(const PairResult& pair, const std::string& path);

struct PageOptions {
  int pictures = 24;     // of the worst pairs; the others are in the table alone
  int max_width = 1024;  // pictures wider than that are shrunk
  size_t max_bytes =
      48'000'000;  // of all pictures; what is beyond is left out, the best pairs first
};

/// FOLDER/index.html: one file that needs no network. Errors: write_failed.
Status write_page(const DiffResult& result, const std::string& folder,
                  const PageOptions& options = {});

}  // namespace skylapse::diff
