#include "image/camera/camera_words.h"

#include <algorithm>
#include <array>

namespace skylapse::image {
namespace {

constexpr std::array<std::string_view, 8> kProjections{
    "perspective", "fisheye-equidistant", "fisheye-equisolid", "fisheye-stereographic", "lat-long",
    "cube",        "octahedral",          "mirror-ball"};
constexpr std::array<std::string_view, 4> kLayouts{"horizontal-strip", "vertical-strip", "cross",
                                                   "vertical-cross"};
constexpr std::array<std::string_view, 6> kFaces{"+X", "-X", "+Y", "-Y", "+Z", "-Z"};

/// The value that a word stands for by its place.
template <class Value, size_t N>
std::optional<Value> value_of(const std::array<std::string_view, N>& words, std::string_view word) {
  const auto found = std::ranges::find(words, word);
  if (found == words.end()) return std::nullopt;
  return static_cast<Value>(found - words.begin());
}

}  // namespace

std::string_view name_of(Projection projection) { return kProjections[size_t(projection)]; }
std::optional<Projection> projection_from_name(std::string_view name) {
  return value_of<Projection>(kProjections, name);
}

std::string_view name_of(CubeLayout layout) { return kLayouts[size_t(layout)]; }
std::optional<CubeLayout> cube_layout_from_name(std::string_view name) {
  return value_of<CubeLayout>(kLayouts, name);
}

std::string_view name_of(CubeFace face) { return kFaces[size_t(face)]; }
std::optional<CubeFace> cube_face_from_name(std::string_view name) {
  return value_of<CubeFace>(kFaces, name);
}

}  // namespace skylapse::image
