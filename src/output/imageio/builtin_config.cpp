#include "output/imageio/builtin_config.h"

#include <array>
#include <string>

#include "color/rgb_space.h"

namespace OCIO = OCIO_NAMESPACE;

namespace skylapse::output::imageio {
namespace {

OCIO::TransformRcPtr builtin(const char* style) {
  auto t = OCIO::BuiltinTransform::Create();
  t->setStyle(style);
  return t;
}

OCIO::TransformRcPtr matrix(const glm::dmat3& m) {
  std::array<double, 16> rows{};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) rows[static_cast<size_t>(4 * r + c)] = m[c][r];
  rows[15] = 1;
  auto t = OCIO::MatrixTransform::Create();
  t->setMatrix(rows.data());
  return t;
}

void add_scene_space(OCIO::Config& config, const char* name, const char* alias,
                     OCIO::TransformRcPtr to_reference, const char* encoding) {
  auto space = OCIO::ColorSpace::Create(OCIO::REFERENCE_SPACE_SCENE);
  space->setName(name);
  space->addAlias(alias);
  space->setEncoding(encoding);
  if (to_reference) space->setTransform(to_reference, OCIO::COLORSPACE_DIR_TO_REFERENCE);
  config.addColorSpace(space);
}

void add_scene_linear(OCIO::Config& config, const char* name, const char* alias,
                      color::RgbSpace space) {
  add_scene_space(config, name, alias,
                  matrix(color::rgb_to_rgb(space, color::RgbSpace::aces2065_1)), "scene-linear");
}

void add_view_transform(OCIO::Config& config, const char* name, const char* style) {
  auto view = OCIO::ViewTransform::Create(OCIO::REFERENCE_SPACE_SCENE);
  view->setName(name);
  view->setTransform(builtin(style), OCIO::VIEWTRANSFORM_DIR_FROM_REFERENCE);
  config.addViewTransform(view);
}

void add_display(OCIO::Config& config, const char* name, const char* style,
                 const char* tone_mapped) {
  auto space = OCIO::ColorSpace::Create(OCIO::REFERENCE_SPACE_DISPLAY);
  space->setName(name);
  space->setTransform(builtin(style), OCIO::COLORSPACE_DIR_FROM_REFERENCE);
  config.addColorSpace(space);
  config.addDisplayView(name, tone_mapped, tone_mapped, name, "", "", "");
  config.addDisplayView(name, "Un-tone-mapped", "Un-tone-mapped", name, "", "", "");
  config.addDisplayView(name, "Log", "ACEScct", "");
  config.addDisplayView(name, "Raw", "Raw", "");
}

OCIO::ConstConfigRcPtr make_config() {
  auto config = OCIO::Config::Create();
  config->setMajorVersion(2);
  config->setMinorVersion(1);
  config->setName("skylapse-aces");

  add_scene_space(*config, "ACES2065-1", "aces2065_1", nullptr, "scene-linear");
  add_scene_linear(*config, "ACEScg", "lin_ap1", color::RgbSpace::acescg);
  add_scene_linear(*config, "Linear Rec.709 (sRGB)", "lin_rec709", color::RgbSpace::rec709);
  add_scene_linear(*config, "Linear Rec.2020", "lin_rec2020", color::RgbSpace::rec2020);
  add_scene_space(*config, "ACEScct", "acescct_ap1", builtin("ACEScct_to_ACES2065-1"), "log");
  add_scene_space(*config, "Raw", "utility_raw", nullptr, "data");

  auto connection = OCIO::ColorSpace::Create(OCIO::REFERENCE_SPACE_DISPLAY);
  connection->setName("CIE-XYZ-D65");
  config->addColorSpace(connection);

  add_view_transform(*config, "Un-tone-mapped", "UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD");
  add_view_transform(*config, "ACES SDR",
                     "ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0");
  add_view_transform(
      *config, "ACES HDR 1000 nits",
      "ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - HDR-VIDEO-1000nit-15nit-REC2020lim_1.1");
  config->setDefaultViewTransformName("Un-tone-mapped");

  add_display(*config, "sRGB", "DISPLAY - CIE-XYZ-D65_to_sRGB", "ACES SDR");
  add_display(*config, "Rec.1886 Rec.709", "DISPLAY - CIE-XYZ-D65_to_REC.1886-REC.709", "ACES SDR");
  add_display(*config, "P3-D65", "DISPLAY - CIE-XYZ-D65_to_G2.6-P3-D65", "ACES SDR");
  add_display(*config, "Rec.2100-PQ", "DISPLAY - CIE-XYZ-D65_to_REC.2100-PQ", "ACES HDR 1000 nits");

  config->setRole("aces_interchange", "ACES2065-1");
  config->setRole("cie_xyz_d65_interchange", "CIE-XYZ-D65");
  config->setRole(OCIO::ROLE_SCENE_LINEAR, "ACEScg");
  config->setRole(OCIO::ROLE_COMPOSITING_LOG, "ACEScct");
  config->setRole(OCIO::ROLE_DEFAULT, "Raw");
  config->validate();
  return config;
}

}  // namespace

OCIO::ConstConfigRcPtr builtin_config() {
  static const OCIO::ConstConfigRcPtr config = make_config();
  return config;
}

}  // namespace skylapse::output::imageio
