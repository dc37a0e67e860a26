#include "gpu/shader_bundle.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <sstream>

namespace skylapse::gpu {
namespace {

constexpr const char* kFolder = "shaders/";

class Bundler {
 public:
  Bundler(std::span<const ShaderFile> files, ShaderBundle& bundle)
      : files_(files), bundle_(bundle) {}

  /// Appends a file with what it includes; `from` is the include that asked for it.
  Status append(std::string_view path, const SourceSpan& from) {
    const std::string name(path);
    if (std::ranges::find(open_, name) != open_.end())
      return Error{ErrorCode::internal, "shader '" + name + "' includes itself", from};
    if (std::ranges::find(bundle_.files, kFolder + name) != bundle_.files.end()) return Done{};
    const auto file = std::ranges::find(files_, path, &ShaderFile::path);
    if (file == files_.end()) return unknown(name, from);
    const size_t number = bundle_.files.size();
    bundle_.files.push_back(kFolder + name);
    open_.push_back(name);
    const Status status = append_lines(*file, number);
    open_.pop_back();
    return status;
  }

 private:
  Status append_lines(const ShaderFile& file, size_t number) {
    static const std::regex include(R"re(^\s*#\s*include\s+"([^"]+)".*)re");
    static const std::regex once(R"(^\s*#\s*pragma\s+once\s*$)");
    std::istringstream lines{std::string(file.text)};
    bundle_.text += fmt::format("#line 1 {}\n", number);
    int line_number = 1;
    for (std::string line; std::getline(lines, line); ++line_number) {
      std::smatch match;
      if (std::regex_match(line, match, include)) {
        const SourceSpan span{kFolder + std::string(file.path), line_number,
                              int(match.position(1)) + 1, int(match.length(1)), line};
        const Status status = append(match[1].str(), span);
        if (!status) return status;
        bundle_.text += fmt::format("#line {} {}\n", line_number + 1, number);
      } else {
        bundle_.text += (std::regex_match(line, once) ? "" : line) + "\n";
      }
    }
    return Done{};
  }

  Error unknown(const std::string& name, const SourceSpan& from) const {
    std::vector<std::string> names;
    for (const ShaderFile& file : files_) names.emplace_back(file.path);
    const auto nearest = nearest_name(name, names);
    return {ErrorCode::internal, "no shader file '" + name + "'", from,
            nearest ? "did you mean '" + *nearest + "'?" : ""};
  }

  std::span<const ShaderFile> files_;
  ShaderBundle& bundle_;
  std::vector<std::string> open_;  // the chain of includes that leads here
};

}  // namespace

Result<ShaderBundle> bundle_shader(std::string_view entry, const std::vector<Define>& defines,
                                   std::span<const ShaderFile> files) {
  ShaderBundle bundle;
  bundle.text = "#version 450 core\n";
  for (const Define& define : defines)
    bundle.text += fmt::format("#define {} {}\n", define.name, define.value);
  const Status status = Bundler(files, bundle).append(entry, {});
  if (!status) return status.error();
  return bundle;
}

std::string map_compiler_log(const ShaderBundle& bundle, std::string_view log) {
  static const std::regex mesa(R"(^(\d+):(\d+)\(\d+\): (.*)$)");
  static const std::regex nvidia(R"(^(\d+)\((\d+)\) : (.*)$)");
  static const std::regex other(R"(^(?:ERROR|WARNING): (\d+):(\d+): (.*)$)");
  std::istringstream lines{std::string(log)};
  std::string mapped;
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, match, mesa) || std::regex_match(line, match, nvidia) ||
        std::regex_match(line, match, other)) {
      const size_t file = std::stoul(match[1].str());
      if (file < bundle.files.size())
        line = bundle.files[file] + ":" + match[2].str() + ": " + match[3].str();
    }
    mapped += (mapped.empty() ? "" : "\n") + line;
  }
  return mapped;
}

}  // namespace skylapse::gpu
