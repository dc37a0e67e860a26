#include "diff/page_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diff/packed_samples.h"
#include "diff/shrink.h"
#include "diff/wording.h"

namespace skylapse::diff {
namespace {

using Json = nlohmann::ordered_json;

/// Errors too small to be seen in any scale of the viewer, in shares and in code values: 0.
constexpr float kLeastRelative = 1e-7f, kLeastCodeValue = 1e-3f;
/// Nodes of a camera's grid: four pixels of a picture 1024 wide lie between two.
constexpr int kGridCells = 256;

Json picture_json(const image::Picture& full, const image::Picture& small, int factor) {
  Json names = Json::array();
  for (const std::string& name : small.channels) names.push_back(one_line(name));
  Json j{{"w", small.width},
         {"h", small.height},
         {"fw", full.width},
         {"fh", full.height},
         {"k", factor},
         {"ch", names},
         {"colours", full.colour_count()}};
  const size_t left_out = full.channels.size() - small.channels.size();
  if (left_out > 0) j["left_out"] = left_out;
  return j;
}

/// The errors with a sign: minus where B's light is less. What is no number has none.
std::vector<float> signed_errors(const PairEvidence& e) {
  const float least = e.a.display_referred ? kLeastCodeValue : kLeastRelative;
  std::vector<float> out(e.error.size(), 0.0f);
  const int colours = std::min(e.a.colour_count(), e.b.colour_count());
  for (size_t i = 0; i < out.size(); ++i) {
    if (!(std::abs(e.error[i]) >= least)) continue;
    const float* a = e.a.samples.data() + i * e.a.channels.size();
    const float* b = e.b.samples.data() + i * e.b.channels.size();
    double difference = 0;
    for (int c = 0; c < colours; ++c) difference += double(b[c]) - double(a[c]);
    out[i] = difference < 0 ? -e.error[i] : e.error[i];
  }
  return out;
}

Codes flip_codes(const std::vector<float>& flip, int width, int height) {
  Codes codes{width, height, 1, 8, {}};
  codes.values.reserve(flip.size());
  for (const float f : flip)
    codes.values.push_back(std::isnan(f) ? 255u
                                         : uint32_t(std::lround(255 * std::clamp(f, 0.f, 1.f))));
  return codes;
}

}  // namespace

PackedPictures packed_pictures(const PairEvidence& e, int max_width) {
  PackedPictures out;
  const int factor = std::max(shrink_factor(e.a.width, e.a.height, max_width),
                              shrink_factor(e.b.width, e.b.height, max_width));
  const auto small_of = [&](const image::Picture& p) {
    return shrunk(p, factor, std::min(p.channel_count(), kPageChannels));
  };
  const auto codes_of = [](const image::Picture& p) {
    return float_codes(p.samples, p.width, p.height, p.channel_count(), kPixelMantissa);
  };
  const image::Picture a = small_of(e.a), b = small_of(e.b);
  const Codes codes_a = codes_of(a), codes_b = codes_of(b);
  const bool alike = a.width == b.width && a.height == b.height && a.channels == b.channels;
  PackedCodes packed_a = packed(codes_a, nullptr);
  PackedCodes packed_b = packed(codes_b, alike ? &codes_a : nullptr);
  out.facts = {{"display", e.a.display_referred},   {"bits", codes_a.bits},
               {"error_bits", 9 + kErrorMantissa},  {"a", picture_json(e.a, a, factor)},
               {"b", picture_json(e.b, b, factor)}, {"b_from", int(packed_b.prediction)}};
  out.elements.emplace_back("a", std::move(packed_a.text));
  out.elements.emplace_back("b", std::move(packed_b.text));
  if (e.error.size() == e.a.pixel_count() && e.a.pixel_count() == e.b.pixel_count()) {
    const auto small = shrunk_by_largest(signed_errors(e), e.a.width, e.a.height, factor);
    out.elements.emplace_back(
        "e", packed(float_codes(small, a.width, a.height, 1, kErrorMantissa), nullptr).text);
  }
  if (e.flip.size() == e.a.pixel_count()) {
    const auto small = shrunk_by_largest(e.flip, e.a.width, e.a.height, factor);
    out.elements.emplace_back("f", packed(flip_codes(small, a.width, a.height), nullptr).text);
  }
  return out;
}

int CameraGrids::add(const image::Camera& camera) {
  std::string key =
      fmt::format("{} {} {} {} {}", int(camera.projection), camera.width, camera.height,
                  camera.field_of_view.in(deg), int(camera.cube_layout));
  for (int i = 0; i < 9; ++i) key += fmt::format(" {:.9f}", camera.camera_to_enu[i / 3][i % 3]);
  const auto [found, is_new] = known_.emplace(key, int(list_.size()));
  if (!is_new) return found->second;
  const int step = std::max(1, std::max(camera.width, camera.height) / kGridCells);
  Codes codes{camera.width / step + 2, camera.height / step + 2, 3, 16, {}};
  const size_t nodes = size_t(codes.width) * size_t(codes.height);
  codes.values.resize(3 * nodes);
  for (size_t i = 0; i < nodes; ++i) {
    const image::PixelPosition at{double(i % codes.width) * step, double(i / codes.width) * step};
    if (at.x > camera.width || at.y > camera.height) continue;
    const auto direction = direction_at(camera, at);
    if (!direction) continue;
    for (int c = 0; c < 3; ++c)
      codes.values[c * nodes + i] = uint32_t(1 + std::lround(32767 * (1 + direction->vec()[c])));
  }
  list_.push_back({{"w", camera.width},
                   {"h", camera.height},
                   {"gw", codes.width},
                   {"gh", codes.height},
                   {"step", step},
                   {"bits", codes.bits},
                   {"d", packed(codes, nullptr).text}});
  return found->second;
}

}  // namespace skylapse::diff
