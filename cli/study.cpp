#include <fmt/format.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/plan_text.h"
#include "cli/progress.h"
#include "cli/signals.h"
#include "study/run_study.h"

namespace skylapse::cli {
namespace {

struct StudyArguments {
  std::string config, output, backend = "auto", frames;
  std::vector<std::string> scenes;
  bool quick = false;
  std::optional<int> repeats;
  long seed = 1;
  std::optional<double> noise;
};

std::string command_of(const StudyArguments& a) {
  std::string text = "skylapse study";
  if (!a.config.empty()) text += " " + a.config;
  if (a.quick) text += " --quick";
  if (!a.scenes.empty()) text += fmt::format(" --scenes {}", fmt::join(a.scenes, ","));
  if (!a.frames.empty()) text += " --frames " + a.frames;
  if (a.repeats) text += fmt::format(" --repeats {}", *a.repeats);
  if (a.seed != 1) text += fmt::format(" --seed {}", a.seed);
  if (a.noise) text += fmt::format(" --noise {}", *a.noise);
  return text + " --output " + a.output;
}

/// The cheapest rung within 1, 2, 5 and 10 % of each scene.
std::string summary_text(const study::StudyResult& study, const std::string& folder) {
  std::string text;
  for (const auto& scene : study.scenes) {
    text += fmt::format("{}:\n", scene.scene.title);
    for (const double share : {0.01, 0.02, 0.05, 0.10}) {
      const int i = cheapest_within(scene.rungs, share);
      if (i < 0) {
        text += fmt::format("  {:3.0f} %  no rung\n", share * 100);
        continue;
      }
      const auto& m = scene.rungs[size_t(i)];
      text += fmt::format("  {:3.0f} %  {:<32} {:8.1f} core ms a frame, {:.2f} % off\n",
                          share * 100, m.rung.label, cost_of(m).ms, 100 * cost_of(m).error);
    }
  }
  return text + fmt::format("report: {}/report.html ({})", folder, duration_text(study.seconds));
}

nlohmann::ordered_json summary_json(const study::StudyResult& study, const std::string& folder) {
  nlohmann::ordered_json scenes = nlohmann::ordered_json::array();
  for (const auto& scene : study.scenes) {
    nlohmann::ordered_json front = nlohmann::ordered_json::array(), cheapest;
    for (const size_t i : pareto_front(scene.rungs)) {
      const auto& m = scene.rungs[i];
      front.push_back({{"rung", m.rung.id}, {"rms", cost_of(m).error}, {"core_ms", cost_of(m).ms}});
    }
    for (const auto& [name, share] : {std::pair("1 %", 0.01), std::pair("2 %", 0.02),
                                      std::pair("5 %", 0.05), std::pair("10 %", 0.1)}) {
      const int i = cheapest_within(scene.rungs, share);
      if (i >= 0)
        cheapest[name] = scene.rungs[size_t(i)].rung.id;
      else
        cheapest[name] = nullptr;
    }
    long skipped = 0;
    for (const auto& m : scene.rungs) skipped += m.skipped.empty() ? 0 : 1;
    scenes.push_back({{"scene", scene.scene.id},
                      {"rungs", scene.rungs.size()},
                      {"skipped", skipped},
                      {"cheapest", cheapest},
                      {"front", front}});
  }
  return {{"report", folder + "/report.html"},
          {"csv", folder + "/study.csv"},
          {"seconds", study.seconds},
          {"scenes", scenes}};
}

Result<study::StudyOptions, Diagnostics> options_of(const StudyArguments& a) {
  const auto backend = parse_backend(a.backend);
  if (!backend) return Diagnostics{backend.error()};
  study::StudyOptions options;
  options.output = a.output, options.config = a.config, options.scenes = a.scenes;
  options.quick = a.quick, options.backend = *backend;
  const auto refuse = [](const char* option, const std::string& what, const char* allowed) {
    return Diagnostics{option_error(option, what, allowed)};
  };
  if (!a.config.empty() && !a.scenes.empty())
    return refuse("--scenes", "belongs to the scenes that come with the program",
                  "leave out the config or --scenes");
  if (a.repeats && (*a.repeats < 1 || *a.repeats > 100))
    return refuse("--repeats", fmt::format("{} is out of range", *a.repeats), "allowed: 1 to 100");
  if (a.seed < 0 || a.seed > 1'000'000'000)
    return refuse("--seed", fmt::format("{} is out of range", a.seed), "allowed: 0 to 1000000000");
  if (a.noise && !(*a.noise >= 0.01 && *a.noise <= 20))
    return refuse("--noise", fmt::format("{} is out of range", *a.noise),
                  "allowed: 0.01 to 20 percent");
  options.rounds = a.repeats.value_or(0), options.seed = uint64_t(a.seed);
  if (a.noise) options.noise = *a.noise / 100;
  if (!a.frames.empty()) {
    if (a.config.empty())
      return refuse("--frames", "belongs to a config", "name a config, or choose by --scenes");
    options.frames = a.frames;
  }
  options.command = command_of(a);
  options.stop_signal = &g_signal;
  return options;
}

ExitCode run_study_command(const StudyArguments& arguments, const ConsoleOptions& console) {
  auto options = options_of(arguments);
  if (!options) return report(options.error());
  catch_signals();
  auto progress = std::make_unique<ProgressBar>(console);
  auto begun = std::chrono::steady_clock::now();
  std::string last;
  options->on_progress = [&](const std::string& what, long done, long total) {
    if (what != last) begun = std::chrono::steady_clock::now(), last = what;
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begun;
    progress->show({done, total, 0, taken.count(), what});
  };
  const auto study = study::run_study(*options);
  progress.reset();
  if (!study) {
    const ExitCode code = report(study.error());
    return code == ExitCode::interrupted && g_signal == SIGTERM ? ExitCode::terminated : code;
  }
  if (console.json)
    print(json_text(summary_json(*study, arguments.output)));
  else if (!console.quiet)
    print(summary_text(*study, arguments.output) + "\n");
  return ExitCode::done;
}

}  // namespace

void add_study_command(CLI::App& app, Session& session) {
  auto* command = add_command(
      app, session, "study",
      "What accuracy costs: every way to compute a sky against the truth, with its time",
      "skylapse study --quick --output out/study\n"
      "  skylapse study scene.yaml --frames 1-240x80 --output out/study");
  auto a = std::make_shared<StudyArguments>();
  command->add_option("config", a->config,
                      "Scene file (YAML); default: four scenes that come with the program");
  add_output_option(*command, a->output, "Folder of study.csv, figures and report.html")
      ->required();
  command->add_flag("--quick", a->quick, "Fewer rungs and a noisier truth: about two minutes");
  command
      ->add_option("--scenes", a->scenes,
                   fmt::format("Some of the program's scenes: {}",
                               fmt::join(study::built_in_scenes(), ", ")))
      ->delimiter(',');
  command->add_option("--frames", a->frames,
                      "Frames of the config, counted with one camera (default: up to three)");
  command->add_option("--repeats", a->repeats, "Rounds in which times are taken (default: 3)");
  command->add_option("--seed", a->seed, "Of the truth's random numbers (default: 1)");
  command->add_option("--noise", a->noise,
                      "Standard error of the truth in percent (default: 0.5, quick 2)");
  add_backend_option(*command, a->backend);
  command->callback([&session, a] {
    session.action = [&session, a] { return run_study_command(*a, session.console); };
  });
}

}  // namespace skylapse::cli
