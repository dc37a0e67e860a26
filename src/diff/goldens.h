#pragma once
// Accepted pictures of several renderers, with where they come from.
//
// A golden folder holds golden.json and the files it lists, RENDERER/NAME: per name
// ("site/f.0001.exr") one or more variants, each with the renderer string that made it, sha256,
// time, program version, the hash of its sources, the config, model and moment of its manifest, and
// a note of who accepted it and why. Entries are in the order of their names and renderers, one
// value a line, and a file accepted again with the same bytes leaves its entry as it is: what
// changes in golden.json is what changed.
#include <string>
#include <vector>

#include "diff/diff_result.h"
#include "diff/pairs.h"

namespace skylapse::diff {

struct GoldenVariant {
  std::string file;      // below the folder
  std::string renderer;  // "llvmpipe (LLVM 15.0.6, 256 bits)", "cpu"
  std::string sha256, accepted_utc, program, source_hash, config, model, utc, note;
};

struct Golden {
  std::string name;
  std::vector<GoldenVariant> variants;
};

/// Reads golden.json. A folder without it: every image in it is a golden of an unknown renderer.
/// Errors: missing_input with the place in the file: not the format, values of another type, paths
/// that leave the folder, a name or a renderer of a name that comes twice.
Result<std::vector<Golden>> read_goldens(const std::string& folder);

/// Whether a variant's file still has the bytes that were accepted; those without sha256 have.
/// Errors: missing_input.
Result<bool> is_as_accepted(const std::string& folder, const GoldenVariant& variant);

/// What the tested file was rendered by: `option` if not empty, else the manifest's, else
/// "unknown".
std::string renderer_of(const FilePair& pair, const std::string& option);

/// The variants to hold a file against, likeliest first: the one of its own renderer, then those
/// whose renderer begins most like it.
std::vector<GoldenVariant> variants_for(const Golden& golden, const std::string& renderer);

struct GoldenUpdate {
  std::string folder, renderer, note;
  bool prune = false;  // goldens whose names are not among the tested files go
};

/// Copies the tested files into the golden folder as the variants of their renderer, whole files
/// by rename, and writes golden.json last. Goldens of other renderers and names stay; nothing is
/// written if one of the files cannot be read as a picture. Errors: write_failed, missing_input.
Status update_goldens(const GoldenUpdate& update, const std::vector<FilePair>& tested);

/// Two goldens of different scenes: comparing them must fail, or the limits no longer tell
/// anything.
struct GoldenContrast {
  std::string name_a, name_b;
  std::string file_a, file_b;  // below the folder
};

/// Goldens of one size and format to be held against each other: of a sequence each with the next
/// and a few far apart, of up to 12 others each with each, of more likewise neighbours and a few.
/// Left out: two that say they show the same moment, place, camera and content. Errors:
/// missing_input: a golden that cannot be read.
Result<std::vector<GoldenContrast>> golden_contrasts(const std::string& folder,
                                                     const std::vector<Golden>& goldens);

}  // namespace skylapse::diff
