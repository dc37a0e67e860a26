#include "cli/commands.h"
#include "cli/job_arguments.h"
#include "cli/plan_text.h"

namespace skylapse::cli {

void add_plan_command(CLI::App& app, Session& session) {
  auto* command = add_command(app, session, "plan",
                              "What render would do: frames, sun, exposure, effects, time, bytes",
                              "skylapse plan configs/prague_solstice.yaml --frames 1-200x50");
  auto arguments = std::make_shared<JobArguments>();
  add_job_options(*command, *arguments);
  command->callback([&session, arguments] {
    session.action = [&session, arguments] {
      const auto work = plan_work(*arguments);
      if (!work) return report(work.error());
      print(session.console.json ? json_text(plan_json(*work)) : plan_text(*work));
      return ExitCode::done;
    };
  });
}

}  // namespace skylapse::cli
