#pragma once
#include "output/image_writer.h"

namespace skylapse::output::imageio {

/// See ImageIo::display. Errors: missing_input (no such config), invalid_input (a config that
/// OpenColorIO rejects; an unknown scene space, display or view, with what there is).
Result<std::unique_ptr<DisplayTransform>> make_display_transform(const DisplayRequest& request);

/// See ImageIo::views.
Result<std::vector<std::string>> list_views(const std::string& config_file);

}  // namespace skylapse::output::imageio
