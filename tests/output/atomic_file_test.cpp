#include "output/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <random>
#include <thread>

#include "output/in_child.h"
#include "support/temporary_folder.h"

namespace skylapse::output {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::byte> filled(size_t size, int value) {
  return std::vector<std::byte>(size, static_cast<std::byte>(value));
}

bool holds(const fs::path& path, const std::vector<std::byte>& bytes) {
  const auto read = read_file(path);
  return read.ok() && *read == bytes;
}

TEST(AtomicFile, WritesIntoNewFoldersAndReadsBack) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a/b/frame.png";
  ASSERT_TRUE(write_file_atomically(path, filled(70000, 3)).ok());
  EXPECT_TRUE(holds(path, filled(70000, 3)));
  EXPECT_THAT(folder.entries(), ElementsAre("a"));
}

TEST(AtomicFile, ReplacesAnOlderFileAndLeavesNothingElse) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_file_atomically(folder / "f", filled(10, 1)).ok());
  ASSERT_TRUE(write_file_atomically(folder / "f", filled(5, 2)).ok());
  EXPECT_TRUE(holds(folder / "f", filled(5, 2)));
  EXPECT_THAT(folder.entries(), ElementsAre("f"));
}

TEST(AtomicFile, EmptyFilesAndLongNamesWork) {
  const TemporaryFolder folder;
  const std::string longest(255, 'n');
  ASSERT_TRUE(write_file_atomically(folder / longest, {}).ok());
  ASSERT_TRUE(write_file_atomically(folder / longest, {}).ok());
  EXPECT_TRUE(holds(folder / longest, {}));
}

TEST(AtomicFile, RespectsTheUmask) {
  const TemporaryFolder folder;
  const mode_t before = ::umask(027);
  ASSERT_TRUE(write_file_atomically(folder / "f", filled(1, 1)).ok());
  ::umask(before);
  struct stat info {};
  ASSERT_EQ(::stat((folder / "f").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0640u);
}

TEST(AtomicFile, MissingInputIsNamed) {
  const auto read = read_file("/nonexistent/frame.exr");
  ASSERT_FALSE(read.ok());
  EXPECT_EQ(read.error().code, ErrorCode::missing_input);
  EXPECT_THAT(read.error().message, HasSubstr("/nonexistent/frame.exr"));
}

TEST(AtomicFile, FilesOfUnknownSizeAreReadWhole) {
  const auto read = read_file("/proc/self/status");  // its size is reported as 0
  ASSERT_TRUE(read.ok());
  EXPECT_GT(read->size(), 100u);
}

TEST(AtomicFile, FileInPlaceOfAFolderIsAWriteError) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  const Status status = write_file_atomically(folder / "file/frame.png", filled(1, 1));
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::write_failed);
  EXPECT_THAT(status.error().message, HasSubstr("file/frame.png"));
  EXPECT_THAT(status.error().hint, HasSubstr("not a folder"));
}

TEST(AtomicFile, FolderInPlaceOfTheFileIsAWriteErrorAndLeavesNoTemporary) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "frame.png");
  const Status status = write_file_atomically(folder / "frame.png", filled(1, 1));
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::write_failed);
  EXPECT_THAT(folder.entries(), ElementsAre("frame.png"));
}

TEST(AtomicFile, FolderWithoutPermissionIsAWriteErrorWithAHint) {
  const TemporaryFolder folder;
  ASSERT_EQ(::chmod(folder.path().c_str(), 0555), 0);
  const int status = in_child([&] {
    if (::geteuid() == 0 && ::seteuid(65534) != 0) return kCannotSetUp;  // root may write anywhere
    const Status s = write_file_atomically(folder / "f", filled(1, 1));
    return !s.ok() && s.error().code == ErrorCode::write_failed &&
                   s.error().hint.find("may not write") != std::string::npos
               ? 0
               : 1;
  });
  ::chmod(folder.path().c_str(), 0755);
  if (status == kCannotSetUp) GTEST_SKIP() << "cannot give up root to test permissions";
  EXPECT_EQ(status, 0);
  EXPECT_THAT(folder.entries(), IsEmpty());
}

TEST(AtomicFile, SizeLimitIsAnErrorNotASignal) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_file_atomically(folder / "f", filled(100, 1)).ok());
  const int status = in_child([&] {
    const rlimit limit{65536, 65536};
    if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) return kCannotSetUp;
    const Status s = write_file_atomically(folder / "f", filled(1 << 20, 2));
    if (s.ok() || s.error().code != ErrorCode::write_failed) return 1;
    return s.error().hint.find("size limit") != std::string::npos ? 0 : 2;
  });
  if (status == kCannotSetUp) GTEST_SKIP() << "cannot set RLIMIT_FSIZE";
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(holds(folder / "f", filled(100, 1))) << "the old file must survive";
  EXPECT_THAT(folder.entries(), ElementsAre("f"));
}

