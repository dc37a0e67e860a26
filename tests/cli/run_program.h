#pragma once
// Runs the real program and looks at what a caller sees.
#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace skylapse::cli::testing {

struct Outcome {
  int exit_code = -1;  // 128 + signal if it was killed
  std::string out, err;
};

struct RunSettings {
  std::string input{};                         // standard input
  std::vector<std::string> environment{};      // "NAME=value", added
  std::function<void()> in_child{};            // before exec: limits, user
  std::function<void(pid_t)> while_running{};  // in the parent
  std::filesystem::path folder{};              // working folder; empty: a shared temporary one
};

Outcome run(const std::vector<std::string>& arguments, const RunSettings& settings = {});

/// A fresh folder under the temporary one; the caller removes it (remove_all).
std::filesystem::path fresh_folder();

/// Writes a text file and returns its path.
std::filesystem::path write_text(const std::filesystem::path& file, const std::string& text);

/// A valid scene of a few small frames of the model that needs no GL; `outputs` in YAML flow style.
std::string small_scene(const std::string& outputs, const std::string& time = "");

}  // namespace skylapse::cli::testing
