#pragma once
// Files that are compiled in, so that an installed program has them: configs/study/*.yaml as
// "scenes/NAME.yaml", src/study/web/* by their names.
#include <string_view>

namespace skylapse::study {

/// Empty where there is no such file.
std::string_view study_text(std::string_view name);

}  // namespace skylapse::study
