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
constexpr int kGap = 4;

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

}  // namespace

Status make_contact_sheet(const std::vector<ExistingFrame>& all, const std::filesystem::path& file,
                          const SheetSettings& settings) {
  const auto io = output::open_image_io();
  if (!io) return io.error();
  const auto frames = evenly_chosen(all, settings.max_frames);
  std::vector<Result<image::FrameBuffer>> thumbnails(
      frames.size(), Result<image::FrameBuffer>(image::FrameBuffer()));
  parallel_for_ranges(frames.size(), 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      thumbnails[i] = thumbnail(**io, frames[i], settings.thumbnail_width);
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
  std::fill(sheet.data().begin(), sheet.data().end(), 0.12f);
  for (int i = 0; i < count; ++i) {
    const int x = kGap + i % columns * cell_width, y = kGap + i / columns * cell_height;
    paste(*thumbnails[i], sheet, x, y);
    const Status labelled =
        (*io)->draw_text(sheet, x + 2, y + cell_height - kGap - 6, 12, frames[i].label);
    if (!labelled) return labelled;
  }
  std::vector<uint8_t> rgb(sheet.data().size());
  std::transform(sheet.data().begin(), sheet.data().end(), rgb.begin(),
                 [](float v) { return uint8_t(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f); });
  output::EncodeRequest request;
  request.format = file.extension() == ".jpg" || file.extension() == ".jpeg" ? "jpg" : "png";
  request.width = sheet.width(), request.height = sheet.height();
  request.type = output::SampleType::u8;
  request.pixels = rgb.data();
  const auto bytes = (*io)->encode(request);
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
