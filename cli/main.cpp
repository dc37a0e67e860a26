#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <exception>

#include "cli/commands.h"
#include "core/version.h"

namespace skylapse::cli {
namespace {

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(std::function<bool(const CLI::App*)>{}))
    names.push_back(command->get_name());
  return names;
}

/// "skylapse rendr": which commands there are, and which was likely meant.
Error unknown_command(const std::vector<std::string>& names, const std::string& name) {
  const auto near = nearest_name(name, names);
  return {ErrorCode::invalid_input,
          fmt::format("'{}' is no command", name),
          {},
          (near ? fmt::format("did you mean '{}'? ", *near) : "") +
              fmt::format("commands: {}", fmt::join(names, ", "))};
}

/// What stands on the command line of `command` and is none of its options or arguments.
Error unexpected_argument(const CLI::App& command, const std::string& argument) {
  if (!argument.starts_with("-"))
    return {ErrorCode::invalid_input,
            fmt::format("{}: '{}' was not expected", command.get_name(), argument),
            {},
            fmt::format("see skylapse {} --help", command.get_name())};
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  const auto near = nearest_name(argument.substr(0, argument.find('=')), names);
  return {ErrorCode::invalid_input,
          fmt::format("{}: option '{}' is unknown", command.get_name(), argument),
          {},
          near ? fmt::format("did you mean '{}'?", *near)
               : fmt::format("see skylapse {} --help", command.get_name())};
}

ExitCode usage_error(const CLI::App& app, const CLI::ParseError& error) {
  for (const CLI::App* command : app.get_subcommands())
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !command->remaining().empty())
      return report(unexpected_argument(*command, command->remaining().front()));
  std::fprintf(stderr, "error: %s\n", error.what());
  std::fprintf(stderr, "  see skylapse --help, or --help after a command\n");
  return ExitCode::invalid_input;
}

ExitCode run(int argc, char** argv) {
  CLI::App app{"skylapse renders the sky of any place and date.", "skylapse"};
  app.set_version_flag("--version", std::string("skylapse ") + kVersion);
  app.require_subcommand(1);
  app.footer("Start here:\n  skylapse render configs/prague_solstice.yaml --output out");
  Session session;
  add_render_command(app, session);
  add_plan_command(app, session);
  add_validate_command(app, session);
  add_schema_command(app, session);
  add_sun_command(app, session);
  add_events_command(app, session);
  add_probe_command(app, session);
  add_study_command(app, session);
  add_diff_command(app, session);
  add_sheet_command(app, session);
  add_movie_command(app, session);
  add_doctor_command(app, session);
  const auto names = command_names(app);
  if (argc > 1 && argv[1][0] != '-' &&
      std::find(names.begin(), names.end(), argv[1]) == names.end())
    return report(unknown_command(names, argv[1]));
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked_for_help) {
    app.exit(asked_for_help);
    return ExitCode::done;
  } catch (const CLI::ParseError& error) {
    return usage_error(app, error);
  }
  return session.action();
}

}  // namespace
}  // namespace skylapse::cli

int main(int argc, char** argv) {
  using namespace skylapse::cli;
  std::signal(SIGPIPE, SIG_IGN);
  try {
    return int(finish_stdout(run(argc, argv)));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: internal: %s\n", error.what());
    return int(ExitCode::internal);
  }
}
