#pragma once
// "--set key.path=value": the same rules as the file, for one value.
#include "config/job_config.h"
#include "config/yaml_node.h"

namespace skylapse::config {

/// Puts the value into the tree, as a text of its own in `sources` so that errors point into the
/// command line. Sections on the way are made if they are not there; items of lists are numbered
/// from 0 and must exist. Where the key is one of several that exclude each other, it takes the
/// place of the others.
void apply_override(Node& root, const Override& change, SourceSet& sources, ErrorList& errors);

}  // namespace skylapse::config
