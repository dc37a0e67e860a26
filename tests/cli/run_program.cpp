#include "cli/run_program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace skylapse::cli::testing {
namespace {

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

[[noreturn]] void become(const std::vector<std::string>& arguments, const RunSettings& settings,
                         const std::filesystem::path& scratch) {
  const auto redirect = [&](const char* name, int flags, int target) {
    const int fd = open((scratch / name).c_str(), flags, 0600);
    dup2(fd, target);
    close(fd);
  };
  redirect("in", O_RDONLY, 0);
  redirect("out", O_WRONLY | O_CREAT, 1);
  redirect("err", O_WRONLY | O_CREAT, 2);
  if (chdir((settings.folder.empty() ? scratch : settings.folder).c_str()) != 0) _exit(120);
  for (const std::string& variable : settings.environment) {
    const size_t equals = variable.find('=');
    setenv(variable.substr(0, equals).c_str(), variable.substr(equals + 1).c_str(), 1);
  }
  if (settings.in_child) settings.in_child();
  std::vector<char*> argv{const_cast<char*>(SKYLAPSE_PROGRAM)};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  execv(SKYLAPSE_PROGRAM, argv.data());
  _exit(121);
}

}  // namespace

std::filesystem::path fresh_folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "skylapse-cli-XXXXXX").string();
  return mkdtemp(pattern.data());
}

std::filesystem::path write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

Outcome run(const std::vector<std::string>& arguments, const RunSettings& settings) {
  const auto scratch = fresh_folder();
  std::filesystem::permissions(scratch, std::filesystem::perms::all);
  write_text(scratch / "in", settings.input);
  std::filesystem::permissions(scratch / "in", std::filesystem::perms(0644));
  const pid_t child = fork();
  if (child == 0) become(arguments, settings, scratch);
  if (settings.while_running) settings.while_running(child);
  int status = 0;
  waitpid(child, &status, 0);
  Outcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.out = contents(scratch / "out");
  outcome.err = contents(scratch / "err");
  std::filesystem::remove_all(scratch);
  return outcome;
}

std::string small_scene(const std::string& outputs, const std::string& time) {
  const std::string default_time =
      "zone: Europe/Prague, date: 2026-06-21, from: sunrise, to: sunrise + 50 min, step: 10 min";
  return "location: {name: Prague, latitude: 50.0755, longitude: 14.4378, height: 235 m}\n"
         "time: {" +
         (time.empty() ? default_time : time) +
         "}\n"
         "camera: {projection: perspective, look_at: {azimuth: 60 deg, elevation: 10 deg}, fov: 80 "
         "deg, size: 160x90}\n"
         "sky: {model: hosek-wilkie}\n"
         "outputs: [" +
         outputs + "]\n";
}

}  // namespace skylapse::cli::testing
