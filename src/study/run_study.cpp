#include "study/run_study.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "output/atomic_file.h"
#include "study/report.h"
#include "study/study_scenes.h"

namespace skylapse::study {
namespace {

namespace fs = std::filesystem;

constexpr double kNoise = 0.005, kQuickNoise = 0.02;
constexpr long kMostPaths = 400'000, kQuickMostPaths = 30'000;

TruthSettings truth_settings(const StudyOptions& options) {
  TruthSettings settings;
  settings.noise = options.noise.value_or(options.quick ? kQuickNoise : kNoise);
  settings.most_paths = options.quick ? kQuickMostPaths : kMostPaths;
  settings.seed = options.seed;
  return settings;
}

Diagnostics interrupted() {
  return {{ErrorCode::interrupted,
           "interrupted: scenes that were finished are kept",
           {},
           "truths that were traced are kept too: the same command starts with them"}};
}

/// The study while it runs.
class Run {
 public:
  explicit Run(const StudyOptions& options)
      : options_(options), start_(std::chrono::steady_clock::now()) {
    study_.machine = this_machine();
    study_.date = fmt::format(
        "{:%Y-%m-%d %H:%M} UTC",
        fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
    study_.command = options.command;
    study_.quick = options.quick;
    study_.rounds = options.rounds > 0 ? options.rounds : options.quick ? 1 : 3;
    study_.frames_per_round = options.quick ? 2 : 3;
    study_.truth = truth_settings(options);
    settings_.backend = options.backend;
    settings_.frames = study_.frames_per_round;
    settings_.tables = options.output / ".tables";
  }
  ~Run() {
    std::error_code ignored;
    fs::remove_all(settings_.tables, ignored);
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  Result<StudyResult, Diagnostics> all() {
    auto scenes = scenes_of(options_);
    if (!scenes) return scenes.error();
    const auto display = open_display();
    if (!display) return Diagnostics{display.error()};
    for (StudyScene& scene : *scenes) {
      const Result<Done, Diagnostics> done = one(std::move(scene));
      if (!done) return done.error();
    }
    return std::move(study_);
  }

 private:
  /// The view that a config without one has.
  Status open_display() {
    const auto io = output::open_image_io();
    if (!io) return io.error();
    auto display = (*io)->display({"", "rec709", "", ""});
    if (!display) return display.error();
    display_ = *std::move(display);
    settings_.display = display_.get();
    return Done{};
  }

  Result<Done, Diagnostics> one(StudyScene scene) {
    const auto plan = prepare_scene(scene, options_.quick ? Sampling::quick : Sampling::full);
    if (!plan) return plan.error();
    std::vector<Direction<Enu>> directions;
    for (const SamplePoint& p : scene.points) directions.push_back(p.toward);
    const std::string what = scene.id + ": truth";
    auto truth = truth_of(*plan, plan->frames[size_t(scene.frame - 1)], directions, study_.truth,
                          options_.output / "truth", options_.stop_signal,
                          [&](double share) { report(what, long(1000 * share), 1000); });
    if (!truth) return Diagnostics{truth.error()};
    scene.truth = *std::move(truth);
    auto rungs = measure(scene);
    if (!rungs) return rungs.error();
    study_.scenes.push_back({std::move(scene), *std::move(rungs)});
    study_.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const Status written = write_study(study_, options_.output);
    if (!written) return Diagnostics{written.error()};
    return Done{};
  }

  /// All rungs in turn, as often as there are rounds, so that what else the machine does meets all
  /// of them alike; every second round goes backwards.
  Result<std::vector<Measurement>, Diagnostics> measure(const StudyScene& scene) {
    const auto rungs = ladder(options_.quick);
    std::vector<Measurement> measured;
    const long total = long(rungs.size()) * study_.rounds;
    long done = 0;
    for (const Rung& rung : rungs) {
      if (stopped()) return interrupted();
      report(scene.id + ": rungs", done++, total);
      measured.push_back(measure_rung(scene, rung, settings_));
      if (study_.renderer.empty()) study_.renderer = measured.back().renderer;
    }
    for (int round = 1; round < study_.rounds; ++round) {
      for (size_t i = 0; i < measured.size(); ++i) {
        if (stopped()) return interrupted();
        report(scene.id + ": rungs", done++, total);
        Measurement& m = measured[round % 2 == 1 ? measured.size() - 1 - i : i];
        if (m.skipped.empty() && !m.rung.small_picture) repeat_rung(scene, settings_, m);
      }
    }
    report(scene.id + ": rungs", total, total);
    std::error_code ignored;
    fs::remove_all(settings_.tables, ignored);
    return measured;
  }

  [[nodiscard]] bool stopped() const {
    return options_.stop_signal != nullptr && options_.stop_signal->load() != 0;
  }
  void report(const std::string& what, long done, long total) const {
    if (options_.on_progress) options_.on_progress(what, done, total);
  }

  const StudyOptions& options_;
  std::chrono::steady_clock::time_point start_;
  StudyResult study_;
  RunSettings settings_;
  std::unique_ptr<output::DisplayTransform> display_;
};

Status write_text(const fs::path& path, const std::string& text) {
  return output::write_file_atomically(path, std::as_bytes(std::span(text)));
}

}  // namespace

Result<StudyResult, Diagnostics> run_study(const StudyOptions& options) {
  return Run(options).all();
}

Status write_study(const StudyResult& study, const fs::path& folder) {
  Status status = write_text(folder / "study.csv", study_csv(study));
  if (!status) return status;
  for (const Figure& figure : figures_of(study)) {
    status = write_text(folder / "figures" / (figure.name + ".svg"), figure.svg);
    if (!status) return status;
  }
  const auto html = report_html(study);
  if (!html) return html.error();
  return write_text(folder / "report.html", *html);
}

}  // namespace skylapse::study
