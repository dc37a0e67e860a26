#pragma once
#include <nlohmann/json_fwd.hpp>

#include "diff/facts.h"
#include "output/image_writer.h"

namespace skylapse::diff {

/// What the attributes of a part and the manifest's entry (may be null) tell; `path`, channels and
/// storage of the picture are not told by them, and left to the caller.
PictureFacts facts_of_file(const output::ReadImage& part, const nlohmann::json* manifest_entry);

}  // namespace skylapse::diff
