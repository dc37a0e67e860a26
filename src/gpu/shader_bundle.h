#pragma once
// Shader text from its files: resolves #include and leads compiler messages back to file and line.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace skylapse::gpu {

/// One file of shaders/, by its path there ("atmosphere/phase.glsl").
struct ShaderFile {
  std::string_view path;
  std::string_view text;
};

/// All files of shaders/, compiled into the program.
std::span<const ShaderFile> shader_files();

/// An integer that shapes a shader: a size or a switch. Physics goes in buffers, never here.
struct Define {
  std::string name;
  int value = 0;
};

struct ShaderBundle {
  std::string text;                // what the compiler gets
  std::vector<std::string> files;  // the number N that #line gives a file -> its path
};

/// The text of `entry` behind "#version 450 core" and the defines, with each `#include "path"`
/// (relative to shaders/) replaced by that file, once; `#pragma once` is left out. Errors: an
/// unknown file, with the place of its include and the nearest name; a file that includes itself.
Result<ShaderBundle> bundle_shader(std::string_view entry, const std::vector<Define>& defines,
                                   std::span<const ShaderFile> files = shader_files());

/// A compiler's log with its "2:17(5): error" (Mesa), "2(17) : error" (NVIDIA) or "ERROR: 2:17:"
/// (AMD, Intel) rewritten to "shaders/path:17: error".
std::string map_compiler_log(const ShaderBundle& bundle, std::string_view log);

}  // namespace skylapse::gpu
