#include "output/movie_writer.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "output/atomic_file.h"
#include "output/child_process.h"

namespace skylapse::output {
namespace fs = std::filesystem;
namespace {

/// What the extension asks for.
struct Container {
  std::string extension;
  std::string muxer;
  bool vp9 = false;
};

const std::vector<Container>& containers() {
  static const std::vector<Container> all{
      {".mp4", "mp4"}, {".mov", "mov"}, {".mkv", "matroska"}, {".webm", "webm", true}};
  return all;
}

Error invalid(std::string message, std::string hint = {}) {
  return {.code = ErrorCode::invalid_input, .message = std::move(message), .hint = std::move(hint)};
}

Result<Container> container_of(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Container& c : containers())
    if (c.extension == extension) return c;
  return invalid("'" + path.string() + "' has no movie extension",
                 "known: .mp4, .mov, .mkv (H.264), .webm (VP9)");
}

Status check(const MovieSettings& s, const Container& container) {
  constexpr int kLargestSide = 16384;  // of H.264 level 6.2 and of VP9 as encoders implement them
  if (s.width < 1 || s.height < 1 || s.width > kLargestSide || s.height > kLargestSide)
    return invalid("movie frames of " + std::to_string(s.width) + " x " + std::to_string(s.height) +
                       " pixels are not possible",
                   "allowed: 1 to 16384 on each side");
  if (!(s.frames_per_second > 0 && s.frames_per_second <= 1000))
    return invalid("the movie's frame rate is out of range", "allowed: above 0 to 1000 per second");
  const int worst = container.vp9 ? 63 : 51;
  if (s.crf < 0 || s.crf > worst)
    return invalid("crf " + std::to_string(s.crf) + " is out of range",
                   "allowed: 0 to " + std::to_string(worst));
  return Done{};
}

int even(int n) { return n + n % 2; }

std::string number(double v) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, v).ptr};
}

/// The command line. A fixed number of threads, because encoders cut the work by it and write
/// other bytes for another number; bitexact, because containers else carry dates and random ids.
std::vector<std::string> arguments(const MovieSettings& s, const Container& container,
                                   const fs::path& target) {
  const std::string size = std::to_string(even(s.width)) + "x" + std::to_string(even(s.height));
  std::vector<std::string> all{
      "-hide_banner", "-nostdin", "-loglevel", "error", "-y",
      // the frames as they come
      "-f", "rawvideo", "-pixel_format", "rgb24", "-video_size", size, "-framerate",
      number(s.frames_per_second), "-i", "pipe:0", "-an",
      // R'G'B' to Y'CbCr as BT.709-6 has it, and a label that says so
      "-vf",
      "scale=flags=accurate_rnd+full_chroma_int:out_color_matrix=bt709:out_range=tv,"
      "format=yuv420p",
      "-color_primaries", "bt709", "-color_trc", "bt709", "-colorspace", "bt709", "-color_range",
      "tv", "-crf", std::to_string(s.crf), "-threads", "4", "-fflags", "+bitexact", "-flags:v",
      "+bitexact"};
  const auto add = [&all](std::initializer_list<const char*> more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  if (container.vp9)
    add({"-c:v", "libvpx-vp9", "-b:v", "0", "-deadline", "good", "-cpu-used", "4", "-row-mt", "1"});
  else
    add({"-c:v", "libx264", "-preset", "medium"});
  if (container.muxer == "mp4" || container.muxer == "mov") add({"-movflags", "+faststart"});
  all.insert(all.end(), {"-f", container.muxer, "file:" + target.string()});
  return all;
}

std::string last_lines(const std::string& text, int lines) {
  size_t end = text.size();
  while (end > 0 && text[end - 1] == '\n') --end;
  size_t begin = end;
  while (begin > 0 && (text[begin - 1] != '\n' || --lines > 0)) --begin;
  return text.substr(begin, end - begin);
}

}  // namespace

struct MovieWriter::State {
  fs::path path;
  fs::path temporary;
  MovieSettings settings;
  ChildProcess ffmpeg;
  long frames = 0;
  bool finished = false;
  std::optional<Error> failed{};
  std::vector<uint8_t> padded{};

  ~State() {
    if (finished) return;
    { const ChildProcess ended = std::move(ffmpeg); }  // killed before its file goes
    ::unlink(temporary.c_str());
  }

  /// Ends ffmpeg after a failure and says why it failed; the same answer to every later call.
  const Error& failure() {
    if (!failed) failed = diagnose();
    return *failed;
  }

