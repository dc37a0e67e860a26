#include "gpu/shader_bundle.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>

namespace skylapse::gpu {
namespace {

constexpr const char* kFolder = "shaders/";

/// Reads a line from left to right; every step fails once one has failed.
class Scanner {
 public:
  explicit Scanner(std::string_view line) : rest_(line) {}
  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] std::string_view rest() const { return rest_; }

  Scanner& blanks() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t'))
      rest_.remove_prefix(1);
    return *this;
  }
  Scanner& word(std::string_view text) {
    ok_ = ok_ && rest_.starts_with(text);
    if (ok_) rest_.remove_prefix(text.size());
    return *this;
  }
  Scanner& number(size_t& value) {
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    ok_ = ok_ && error == std::errc();
    if (ok_) rest_.remove_prefix(size_t(end - rest_.data()));
    return *this;
  }

 private:
  std::string_view rest_;
  bool ok_ = true;
};

struct Include {
  std::string path;
  int column = 0;  // of the path, from 1
};
std::optional<Include> include_of(const std::string& line) {
  Scanner scanner(line);
  if (!scanner.blanks().word("#").blanks().word("include").blanks().word("\"").ok()) return {};
  const std::string_view path = scanner.rest().substr(0, scanner.rest().find('"'));
  return Include{std::string(path), int(path.data() - line.data()) + 1};
}

bool is_pragma_once(const std::string& line) {
  return Scanner(line).blanks().word("#").blanks().word("pragma").blanks().word("once").ok();
}

/// File number, line and message of one line of a compiler's log.
struct Message {
  size_t file = 0, line = 0;
  std::string_view text;
};
std::optional<Message> message_of(std::string_view line) {
  Message m;
  size_t column = 0;
  Scanner mesa(line), nvidia(line), error(line), warning(line);
  const Scanner* read = nullptr;
  if (mesa.number(m.file).word(":").number(m.line).word("(").number(column).word("): ").ok())
    read = &mesa;
  else if (nvidia.number(m.file).word("(").number(m.line).word(") : ").ok())
    read = &nvidia;
  else if (error.word("ERROR: ").number(m.file).word(":").number(m.line).word(": ").ok())
    read = &error;
  else if (warning.word("WARNING: ").number(m.file).word(":").number(m.line).word(": ").ok())
    read = &warning;
  if (read == nullptr) return {};
  m.text = read->rest();
  return m;
}

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
    std::istringstream lines{std::string(file.text)};
    bundle_.text += fmt::format("#line 1 {}\n", number);
    int line_number = 1;
    for (std::string line; std::getline(lines, line); ++line_number) {
      if (const auto include = include_of(line)) {
        const SourceSpan span{kFolder + std::string(file.path), line_number, include->column,
                              int(include->path.size()), line};
        const Status status = append(include->path, span);
        if (!status) return status;
        bundle_.text += fmt::format("#line {} {}\n", line_number + 1, number);
      } else {
        bundle_.text += (is_pragma_once(line) ? "" : line) + "\n";
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
  std::istringstream lines{std::string(log)};
  std::string mapped;
  for (std::string line; std::getline(lines, line);) {
    if (const auto message = message_of(line); message && message->file < bundle.files.size())
      line = fmt::format("{}:{}: {}", bundle.files[message->file], message->line, message->text);
    mapped += (mapped.empty() ? "" : "\n") + line;
  }
  return mapped;
}

}  // namespace skylapse::gpu
