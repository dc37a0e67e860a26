#pragma once
// A compute shader, ready to run.
#include <string>
#include <vector>

#include "core/result.h"
#include "gpu/handle.h"
#include "gpu/shader_bundle.h"

namespace skylapse::gpu {

struct WorkGroups {
  int x = 1, y = 1, z = 1;
};

/// Members with a `gl` run inside Context::run.
class Program {
 public:
  Program() = default;
  /// Compiles and links an entry of shaders/. The error has the compiler's messages with the files
  /// and lines they speak of.
  static Result<Program> create(const Functions& gl, std::string_view entry,
                                const std::vector<Define>& defines = {},
                                std::span<const ShaderFile> files = shader_files());
  /// Runs the groups over what is bound; what they write is visible to later shaders and texture
  /// lookups.
  void dispatch(const Functions& gl, WorkGroups groups) const;

 private:
  Handle handle_;
  std::string entry_;
};

/// Groups of `group` that cover `items`.
constexpr int groups_for(int items, int group) { return (items + group - 1) / group; }

}  // namespace skylapse::gpu
