#pragma once
// A whole study: scenes, truths, rungs in turn, files.
#include <atomic>
#include <filesystem>
#include <functional>

#include "study/study_result.h"

namespace skylapse::study {

struct StudyOptions {
  std::filesystem::path output;
  /// A scene file of the user's; empty: the scenes that come with the program.
  std::string config;
  std::vector<std::string> scenes;  // of those that come with the program; empty: all
  std::string frames;               // of the config, "1-240x80"; empty: up to three, spread over it
  bool quick = false;
  int rounds = 0;  // of times, rungs in turn; 0: 3, quick 1
  uint64_t seed = 1;
  std::optional<double> noise;  // of the truth; nothing: 0.5 %, quick 2 %
  gpu::Backend backend = gpu::Backend::automatic;
  std::string command;  // as it was typed, for the report
  const std::atomic<int>* stop_signal = nullptr;
  /// One call at a time: what is done of what, and the scene.
  std::function<void(const std::string& what, long done, long total)> on_progress;
};

/// Names of the scenes that come with the program.
std::vector<std::string> built_in_scenes();

/// Runs the study and writes study.csv, figures/*.svg and report.html into options.output, anew
/// after each scene, so that an interrupted study keeps what it finished. Truths are kept in
/// output/truth, by what shapes them and the sources of the program, so a second run is quick.
Result<StudyResult, Diagnostics> run_study(const StudyOptions& options);

/// Writes the files of a study.
Status write_study(const StudyResult& study, const std::filesystem::path& folder);

}  // namespace skylapse::study
