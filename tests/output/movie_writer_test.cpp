#include "output/movie_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>

#include "output/atomic_file.h"
#include "output/child_process.h"
#include "output/in_child.h"
#include "support/temporary_folder.h"

namespace skylapse::output {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Movie : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(find_ffmpeg().ok()) << "script/bootstrap installs ffmpeg"; }
};

std::vector<uint8_t> flat_frame(int width, int height, std::array<uint8_t, 3> rgb) {
  std::vector<uint8_t> frame;
  for (int i = 0; i < width * height; ++i) frame.insert(frame.end(), rgb.begin(), rgb.end());
  return frame;
}

std::vector<uint8_t> moving_frame(int width, int height, int number) {
  std::vector<uint8_t> frame;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        frame.push_back(static_cast<uint8_t>(3 * x + 2 * y + 5 * number + 40 * c));
  return frame;
}

/// Writes a short movie; the error text, empty on success.
std::string write_movie(const fs::path& path, int width, int height, int frames) {
  auto movie = MovieWriter::open(path, {width, height, 25, 20});
  if (!movie) return format_error(movie.error());
  for (int i = 0; i < frames; ++i)
    if (const Status s = movie->add_frame(moving_frame(width, height, i)); !s)
      return format_error(s.error());
  const Status s = movie->finish();
  return s.ok() ? "" : format_error(s.error());
}

/// What ffprobe says of the video stream, "key=value" lines.
std::string probe(const fs::path& path) {
  const auto ffprobe = find_program("ffprobe");
  if (!ffprobe) return {};
  auto child = ChildProcess::start(
      *ffprobe, {"-v", "error", "-count_frames", "-select_streams", "v:0", "-show_entries",
                 "stream=codec_name,width,height,pix_fmt,color_range,color_space,color_transfer,"
                 "color_primaries,r_frame_rate,nb_read_frames",
                 "-of", "default=nw=1", path.string()});
  if (!child || child->wait() != 0) return {};
  return child->printed();
}

/// First frame of a movie as RGB, as a player with BT.709 would show it.
std::vector<uint8_t> first_frame(const fs::path& path) {
  auto child = ChildProcess::start(
      *find_ffmpeg(),
      {"-v", "error", "-i", path.string(), "-frames:v", "1", "-vf",
       "scale=in_color_matrix=bt709:in_range=tv,format=rgb24", "-f", "rawvideo", "pipe:1"});
  if (!child || child->wait() != 0) return {};
  const std::string text = child->printed();
  return {text.begin(), text.end()};
}

TEST_F(Movie, FourContainersHoldTheirFramesAndSayBt709) {
  const TemporaryFolder folder;
  for (const char* name : {"m.mp4", "m.mov", "m.mkv", "m.webm"}) {
    ASSERT_EQ(write_movie(folder / name, 64, 48, 7), "");
    const std::string info = probe(folder / name);
    ASSERT_FALSE(info.empty()) << "ffprobe comes with ffmpeg; script/bootstrap installs it";
    EXPECT_THAT(info, HasSubstr(std::string("codec_name=") +
                                (std::string(name) == "m.webm" ? "vp9" : "h264")));
    for (const char* part :
         {"width=64", "height=48", "pix_fmt=yuv420p", "color_range=tv", "color_space=bt709",
          "color_transfer=bt709", "color_primaries=bt709", "r_frame_rate=25/1", "nb_read_frames=7"})
      EXPECT_THAT(info, HasSubstr(part)) << name;
  }
  EXPECT_THAT(folder.entries(), ElementsAre("m.mkv", "m.mov", "m.mp4", "m.webm"));
}

TEST_F(Movie, SameFramesGiveTheSameBytes) {
  const TemporaryFolder folder;
  for (const std::string extension : {".mp4", ".mkv", ".webm"}) {
    ASSERT_EQ(write_movie(folder / ("a" + extension), 160, 90, 40), "");
    ASSERT_EQ(write_movie(folder / ("b" + extension), 160, 90, 40), "");
    EXPECT_EQ(*read_file(folder / ("a" + extension)), *read_file(folder / ("b" + extension)))
        << extension;
  }
}

TEST_F(Movie, OddSizesArePaddedByTheLastRowAndColumn) {
  const TemporaryFolder folder;
  ASSERT_EQ(write_movie(folder / "odd.mp4", 33, 17, 3), "");
  const std::string info = probe(folder / "odd.mp4");
  ASSERT_FALSE(info.empty()) << "ffprobe comes with ffmpeg; script/bootstrap installs it";
  EXPECT_THAT(info, HasSubstr("width=34"));
  EXPECT_THAT(info, HasSubstr("height=18"));
}

TEST_F(Movie, ColoursSurviveTheWayThroughBt709) {
  const TemporaryFolder folder;
  for (const std::array<uint8_t, 3> rgb :
       {std::array<uint8_t, 3>{255, 255, 255}, {0, 0, 0}, {64, 128, 200}, {210, 120, 40}}) {
    auto movie = MovieWriter::open(folder / "c.mp4", {32, 32, 25, 1});
    ASSERT_TRUE(movie.ok());
    ASSERT_TRUE(movie->add_frame(flat_frame(32, 32, rgb)).ok());
    ASSERT_TRUE(movie->finish().ok());
    const auto back = first_frame(folder / "c.mp4");
    ASSERT_EQ(back.size(), 32u * 32u * 3u);
    // 8-bit limited range has 219 luma codes for 255: two codes of RGB for rounding both ways.
    for (size_t i = 0; i < back.size(); ++i)
      ASSERT_NEAR(back[i], rgb[i % 3], 2) << "channel " << i % 3;
  }
}

