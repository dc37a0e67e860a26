#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "output/image_writer.h"
#include "output/imageio/module_abi.h"

namespace skylapse::output {
namespace fs = std::filesystem;
namespace {

/// Folders that may hold the module, in the order they are tried.
std::vector<fs::path> module_folders() {
  std::vector<fs::path> folders;
  // A folder named by hand is the only one looked at: a wrong name must not be papered over.
  if (const char* named = std::getenv("SKYLAPSE_MODULE_DIR"); named != nullptr && *named != 0)
    return {named};
  std::error_code ec;
  const fs::path program = fs::read_symlink("/proc/self/exe", ec);
  if (!ec) {
    const fs::path prefix = program.parent_path().parent_path();
    folders.push_back(prefix / SKYLAPSE_MODULE_SUBDIR);  // beside an installed program
    folders.push_back(prefix / "lib/skylapse");          // beside one in a build folder
  }
  folders.emplace_back(SKYLAPSE_MODULE_INSTALL_DIR);
  folders.emplace_back(SKYLAPSE_MODULE_BUILD_DIR);
  return folders;
}

Error missing(const std::string& what) {
  return {.code = ErrorCode::missing_backend,
          .message = "image files and display transforms are not available: " + what,
          .hint =
              "install skylapse completely, with OpenImageIO and OpenColorIO (apt-get install "
              "libopenimageio2.4 libopencolorio2.1), or set SKYLAPSE_MODULE_DIR to the folder "
              "of " +
              std::string(kImageModuleFile)};
}

Result<const ImageIo*> load(const fs::path& file) {
  // The module stays loaded: what it hands out lives as long as the process.
  void* const module = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) {
    const char* const why = ::dlerror();
    return missing(why != nullptr ? why : file.string() + " cannot be loaded");
  }
  const auto factory = reinterpret_cast<ImageModuleFactory>(::dlsym(module, kImageModuleFactory));
  if (factory == nullptr) return missing(file.string() + " is no image module of skylapse");
  const ImageIo* const image_io = factory(kImageModuleAbi);
  if (image_io == nullptr) return missing(file.string() + " belongs to another skylapse version");
  return image_io;
}

Result<const ImageIo*> find_and_load() {
  std::string looked;
  for (const fs::path& folder : module_folders()) {
    const fs::path file = folder / kImageModuleFile;
    std::error_code ec;
    if (fs::exists(file, ec)) return load(file);
    looked += (looked.empty() ? "" : ", ") + folder.string();
  }
  return missing("found no " + std::string(kImageModuleFile) + " in " + looked);
}

}  // namespace

Result<const ImageIo*> open_image_io() {
  static const Result<const ImageIo*> image_io = find_and_load();
  return image_io;
}

}  // namespace skylapse::output
