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

CLI::Option* add_output_option(CLI::App& command, std::string& output,
                               const std::string& description) {
  return command.add_option("-o,--output", output, description)
      ->check(CLI::Validator(
          [](const std::string& name) {
            return name.empty() ? std::string("the name is empty; . is the working folder")
                                : std::string();
          },
          ""));
}

}  // namespace skylapse::cli
