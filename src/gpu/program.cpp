#include "gpu/program.h"

#include <fmt/format.h>

#include "gpu/functions.h"

namespace skylapse::gpu {
namespace {

/// The log of a shader or a program, through its pair of GL functions.
template <class GetLength, class GetText>
std::string log_of(GLuint name, GetLength get_length, GetText get_text) {
  GLint length = 0;
  get_length(name, GL_INFO_LOG_LENGTH, &length);
  std::string log(size_t(length > 0 ? length : 0), '\0');
  if (length > 0) get_text(name, length, nullptr, log.data());
  while (!log.empty() && (log.back() == '\0' || log.back() == '\n')) log.pop_back();
  return log;
}

Error compile_error(const ShaderBundle& bundle, std::string_view what, const std::string& log) {
  return {ErrorCode::internal,
          fmt::format("{} of {} failed:\n{}", what, bundle.files.front(),
                      log.empty() ? "the driver gives no reason" : map_compiler_log(bundle, log))};
}

Result<Handle> compile(const Functions& gl, const ShaderBundle& bundle) {
  const GLuint name = gl.CreateShader(GL_COMPUTE_SHADER);
  Handle shader(*gl.context, name, [](const Functions& f, unsigned n) { f.DeleteShader(n); });
  const char* text = bundle.text.c_str();
  gl.ShaderSource(name, 1, &text, nullptr);
  gl.CompileShader(name);
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(name, GL_COMPILE_STATUS, &compiled);
  if (!compiled)
    return compile_error(bundle, "compilation", log_of(name, gl.GetShaderiv, gl.GetShaderInfoLog));
  return shader;
}

}  // namespace

Result<Program> Program::create(const Functions& gl, std::string_view entry,
                                const std::vector<Define>& defines,
                                std::span<const ShaderFile> files) {
  const auto bundle = bundle_shader(entry, defines, files);
  if (!bundle) return bundle.error();
  gl.context->set_activity(bundle->files.front());
  const auto shader = compile(gl, *bundle);
  if (!shader) return shader.error();
  const GLuint name = gl.CreateProgram();
  Program program;
  program.handle_ =
      Handle(*gl.context, name, [](const Functions& f, unsigned n) { f.DeleteProgram(n); });
  program.entry_ = bundle->files.front();
  gl.AttachShader(name, shader->name());
  gl.LinkProgram(name);
  GLint linked = GL_FALSE;
  gl.GetProgramiv(name, GL_LINK_STATUS, &linked);
  if (!linked)
    return compile_error(*bundle, "linking", log_of(name, gl.GetProgramiv, gl.GetProgramInfoLog));
  return program;
}

void Program::dispatch(const Functions& gl, WorkGroups groups) const {
  gl.context->set_activity(entry_);
  gl.UseProgram(handle_.name());
  gl.DispatchCompute(GLuint(groups.x), GLuint(groups.y), GLuint(groups.z));
  gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                   GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace skylapse::gpu
