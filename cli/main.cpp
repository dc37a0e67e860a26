#include <csignal>
#include <exception>

#include "cli/commands.h"
#include "core/version.h"

namespace skylapse::cli {
namespace {

ExitCode usage_error(const CLI::ParseError& error) {
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
  add_sheet_command(app, session);
  add_movie_command(app, session);
  add_doctor_command(app, session);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked_for_help) {
    app.exit(asked_for_help);
    return ExitCode::done;
  } catch (const CLI::ParseError& error) {
    return usage_error(error);
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
