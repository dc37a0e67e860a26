#pragma once
// One function per command: declares its arguments and says what to run.
#include <CLI/CLI.hpp>
#include <functional>

#include "cli/console.h"

namespace skylapse::cli {

/// What main hands to each command, and what it gets back.
struct Session {
  ConsoleOptions console;
  std::function<ExitCode()> action;  // set by the command that was chosen
};

void add_render_command(CLI::App& app, Session& session);
void add_plan_command(CLI::App& app, Session& session);
void add_validate_command(CLI::App& app, Session& session);
void add_schema_command(CLI::App& app, Session& session);
void add_sun_command(CLI::App& app, Session& session);
void add_events_command(CLI::App& app, Session& session);
void add_probe_command(CLI::App& app, Session& session);
void add_study_command(CLI::App& app, Session& session);
void add_diff_command(CLI::App& app, Session& session);
void add_sheet_command(CLI::App& app, Session& session);
void add_movie_command(CLI::App& app, Session& session);
void add_doctor_command(CLI::App& app, Session& session);

/// Adds --output, which must not be empty: "" would mean the working folder.
CLI::Option* add_output_option(CLI::App& command, std::string& output,
                               const std::string& description);

/// A sub-command with --quiet and --json, an example at the end of its help, and its action.
CLI::App* add_command(CLI::App& app, Session& session, const std::string& name,
                      const std::string& description, const std::string& example);

}  // namespace skylapse::cli