TEST_F(Movie, AbandonedWriterLeavesNothing) {
  const TemporaryFolder folder;
  {
    auto movie = MovieWriter::open(folder / "gone.mp4", {64, 48, 25, 20});
    ASSERT_TRUE(movie.ok());
    for (int i = 0; i < 60; ++i) ASSERT_TRUE(movie->add_frame(moving_frame(64, 48, i)).ok());
  }
  EXPECT_THAT(folder.entries(), IsEmpty());
}

TEST_F(Movie, NothingIsVisibleBeforeItIsFinished) {
  const TemporaryFolder folder;
  auto movie = MovieWriter::open(folder / "m.mp4", {64, 48, 25, 20});
  ASSERT_TRUE(movie.ok());
  for (int i = 0; i < 60; ++i) ASSERT_TRUE(movie->add_frame(moving_frame(64, 48, i)).ok());
  EXPECT_FALSE(fs::exists(folder / "m.mp4"));
  ASSERT_TRUE(movie->finish().ok());
  EXPECT_THAT(folder.entries(), ElementsAre("m.mp4"));
}

TEST_F(Movie, InterruptOfOurProcessGroupDoesNotReachFfmpeg) {
  const TemporaryFolder folder;
  EXPECT_EQ(in_child([&] {
              ::setpgid(0, 0);
              std::signal(SIGINT, SIG_IGN);
              auto movie = MovieWriter::open(folder / "m.mp4", {64, 48, 25, 20});
              if (!movie) return 1;
              for (int i = 0; i < 20; ++i) {
                if (!movie->add_frame(moving_frame(64, 48, i)).ok()) return 2;
                if (i == 10) ::kill(0, SIGINT);
              }
              return movie->finish().ok() ? 0 : 3;
            }),
            0);
  EXPECT_THAT(folder.entries(), ElementsAre("m.mp4"));
}

TEST_F(Movie, FfmpegThatFailsIsAWriteErrorAndNothingRemains) {
  const TemporaryFolder folder;
  EXPECT_EQ(in_child([&] {
              const rlimit limit{1024, 1024};
              if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) return 9;
              auto movie = MovieWriter::open(folder / "m.mp4", {320, 240, 25, 1});
              if (!movie) return 1;
              Status s = Done{};
              for (int i = 0; i < 200 && s.ok(); ++i)
                s = movie->add_frame(moving_frame(320, 240, i));
              if (s.ok()) s = movie->finish();
              if (s.ok()) return 2;
              if (s.error().code != ErrorCode::write_failed) return 3;
              const Status again = movie->add_frame(moving_frame(320, 240, 0));
              return !again.ok() && again.error().message == s.error().message ? 0 : 4;
            }),
            0);
  EXPECT_THAT(folder.entries(), IsEmpty());
}

TEST_F(Movie, WrongSettingsAreRefused) {
  const TemporaryFolder folder;
  const auto refused = [&](const char* name, const MovieSettings& settings) {
    const auto movie = MovieWriter::open(folder / name, settings);
    EXPECT_FALSE(movie.ok());
    if (movie.ok()) return std::string();
    EXPECT_EQ(movie.error().code, ErrorCode::invalid_input);
    return movie.error().message + " " + movie.error().hint;
  };
  EXPECT_THAT(refused("m.avi", {64, 48, 25, 20}), HasSubstr(".webm"));
  EXPECT_THAT(refused("m.mp4", {0, 48, 25, 20}), HasSubstr("16384"));
  EXPECT_THAT(refused("m.mp4", {64, 48, 0, 20}), HasSubstr("frame rate"));
  EXPECT_THAT(refused("m.mp4", {64, 48, 25, 52}), HasSubstr("0 to 51"));
  EXPECT_THAT(folder.entries(), IsEmpty());
}

TEST_F(Movie, WrongFrameSizeAndNoFramesAreRefused) {
  const TemporaryFolder folder;
  {
    auto movie = MovieWriter::open(folder / "m.mp4", {64, 48, 25, 20});
    ASSERT_TRUE(movie.ok());
    EXPECT_FALSE(movie->add_frame(moving_frame(64, 47, 0)).ok());
    EXPECT_FALSE(movie->finish().ok());
  }
  EXPECT_THAT(folder.entries(), IsEmpty());
}

TEST(MovieWithoutFfmpeg, SaysWhatToInstall) {
  const TemporaryFolder folder;
  EXPECT_EQ(in_child([&] {
              ::setenv("PATH", "/nonexistent", 1);
              const auto movie = MovieWriter::open(folder / "m.mp4", {64, 48, 25, 20});
              if (movie.ok() || movie.error().code != ErrorCode::missing_backend) return 1;
              return movie.error().hint.find("apt-get install ffmpeg") != std::string::npos ? 0 : 2;
            }),
            0);
  EXPECT_THAT(folder.entries(), IsEmpty());
}

TEST_F(Movie, FfmpegVersionIsOneLine) {
  const auto version = ffmpeg_version();
  ASSERT_TRUE(version.ok());
  EXPECT_THAT(*version, testing::StartsWith("ffmpeg version"));
  EXPECT_EQ(version->find('\n'), std::string::npos);
}

}  // namespace
}  // namespace skylapse::output
