#include "cli/commands.h"

namespace skylapse::cli {

CLI::App* add_command(CLI::App& app, Session& session, const std::string& name,
                      const std::string& description, const std::string& example) {
  CLI::App* command = app.add_subcommand(name, description);
  command->footer("Example:\n  " + example);
  command->add_flag("-q,--quiet", session.console.quiet, "Print no progress and no notes");
  command->add_flag("--json", session.console.json, "Print machine-readable JSON to stdout only");
  return command;
}

}  // namespace skylapse::cli
