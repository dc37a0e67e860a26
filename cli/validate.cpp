#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/job_arguments.h"

namespace skylapse::cli {
namespace {

struct ValidateArguments {
  std::vector<std::string> configs;
  std::vector<std::string> sets;
};

nlohmann::ordered_json as_json(const Error& error) {
  return {{"file", error.span.file},     {"line", error.span.line},
          {"column", error.span.column}, {"message", error.message},
          {"hint", error.hint},          {"exit", int(exit_code_of(error.code))}};
}

/// A config is valid when it can be planned: times resolve and no two frames write one file.
ExitCode run_validate(const ValidateArguments& arguments, const ConsoleOptions& console) {
  const auto overrides = parse_overrides(arguments.sets);
  if (!overrides) return report(overrides.error());
  Diagnostics all;
  auto files = nlohmann::ordered_json::array();
  for (const std::string& file : arguments.configs) {
    Diagnostics errors;
    auto job = config::load_job(file, *overrides);
    long frames = 0;
    if (!job) {
      errors = job.error();
    } else if (auto plan = plan::make_plan(*std::move(job))) {
      frames = long(plan->frames.size());
    } else {
      errors = plan.error();
    }
    if (errors.empty() && !console.json)
      note(console, fmt::format("{}: valid, {} frames", file, frames));
    auto listed = nlohmann::ordered_json::array();
    for (const Error& error : errors) listed.push_back(as_json(error));
    files.push_back(
        {{"file", file}, {"valid", errors.empty()}, {"frames", frames}, {"errors", listed}});
    all.insert(all.end(), errors.begin(), errors.end());
  }
  if (console.json) print(json_text(files));
  return all.empty() ? ExitCode::done : report(all);
}

}  // namespace

void add_validate_command(CLI::App& app, Session& session) {
  auto* command =
      add_command(app, session, "validate", "Check scene files: all errors of all files",
                  "skylapse validate configs/*.yaml");
  auto arguments = std::make_shared<ValidateArguments>();
  command->add_option("configs", arguments->configs, "Scene files (YAML)")->required();
  command->add_option("--set", arguments->sets, "Override a value: key.path=value (repeatable)")
      ->allow_extra_args(false);
  command->callback([&session, arguments] {
    session.action = [&session, arguments] { return run_validate(*arguments, session.console); };
  });
}

void add_schema_command(CLI::App& app, Session& session) {
  auto* command = add_command(app, session, "schema", "Print the JSON Schema of scene files",
                              "skylapse schema > skylapse.schema.json");
  command->callback([&session] {
    session.action = [] {
      print(config::job_json_schema() + "\n");
      return ExitCode::done;
    };
  });
}

}  // namespace skylapse::cli
