#pragma once
// sky.accuracy and sky.time_budget: which rung of the ladder keeps the promise.
#include <optional>
#include <string>
#include <vector>

#include "config/job_config.h"
#include "core/result.h"
#include "plan/atmosphere_of_frame.h"
#include "plan/frame_schedule.h"
#include "plan/promise.h"
#include "plan/rung.h"

namespace skylapse::plan {

/// Beyond these core seconds a frame the reference is not taken unless the config names it: a
/// promise may cost minutes, but not hours without a word.
inline constexpr Duration kLongestReference = 600.0 * second;

/// What the choice rests on; `suns` are the states of schedule.times.
struct PromiseInputs {
  const config::JobConfig& job;
  const AirTimeline& air;
  const Schedule& schedule;
  const std::vector<astro::SkyState>& suns;
};

struct PromiseChoice {
  Promise promise;
  config::Sky sky;  // the job's, with model, level and bands set
};

/// One rung for the whole job (docs/decisions/0007). For an accuracy the cheapest whose bound holds
/// in every picture; else the reference, if it takes at most kLongestReference a frame; else the
/// error says what can be promised. For a budget the most accurate that fits on average; the
/// cheapest if none does. Needs job.sky.accuracy or time_budget (asserted).
/// Of more than some ten thousand pictures every nth is looked at: the sun moves slowly.
Result<PromiseChoice> choose_rung(const PromiseInputs& inputs,
                                  const ErrorTable& table = stored_errors());

/// The choice without a job: what chooses among outlooks. Index into `ladder`, cheapest first;
/// nothing if none keeps the accuracy.
std::optional<size_t> cheapest_within(const std::vector<Outlook>& ladder, double accuracy);
/// The most accurate that costs at most so much, the cheapest of equals; nothing if none does.
std::optional<size_t> best_within(const std::vector<Outlook>& ladder, Duration budget);

}  // namespace skylapse::plan
