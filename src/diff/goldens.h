#pragma once
// Accepted pictures of several renderers, with where they come from.
//
// A golden folder holds golden.json and the files it lists: per name ("site/f.0001.exr") one or
// more variants, each with the renderer string that made it, sha256, time, program version, the
// config's or manifest's provenance, and who accepted it if that is given.
#include <string>
#include <vector>

#include "diff/diff_result.h"
#include "diff/pairs.h"

namespace skylapse::diff {

struct GoldenVariant {
  std::string file;      // below the folder
  std::string renderer;  // "llvmpipe (LLVM 15.0.6, 256 bits)", "cpu"
  std::string sha256, accepted_utc, program, source_hash, model, note;
};

struct Golden {
  std::string name;
  std::vector<GoldenVariant> variants;
};

/// Reads golden.json. A folder without it: every image in it is a golden of an unknown renderer.
/// Errors: missing_input with the place in the file.
Result<std::vector<Golden>> read_goldens(const std::string& folder);

/// What the tested file was rendered by: `option` if not empty, else the manifest's.
std::string renderer_of(const FilePair& pair, const std::string& option);

/// The variants to hold a file against, likeliest first: the one of its own renderer, then others.
std::vector<GoldenVariant> variants_for(const Golden& golden, const std::string& renderer);

struct GoldenUpdate {
  std::string folder, renderer, note;
};

/// Copies the tested files into the golden folder as the variants of their renderer, whole files
/// by rename, and writes golden.json last. Goldens of other renderers and names stay. Errors:
/// write_failed, missing_input.
Status update_goldens(const GoldenUpdate& update, const std::vector<FilePair>& tested);

}  // namespace skylapse::diff