TEST(AtomicFile, FullDiskKeepsWhatWasThereAndSaysSo) {
  const TemporaryFolder folder;
  const int status = in_child([&] {
    if (::unshare(CLONE_NEWNS) != 0 || ::mount("", "/", "", MS_REC | MS_PRIVATE, nullptr) != 0 ||
        ::mount("tmpfs", folder.path().c_str(), "tmpfs", 0, "size=128k") != 0)
      return kCannotSetUp;
    if (!write_file_atomically(folder / "first", filled(60000, 1)).ok()) return 1;
    const Status s = write_file_atomically(folder / "second", filled(200000, 2));
    if (s.ok() || s.error().code != ErrorCode::write_failed) return 2;
    if (s.error().hint.find("disk is full") == std::string::npos) return 3;
    if (folder.entries() != std::vector<std::string>{"first"}) return 4;
    return holds(folder / "first", filled(60000, 1)) ? 0 : 5;
  });
  if (status == kCannotSetUp) GTEST_SKIP() << "needs the right to mount a small tmpfs (root)";
  EXPECT_EQ(status, 0);
}

TEST(AtomicFile, WithoutProcItRenamesAHiddenFile) {
  const TemporaryFolder folder;
  const int status = in_child([&] {
    if (::unshare(CLONE_NEWNS) != 0 || ::mount("", "/", "", MS_REC | MS_PRIVATE, nullptr) != 0 ||
        ::mount("tmpfs", "/proc", "tmpfs", 0, "size=64k") != 0)
      return kCannotSetUp;
    if (!write_file_atomically(folder / "f", filled(1000, 1)).ok()) return 1;
    if (!write_file_atomically(folder / "f", filled(2000, 2)).ok()) return 2;
    return holds(folder / "f", filled(2000, 2)) ? 0 : 3;
  });
  if (status == kCannotSetUp) GTEST_SKIP() << "needs the right to hide /proc (root)";
  EXPECT_EQ(status, 0);
  EXPECT_THAT(folder.entries(), ElementsAre("f"));
}

TEST(AtomicFile, ThreadsWritingOneNameLeaveOneWholeFile) {
  const TemporaryFolder folder;
  {
    std::vector<std::jthread> writers;
    for (int t = 0; t < 4; ++t)
      writers.emplace_back([&folder, t] {
        for (int i = 0; i < 50; ++i)
          EXPECT_TRUE(write_file_atomically(folder / "f", filled(30000, t)).ok());
      });
  }
  const auto read = read_file(folder / "f");
  ASSERT_TRUE(read.ok());
  ASSERT_EQ(read->size(), 30000u);
  EXPECT_EQ(*read, filled(30000, static_cast<int>(read->front())));
  EXPECT_THAT(folder.entries(), ElementsAre("f"));
}

TEST(AtomicFile, KilledAtAnyMomentNothingPartialIsVisible) {
  const TemporaryFolder folder;
  constexpr size_t kSize = 1 << 20;
  std::mt19937 random(20260621);
  for (int round = 0; round < 60; ++round) {
    const pid_t pid = ::fork();
    if (pid == 0)
      for (int i = 0;; ++i) {
        const std::string name = "frame." + std::to_string(i % 4);
        if (!write_file_atomically(folder / name, filled(kSize, i % 251)).ok()) ::_exit(1);
      }
    ::usleep(static_cast<useconds_t>(random() % 15000));
    ASSERT_EQ(::kill(pid, SIGKILL), 0);
    int status = 0;
    ::waitpid(pid, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the writer failed by itself";
    for (const std::string& name : folder.entries()) {
      if (name.starts_with('.')) continue;
      const auto read = read_file(folder / name);
      ASSERT_TRUE(read.ok());
      ASSERT_EQ(read->size(), kSize) << "partial file in round " << round;
      ASSERT_EQ(*read, filled(kSize, static_cast<int>(read->front())));
    }
  }
  remove_stale_temporaries(folder.path());
  for (const std::string& name : folder.entries()) EXPECT_FALSE(name.starts_with('.')) << name;
}

TEST(StaleTemporaries, OnlyThoseOfDeadProcessesAreRemoved) {
  const TemporaryFolder folder;
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const pid_t living = ::fork();
  if (living == 0) {
    std::ofstream(temporary_beside(folder / "living.mp4")) << "x";
    (void)!::write(ends[1], "r", 1);
    ::pause();
  }
  char ready = 0;
  ASSERT_EQ(::read(ends[0], &ready, 1), 1);
  EXPECT_EQ(in_child([&] {
              std::ofstream(temporary_beside(folder / "dead.mp4")) << "x";
              return 0;
            }),
            0);
  std::ofstream(temporary_beside(folder / "mine.mp4")) << "x";
  std::ofstream(folder / ".foreign.skylapse-notours.tmp") << "x";
  std::ofstream(folder / ".other.skylapse-00000000-1-1-1.tmp") << "x";  // another machine, fresh
  ASSERT_EQ(folder.entries().size(), 5u);
  EXPECT_EQ(remove_stale_temporaries(folder.path()), 1u);
  for (const std::string& name : folder.entries())
    EXPECT_THAT(name, testing::Not(HasSubstr("dead")));
  ::kill(living, SIGKILL);
  ::waitpid(living, nullptr, 0);
  EXPECT_EQ(remove_stale_temporaries(folder.path()), 1u);
  EXPECT_EQ(folder.entries().size(), 3u);
}

TEST(StaleTemporaries, AnotherMachinesAreRemovedAfterADay) {
  const TemporaryFolder folder;
  const fs::path old = folder / ".f.skylapse-00000000-1-1-1.tmp";
  std::ofstream(old) << "x";
  fs::last_write_time(old, fs::file_time_type::clock::now() - std::chrono::hours(25));
  EXPECT_EQ(remove_stale_temporaries(folder.path()), 1u);
}

}  // namespace
}  // namespace skylapse::output
