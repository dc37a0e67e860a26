#pragma once
// Skies rendered by the program itself.
#include <filesystem>
#include <string>
#include <vector>

namespace skylapse::diff_cases {

struct RenderRequest {
  std::filesystem::path program;  // skylapse
  std::string scene;              // of scenes/, "noon"
  std::filesystem::path output;
  std::vector<std::string> options;      // "--set", "air.turbidity=3", "--backend", "osmesa"
  std::vector<std::string> environment;  // "LP_NATIVE_VECTOR_WIDTH=128"
};

/// Throws if the program does not end well. Renders share tables only if they have one environment
/// and one OpenGL: none takes anything from another's arithmetic.
void render(const RenderRequest& request);

}  // namespace skylapse::diff_cases
