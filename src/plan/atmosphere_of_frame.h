#pragma once
// The air of a frame as a medium, and the few media whose tables serve a whole job.
#include "astro/events.h"
#include "config/job_config.h"
#include "core/result.h"
#include "sky/atmosphere/atmosphere.h"

namespace skylapse::plan {

struct Frame;

/// When the keyframes of the air fall, for each site of a job in order of time. A keyframe without
/// a day happens on every day of the job. Empty where the air does not change.
struct AirTimeline {
  struct Node {
    astro::Instant at;
    config::AirState state;
  };
  std::vector<std::vector<Node>> sites;
  /// What of the air is taken (plan/effect_planner); left out, it is not there.
  bool ozone = true, aerosol = true;
};

/// Resolves the keyframes as make_schedule resolves the times of frames: the same errors, with the
/// span of the expression. Made once for a job; searches events where keyframes are anchored.
Result<AirTimeline, Diagnostics> make_air_timeline(const config::JobConfig& job);

/// What a user would say about the air of this frame: the job's air with the frame's haze and
/// ground, or with the state of the keyframes at the frame's instant (linear in time between two
/// of them, constant before the first and after the last).
sky::atmosphere::AirDescription air_of_frame(const config::JobConfig& job,
                                             const AirTimeline& timeline, const Frame& frame);

/// The frame's medium in the bands of the job (Sky::wavelengths).
Result<sky::atmosphere::Medium> medium_of_frame(const config::JobConfig& job,
                                                const AirTimeline& timeline, const Frame& frame);

/// Media whose tables are computed for a frame; the frame's tables are (1 - weight) a + weight b.
struct TableMedia {
  sky::atmosphere::Medium a, b;
  double weight = 0;  // 0..1
};

/// Air that changes passes between nodes that are fixed by the job: neighbours differ by at most a
/// factor of 1.25 in aerosol depth (plus 0.02, below which haze hardly shows) or by 25 DU of ozone,
/// so that a few tables serve all frames, and the same ones the way there and back. Air that does
/// not change: a is the frame's medium, b equals it, weight is 0.
Result<TableMedia> tables_of_frame(const config::JobConfig& job, const AirTimeline& timeline,
                                   const Frame& frame);

}  // namespace skylapse::plan
