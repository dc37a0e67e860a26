#pragma once
// A movie from frames, through the ffmpeg program at run time.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "core/result.h"

namespace skylapse::output {

struct MovieSettings {
  int width = 0, height = 0;  // of the frames; odd sizes are padded by one pixel for 4:2:0
  double frames_per_second = 30;
  int crf = 18;  // constant quality; 0 is best, 51 (63 for webm) is worst
};

/// Path of the ffmpeg program, found along PATH. None: missing_backend that says what to install.
Result<std::string> find_ffmpeg();
/// First line of `ffmpeg -version`, for diagnosis.
Result<std::string> ffmpeg_version();

/// Encodes 8-bit RGB frames (sRGB or Rec. 709, full range) to H.264 (.mp4, .mov, .mkv) or VP9
/// (.webm), 4:2:0, tagged BT.709, limited range. The same frames give the same bytes on the same
/// ffmpeg. The file appears by rename when finish() succeeds; before that, and when the writer is
/// destroyed unfinished, nothing is visible. Not for use by several threads at once.
class MovieWriter {
 public:
  /// Errors: invalid_input (extension, sizes, rate, crf), missing_backend (no ffmpeg),
  /// write_failed.
  static Result<MovieWriter> open(const std::filesystem::path& path, const MovieSettings& settings);
  /// width * height * 3 bytes, row 0 at the top.
  Status add_frame(std::span<const uint8_t> rgb);
  /// Waits for ffmpeg and publishes the file. No frame at all is an error (invalid_input).
  Status finish();

  MovieWriter(MovieWriter&&) noexcept;
  MovieWriter& operator=(MovieWriter&&) noexcept;
  ~MovieWriter();

 private:
  struct State;
  explicit MovieWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace skylapse::output
