#pragma once
// Which file belongs to which: of two files, two folders or two manifests.
#include <string>
#include <vector>

#include "diff/diff_result.h"

namespace skylapse::diff {

/// Two files that show the same, or should.
struct FilePair {
  std::string name;   // path below the folders ("site/f.0001.exr"), "/" between
  std::string a, b;   // paths to open
  int sequence = -1;  // files of one sequence carry one number, in their order in time; -1: alone
  std::string manifest_entry_a, manifest_entry_b;  // JSON of the frame and file; empty: none
  std::string renderer_a,
      renderer_b;  // of the manifest beside them: "llvmpipe (LLVM 15.0.6, 256 bits)"
};

struct PairList {
  std::vector<FilePair> pairs;    // by name, numbers within names counted as numbers
  std::vector<Finding> findings;  // "sequence.missing" and "sequence.extra" (failures),
                                  // "folder.extra" (a whole folder that only B has: a warning),
                                  // "manifest" (one that cannot be read: a warning)
};

/// Folders: every image below them (by the extensions OpenImageIO reads, hidden files and folders
/// passed over, links followed once), by relative path; everything else is passed over. A folder
/// with a skylapse manifest: the same, with the manifest's facts, which are looked for in the four
/// folders above, too, and beside single files. Manifests (files named *.json): the image files
/// they list, by path or, where no path is in both, by frame. `ignore`: glob patterns of names that
/// are left out. Errors: missing_input (not there, unreadable manifest, no image in A),
/// invalid_input (a file against a folder).
Result<PairList> pair_files(const std::string& a, const std::string& b,
                            const std::vector<std::string>& ignore);

/// One side alone, likewise: FilePair with b and what belongs to it, `a` empty.
Result<PairList> list_files(const std::string& path, const std::vector<std::string>& ignore);

/// Whether `name` ("site/f.0001.exr") fits a glob: * within a folder, ** across folders, ?, [abc].
/// A pattern without "/" is held against the file's own name; one that ends with "/" fits all below
/// that folder.
bool fits_glob(const std::string& name, const std::string& pattern);

}  // namespace skylapse::diff
