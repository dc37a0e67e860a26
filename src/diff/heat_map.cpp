#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "diff/evidence.h"
#include "diff/heat_map_panel.h"
#include "diff/reports.h"
#include "output/atomic_file.h"
#include "output/image_writer.h"

namespace skylapse::diff {
namespace {

/// Errors of all pixels; where the pictures cannot be held against each other, none is known.
std::vector<float> errors_of(PairEvidence& evidence) {
  if (!evidence.error.empty()) return std::move(evidence.error);
  return std::vector<float>(evidence.a.pixel_count(), std::numeric_limits<float>::infinity());
}

output::EncodeRequest exr_request(const PairEvidence& evidence, const std::vector<float>& errors) {
  return {.format = "exr",
          .width = evidence.a.width,
          .height = evidence.a.height,
          .type = output::SampleType::float32,
          .pixels = errors.data(),
          .attributes = {{"skylapse:content", std::string(evidence.a.display_referred
                                                              ? "error in 8-bit code values"
                                                              : "error as a share of the light")}},
          .channels = {"error"}};
}

Result<std::vector<std::byte>> encoded_png(const output::ImageIo& io, const PairResult& pair,
                                           const PairEvidence& evidence,
                                           const std::vector<float>& errors) {
  const auto panel = heat_map_panel(io, pair, evidence, errors);
  if (!panel) return panel.error();
  std::vector<uint8_t> codes;
  codes.reserve(panel->data().size());
  for (const float v : panel->data()) codes.push_back(uint8_t(std::lround(255 * v)));
  return io.encode({.format = "png",
                    .width = panel->width(),
                    .height = panel->height(),
                    .type = output::SampleType::u8,
                    .pixels = codes.data()});
}

}  // namespace

Status write_heat_map(const PairResult& pair, const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension != ".png" && extension != ".exr")
    return Error{.code = ErrorCode::invalid_input,
                 .message = fmt::format("a heat map cannot be written to '{}'", path),
                 .hint = "colours: .png; numbers: .exr"};
  auto evidence = read_evidence(pair);
  if (!evidence) return evidence.error();
  const auto io = output::open_image_io();
  if (!io) return io.error();
  const std::vector<float> errors = errors_of(*evidence);
  const auto bytes = extension == ".png" ? encoded_png(**io, pair, *evidence, errors)
                                         : (*io)->encode(exr_request(*evidence, errors));
  if (!bytes) return bytes.error();
  return output::write_file_atomically(path, *bytes);
}

}  // namespace skylapse::diff
