#include "pipeline/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/parallel.h"
#include "output/atomic_file.h"
#include "output/image_writer.h"
#include "output/movie_writer.h"

namespace skylapse::pipeline {
namespace {

constexpr int kLabelHeight = 18;
constexpr int kTextHeight = 12;
constexpr int kGap = 4;
constexpr float kBackground = 0.12f;

std::vector<ExistingFrame> evenly_chosen(const std::vector<ExistingFrame>& frames, int most) {
  if (int(frames.size()) <= most) return frames;
  std::vector<ExistingFrame> chosen;
  for (int i = 0; i < most; ++i)
    chosen.push_back(
        frames[size_t(std::llround(double(i) * double(frames.size() - 1) / (most - 1)))]);
  return chosen;
}

/// IEC 61966-2-1.
float srgb_encoded(float v) {
  v = std::clamp(v, 0.0f, 1.0f);
  return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
}

Result<image::FrameBuffer> thumbnail(const output::ImageIo& io, const ExistingFrame& frame,
                                     int width) {
  auto image = io.decode(frame.path.string());
  if (!image) return image.error();
  const int height =
      std::max(1, int(std::lround(double(width) * image->pixels.height() / image->pixels.width())));
  auto small = io.resized(image->pixels, width, height);
  if (!small) return small.error();
  if (image->floating_point)
    for (float& v : small->data()) v = srgb_encoded(v);
  return small;
}

void paste(const image::FrameBuffer& from, image::FrameBuffer& to, int x, int y) {
  for (int row = 0; row < from.height() && y + row < to.height(); ++row)
    std::memcpy(to.pixel(x, y + row), from.row(row), sizeof(float) * 3 * from.width());
}

/// As many columns of a strip as fit.
void paste_columns(const image::FrameBuffer& from, image::FrameBuffer& to) {
  const int columns = std::min(from.width(), to.width());
  for (int y = 0; y < to.height(); ++y)
    std::memcpy(to.row(y), from.row(y), sizeof(float) * 3 * size_t(columns));
}

/// Columns of a strip up to the last that text was drawn in.
int drawn_width(const image::FrameBuffer& strip) {
  for (int x = strip.width(); x > 0; --x)
    for (int y = 0; y < strip.height(); ++y) {
      const float* p = strip.pixel(x - 1, y);
      if (p[0] != kBackground || p[1] != kBackground || p[2] != kBackground) return x;
    }
  return 0;
}

/// The label of a frame that is shortened `times` times, as far as it can be.
const std::string& label_text(const ExistingFrame& frame, size_t times) {
  const size_t i = std::min(times, frame.shorter.size());
  return i == 0 ? frame.label : frame.shorter[i - 1];
}

/// Text on the background, as wide as it needs.
Result<image::FrameBuffer> drawn_text(const output::ImageIo& io, const std::string& text) {
  // No glyph of the font is wider than 1.4 times its height.
  image::FrameBuffer strip(2 + int(1.4 * kTextHeight) * (int(text.size()) + 1), kLabelHeight);
  std::fill(strip.data().begin(), strip.data().end(), kBackground);
  const Status drawn = io.draw_text(strip, 2, kLabelHeight - 6, kTextHeight, text);
  if (!drawn) return drawn.error();
  return strip;
}

/// How often the labels of a sheet are shortened, all alike, until each fits under a picture of
/// `width`; at last they are cut.
Result<size_t> times_shortened(const output::ImageIo& io, const std::vector<ExistingFrame>& frames,
                               int width) {
  size_t times = 0;
  for (const ExistingFrame& frame : frames)
    while (times < frame.shorter.size()) {
      const auto strip = drawn_text(io, label_text(frame, times));
      if (!strip) return strip.error();
      if (drawn_width(*strip) <= width) break;
      ++times;
    }
  return times;
}

/// A label under a picture of `width`, cut where it is wider.
Result<image::FrameBuffer> label_strip(const output::ImageIo& io, const std::string& text,
                                       int width) {
  const auto strip = drawn_text(io, text);
  if (!strip) return strip.error();
  image::FrameBuffer cut(width, kLabelHeight);
  std::fill(cut.data().begin(), cut.data().end(), kBackground);
  paste_columns(*strip, cut);
  return cut;
}

}  // namespace

Result<std::vector<std::byte>> contact_sheet(const output::ImageIo& io,
                                             const std::vector<ExistingFrame>& all,
                                             const std::string& format,
                                             const SheetSettings& settings) {
  const auto frames = evenly_chosen(all, settings.max_frames);
  std::vector<Result<image::FrameBuffer>> thumbnails(
      frames.size(), Result<image::FrameBuffer>(image::FrameBuffer()));
  parallel_for_ranges(frames.size(), 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      thumbnails[i] = thumbnail(io, frames[i], settings.thumbnail_width);
  });
  int cell_height = 0;
  for (const auto& small : thumbnails) {
    if (!small) return small.error();
    cell_height = std::max(cell_height, small->height());
  }
  cell_height += kLabelHeight + kGap;
  const int cell_width = settings.thumbnail_width + kGap;
  const int count = int(frames.size());
  const int columns =
      settings.columns > 0
          ? settings.columns
          : std::max(1, int(std::lround(std::sqrt(double(count) * cell_height / cell_width))));
  const int rows = (count + columns - 1) / columns;
  image::FrameBuffer sheet(columns * cell_width + kGap, rows * cell_height + kGap);
  std::fill(sheet.data().begin(), sheet.data().end(), kBackground);
  const auto times = times_shortened(io, frames, settings.thumbnail_width);
  if (!times) return times.error();
  for (int i = 0; i < count; ++i) {
    const int x = kGap + i % columns * cell_width, y = kGap + i / columns * cell_height;
    paste(*thumbnails[i], sheet, x, y);
    const auto label = label_strip(io, label_text(frames[i], *times), settings.thumbnail_width);
    if (!label) return label.error();
    paste(*label, sheet, x, y + cell_height - kGap - kLabelHeight);
  }
  std::vector<uint8_t> rgb(sheet.data().size());
  std::transform(sheet.data().begin(), sheet.data().end(), rgb.begin(),
                 [](float v) { return uint8_t(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f); });
  output::EncodeRequest request;
  request.format = format;
  request.width = sheet.width(), request.height = sheet.height();
  request.type = output::SampleType::u8;
  request.pixels = rgb.data();
  return io.encode(request);
}

