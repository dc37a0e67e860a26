// Finding and loading the image module. Each claim runs in a process of its own: the module is
// opened once per process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "output/image_writer.h"
#include "output/in_child.h"
#include "support/temporary_folder.h"

namespace skylapse::output {
namespace {

int code_of_loading(const std::filesystem::path& folder) {
  return in_child([&] {
    ::setenv("SKYLAPSE_MODULE_DIR", folder.c_str(), 1);
    const auto io = open_image_io();
    if (io.ok()) return 0;
    if (io.error().hint.find("apt-get install") == std::string::npos) return 2;
    return io.error().code == ErrorCode::missing_backend ? 5 : 3;
  });
}

TEST(ImageModule, IsFoundBesideTheProgram) {
  EXPECT_EQ(in_child([] {
              ::unsetenv("SKYLAPSE_MODULE_DIR");
              return open_image_io().ok() ? 0 : 1;
            }),
            0);
}

TEST(ImageModule, MissingModuleSaysWhatToInstall) {
  const TemporaryFolder empty;
  EXPECT_EQ(code_of_loading(empty.path()), 5);
}

TEST(ImageModule, FileThatIsNoModuleIsAMissingBackend) {
  const TemporaryFolder folder;
  std::ofstream(folder / "libskylapse_imageio.so") << "not a library";
  EXPECT_EQ(code_of_loading(folder.path()), 5);
}

TEST(ImageModule, NamesTheVersionsItUses) {
  EXPECT_EQ(in_child([] {
              const auto io = open_image_io();
              if (!io.ok()) return 1;
              const std::string versions = (*io)->versions();
              return versions.find("OpenImageIO 2.") != std::string::npos &&
                             versions.find("OpenColorIO 2.") != std::string::npos
                         ? 0
                         : 2;
            }),
            0);
}

}  // namespace
}  // namespace skylapse::output
