#pragma once
// All frames of a day at one glance.
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "output/image_writer.h"
#include "pipeline/existing_frames.h"

namespace skylapse::pipeline {

struct SheetSettings {
  int columns = 0;  // 0: about as wide as high
  int thumbnail_width = 240;
  int max_frames = 120;  // evenly chosen if there are more
};

/// A sheet of labelled thumbnails as the bytes of a "png" or "jpg".
Result<std::vector<std::byte>> contact_sheet(const output::ImageIo& io,
                                             const std::vector<ExistingFrame>& frames,
                                             const std::string& format,
                                             const SheetSettings& settings);

/// Writes a PNG or JPEG sheet of labelled thumbnails, whole. If a label is wider than its picture
/// all are shortened alike, and at last cut, so that none reaches the next. Other extensions than
/// .png, .jpg and .jpeg are invalid_input. Scene-linear files (.exr, .hdr) are shown as they are
/// stored, clipped to 0..1 and sRGB-encoded.
Status make_contact_sheet(const std::vector<ExistingFrame>& frames,
                          const std::filesystem::path& file, const SheetSettings& settings);

struct MovieOfFrames {
  double frames_per_second = 30;
  int crf = 18;
};

/// Movie of existing pictures, which must all have the size of the first.
Status make_movie_of_frames(const std::vector<ExistingFrame>& frames,
                            const std::filesystem::path& file, const MovieOfFrames& settings);

}  // namespace skylapse::pipeline
