#pragma once
// The scenes of a study: those that come with the program, or frames of a config.
#include "study/run_study.h"

namespace skylapse::study {

/// Scenes as the options name them, without truth. Errors: an unknown scene, a frame that is not
/// there, those of the config.
Result<std::vector<StudyScene>, Diagnostics> scenes_of(const StudyOptions& options);

/// Geometry, sample points and exposure of a scene, and the plan and frame that its truth is made
/// from: every effect, the sun by ERFA.
Result<plan::Plan, Diagnostics> prepare_scene(StudyScene& scene, Sampling sampling);

}  // namespace skylapse::study
