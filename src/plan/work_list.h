#pragma once
// Which frames of a plan this process renders.
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"

namespace skylapse::plan {

/// Part `part` (from 1) of `parts`: every parts-th frame, so that all parts cost about the same.
struct Shard {
  int part = 1;
  int parts = 1;
};

/// "2/8". Parts count from 1.
Result<Shard> parse_shard(const std::string& text);

/// The shard that an array job's environment names: SLURM_ARRAY_TASK_ID (with _MIN, _STEP and
/// _COUNT: part (ID - MIN) / STEP + 1 of COUNT) or JOB_COMPLETION_INDEX and
/// JOB_COMPLETION_COUNT; nothing if neither is set. Values that name no part are an error that
/// shows the variables.
Result<std::optional<Shard>> shard_from_environment();

/// Frame numbers from "10-50x5,3,100-": ascending, each once, inside 1..count.
Result<std::vector<long>> parse_frame_list(const std::string& text, long count);

/// Frame numbers of a shard among `frames`.
std::vector<long> frames_of_shard(const std::vector<long>& frames, Shard shard);

}  // namespace skylapse::plan
