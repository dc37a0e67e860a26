#pragma once
// What a study found: everything that its table, figures and report show.
#include <string>
#include <vector>

#include "study/machine.h"
#include "study/run_rung.h"

namespace skylapse::study {

struct SceneResult {
  StudyScene scene;
  std::vector<Measurement> rungs;  // in the order of the ladder
};

struct StudyResult {
  Machine machine;
  std::string renderer;  // of GL; empty if no rung used it
  std::string date;      // UTC, when the study began
  std::string command;
  bool quick = false;
  int rounds = 0, frames_per_round = 0;
  TruthSettings truth;
  double seconds = 0;
  std::vector<SceneResult> scenes;
  std::vector<std::string> notes;
};

/// Where a rung stands for the front: its error, not taken for less than the truth can tell
/// (ErrorMeasure::rms_uncertainty), and the core time of one frame after the first.
struct CostPoint {
  double ms = 0, error = 0;
};
CostPoint cost_of(const Measurement& measured);

/// Which of the rungs have none beside them that is both quicker and more accurate; skipped ones
/// and those of no error measure are not. Indices in the order of time.
std::vector<size_t> pareto_front(const std::vector<Measurement>& rungs);

/// The quickest measured rung whose rms error is at most `error`; -1 if there is none.
int cheapest_within(const std::vector<Measurement>& rungs, double error);

/// study.csv: one row a rung and scene; columns in docs/accuracy.md.
std::string study_csv(const StudyResult& study);

}  // namespace skylapse::study
