#pragma once
#include "core/result.h"

namespace skylapse::cli {

/// What the process tells its caller; docs and tests hold each number fixed.
enum class ExitCode : int {
  done = 0,
  differs_within_warning = 1,
  differs = 2,
  invalid_input = 3,
  missing_input = 4,
  missing_backend = 5,
  write_failed = 6,
  internal = 7,
  interrupted = 130,
  terminated = 143,
};

ExitCode exit_code_of(ErrorCode code);

}  // namespace skylapse::cli
