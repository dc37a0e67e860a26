#include "output/imageio/scene_space.h"

#include <array>
#include <optional>
#include <vector>

namespace OCIO = OCIO_NAMESPACE;

namespace skylapse::output::imageio {
namespace {

using color::RgbSpace;

/// Names in use for each space, the exact one first.
const std::vector<std::string>& names_of(RgbSpace space) {
  static const std::vector<std::string> rec709{
      "lin_rec709",    "lin_rec709_scene",           "lin_rec709_srgb",
      "lin_srgb",      "Linear Rec.709 (sRGB)",      "Linear Rec.709",
      "Linear sRGB",   "Utility - Linear - Rec.709", "Utility - Linear - sRGB",
      "Linear BT.709", "scene-linear Rec.709-sRGB"};
  static const std::vector<std::string> rec2020{"lin_rec2020", "lin_rec2020_scene",
                                                "Linear Rec.2020", "Utility - Linear - Rec.2020",
                                                "Linear BT.2020"};
  static const std::vector<std::string> acescg{"ACEScg", "lin_ap1", "lin_ap1_scene",
                                               "ACES - ACEScg"};
  static const std::vector<std::string> ap0{"ACES2065-1", "aces2065_1", "lin_ap0", "lin_ap0_scene",
                                            "ACES - ACES2065-1"};
  switch (space) {
    case RgbSpace::rec709:
      return rec709;
    case RgbSpace::rec2020:
      return rec2020;
    case RgbSpace::acescg:
      return acescg;
    case RgbSpace::aces2065_1:
      break;
  }
  return ap0;
}

std::optional<std::string> present(const OCIO::Config& config, RgbSpace space) {
  for (const std::string& name : names_of(space))
    if (const auto found = config.getColorSpace(name.c_str()))
      if (!found->isData()) return std::string(found->getName());
  return {};
}

std::string first_spaces(const OCIO::Config& config) {
  constexpr int kListed = 20;
  std::string text;
  const int n = config.getNumColorSpaces();
  for (int i = 0; i < n && i < kListed; ++i)
    text += (i > 0 ? ", " : "") + std::string(config.getColorSpaceNameByIndex(i));
  return n > kListed ? text + ", ..." : text;
}

}  // namespace

Result<SceneEntry> find_scene_space(const OCIO::Config& config, RgbSpace space) {
  if (const auto name = present(config, space)) return SceneEntry{*name};
  if (config.hasRole("aces_interchange"))
    return SceneEntry{"aces_interchange", color::rgb_to_rgb(space, RgbSpace::aces2065_1)};
  for (const RgbSpace other :
       {RgbSpace::aces2065_1, RgbSpace::acescg, RgbSpace::rec2020, RgbSpace::rec709})
    if (const auto name = present(config, other))
      return SceneEntry{*name, color::rgb_to_rgb(space, other)};
  std::string looked;
  for (const std::string& name : names_of(space)) looked += (looked.empty() ? "" : ", ") + name;
  return Error{.code = ErrorCode::invalid_input,
               .message = "the OCIO config has no counterpart of the scene space '" +
                          std::string(color::rgb_space_name(space)) + "'",
               .hint = "give one of its spaces an alias such as " + looked +
                       ", or set the role aces_interchange; it has: " + first_spaces(config)};
}

}  // namespace skylapse::output::imageio
