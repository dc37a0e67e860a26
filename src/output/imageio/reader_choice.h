#pragma once
// Which of OpenImageIO's readers a file is given to.
#include <string>
#include <vector>

#include "core/result.h"

namespace skylapse::output::imageio {

/// OpenImageIO's name of the reader for a file: by its first bytes, so that no parser ever sees a
/// file of another kind; by its extension where the format has no mark of its own (Targa, camera
/// raws, RLA). Left out: movies, volumes and `null`, whose files are no pictures.
/// Errors: missing_input: not there, not a regular file (a folder, a pipe), empty, unknown kind.
Result<std::string> reader_for(const std::string& path);

/// Of the formats that reader_for knows.
std::vector<std::string> readable_extensions();

/// "cannot read image 'path': why".
Error unreadable(const std::string& path, const std::string& why);

}  // namespace skylapse::output::imageio
