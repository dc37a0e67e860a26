#pragma once
#include <string>

#include "output/image_writer.h"

namespace skylapse::output::imageio {

/// Looks at a file's structure before a library does, for what the libraries take on trust: sizes
/// in OpenEXR headers, for which they allocate gigabytes; the end of a PNG; the samples of a DPX,
/// which are not missed when they are not there. Costs a few reads, whatever the file says.
/// Returns why the file is not to be read; empty: nothing is wrong so far.
std::string header_problem(const std::string& path, const std::string& format,
                           const ReadLimits& limits);

}  // namespace skylapse::output::imageio
