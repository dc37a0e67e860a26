// Turns the files of shaders/ into a C++ source, so that no file is looked for at run time.
//   embed_shaders SOURCE FOLDER PATH...
// PATH is relative to FOLDER and becomes the name that #include and gpu/shader_bundle.h use.
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

namespace {

[[noreturn]] void fail(const std::string& file, const std::string& message) {
  std::cerr << file << ": error: " << message << "\n";
  std::exit(1);
}

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) fail(path, "cannot be read");
  return text.str();
}

/// A raw string; the delimiter may not occur in a shader.
std::string literal(const std::string& path, const std::string& text) {
  if (text.find(")shader\"") != std::string::npos) fail(path, "contains )shader\"");
  return "R\"shader(" + text + ")shader\"";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: embed_shaders SOURCE FOLDER PATH...\n";
    return 3;
  }
  std::ofstream out(argv[1]);
  out << "// Made from shaders/ by tools/embed_shaders; edit the shaders, not this file.\n"
         "#include <array>\n\n#include \"gpu/shader_bundle.h\"\n\nnamespace skylapse::gpu {\n\n"
         "std::span<const ShaderFile> shader_files() {\n  static constexpr std::array<ShaderFile, "
      << argc - 3 << "> kFiles{{\n";
  for (int i = 3; i < argc; ++i) {
    const std::string path = argv[i];
    out << "{\"" << path << "\", " << literal(path, read_file(std::string(argv[2]) + "/" + path))
        << "},\n";
  }
  out << "}};\n  return kFiles;\n}\n\n}  // namespace skylapse::gpu\n";
  out.close();
  if (!out) fail(argv[1], "cannot be written");
}