Status make_contact_sheet(const std::vector<ExistingFrame>& frames,
                          const std::filesystem::path& file, const SheetSettings& settings) {
  const bool jpeg = has_extension(file, {"jpg", "jpeg"});
  if (!jpeg && !has_extension(file, {"png"}))
    return Error{ErrorCode::invalid_input,
                 fmt::format("'{}' has no extension of a contact sheet", file.string()),
                 {},
                 "known: .png, .jpg, .jpeg"};
  const auto io = output::open_image_io();
  if (!io) return io.error();
  const auto bytes = contact_sheet(**io, frames, jpeg ? "jpg" : "png", settings);
  if (!bytes) return bytes.error();
  return output::write_file_atomically(file, *bytes);
}

Status make_movie_of_frames(const std::vector<ExistingFrame>& frames,
                            const std::filesystem::path& file, const MovieOfFrames& settings) {
  const auto io = output::open_image_io();
  if (!io) return io.error();
  std::optional<output::MovieWriter> writer;
  int width = 0, height = 0;
  for (const ExistingFrame& frame : frames) {
    const auto image = (*io)->decode(frame.path.string());
    if (!image) return image.error();
    const image::FrameBuffer& pixels = image->pixels;
    if (!writer) {
      width = pixels.width(), height = pixels.height();
      auto opened = output::MovieWriter::open(
          file, {width, height, settings.frames_per_second, settings.crf});
      if (!opened) return opened.error();
      writer = std::move(*opened);
    }
    if (pixels.width() != width || pixels.height() != height)
      return Error{ErrorCode::invalid_input,
                   fmt::format("'{}' is {}x{}, the first frame {}x{}", frame.path.string(),
                               pixels.width(), pixels.height(), width, height),
                   {},
                   "all frames of a movie need one size"};
    std::vector<uint8_t> rgb(pixels.data().size());
    std::transform(pixels.data().begin(), pixels.data().end(), rgb.begin(),
                   [](float v) { return uint8_t(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f); });
    const Status added = writer->add_frame(rgb);
    if (!added) return added;
  }
  return writer->finish();
}

}  // namespace skylapse::pipeline