  Error diagnose() {
    const int status = ffmpeg.wait();
    const std::string printed = last_lines(ffmpeg.printed(), 4);
    const bool full = printed.find(std::strerror(ENOSPC)) != std::string::npos;
    Error error = write_error(path, full ? ENOSPC : EIO);
    if (!full) {
      error.message = "cannot write '" + path.string() + "': ffmpeg ended with status " +
                      std::to_string(status);
      error.hint = "see what ffmpeg said; the frames themselves are not touched";
    }
    if (printed.find("Unknown encoder") != std::string::npos) {
      error.code = ErrorCode::missing_backend;
      error.hint = "install an ffmpeg with libx264 and libvpx (apt-get install ffmpeg)";
    }
    if (!printed.empty()) error.message += "\n" + printed;
    return error;
  }

  /// The frame with its last column and row repeated up to even sizes.
  std::span<const uint8_t> to_even(std::span<const uint8_t> rgb) {
    const auto w = static_cast<size_t>(settings.width);
    const auto h = static_cast<size_t>(settings.height);
    const auto even_w = static_cast<size_t>(even(settings.width));
    const auto even_h = static_cast<size_t>(even(settings.height));
    if (w == even_w && h == even_h) return rgb;
    padded.resize(3 * even_w * even_h);
    for (size_t y = 0; y < even_h; ++y) {
      const uint8_t* const from = rgb.data() + 3 * w * std::min(y, h - 1);
      uint8_t* const to = padded.data() + 3 * even_w * y;
      std::copy_n(from, 3 * w, to);
      if (even_w > w) std::copy_n(from + 3 * (w - 1), 3, to + 3 * w);
    }
    return padded;
  }
};

Result<std::string> find_ffmpeg() {
  if (auto program = find_program("ffmpeg")) return *std::move(program);
  return Error{.code = ErrorCode::missing_backend,
               .message = "movies need the program ffmpeg, which is not in PATH",
               .hint = "install ffmpeg (apt-get install ffmpeg)"};
}

Result<std::string> ffmpeg_version() {
  const auto program = find_ffmpeg();
  if (!program) return program.error();
  auto child = ChildProcess::start(*program, {"-hide_banner", "-version"});
  if (!child) return child.error();
  const int status = child->wait();
  const std::string text = child->printed();
  if (status != 0)
    return Error{.code = ErrorCode::missing_backend,
                 .message = *program + " does not run: " + last_lines(text, 2),
                 .hint = "install ffmpeg anew (apt-get install --reinstall ffmpeg)"};
  return text.substr(0, text.find('\n'));
}

MovieWriter::MovieWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
MovieWriter::MovieWriter(MovieWriter&&) noexcept = default;
MovieWriter& MovieWriter::operator=(MovieWriter&&) noexcept = default;
MovieWriter::~MovieWriter() = default;

Result<MovieWriter> MovieWriter::open(const fs::path& path, const MovieSettings& settings) {
  const auto container = container_of(path);
  if (!container) return container.error();
  if (const Status ok = check(settings, *container); !ok) return ok.error();
  const auto program = find_ffmpeg();
  if (!program) return program.error();
  if (const Status parents = make_parent_folders(path); !parents) return parents.error();
  const fs::path temporary = temporary_beside(path);
  auto ffmpeg = ChildProcess::start(*program, arguments(settings, *container, temporary));
  if (!ffmpeg) return ffmpeg.error();
  return MovieWriter(
      std::unique_ptr<State>(new State{path, temporary, settings, std::move(ffmpeg).value()}));
}

Status MovieWriter::add_frame(std::span<const uint8_t> rgb) {
  State& s = *state_;
  const size_t expected =
      size_t{3} * static_cast<size_t>(s.settings.width) * static_cast<size_t>(s.settings.height);
  if (rgb.size() != expected)
    return invalid("a movie frame has " + std::to_string(rgb.size()) + " bytes instead of " +
                   std::to_string(expected));
  if (s.failed || s.ffmpeg.write(std::as_bytes(s.to_even(rgb))) != 0) return s.failure();
  ++s.frames;
  return Done{};
}

Status MovieWriter::finish() {
  State& s = *state_;
  if (s.frames == 0) return invalid("'" + s.path.string() + "': a movie needs at least one frame");
  if (s.failed || s.ffmpeg.wait() != 0) return s.failure();
  s.finished = true;
  return publish(s.temporary, s.path);
}

}  // namespace skylapse::output
