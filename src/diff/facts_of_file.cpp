#include "diff/facts_of_file.h"

#include <algorithm>
#include <cmath>

#include "diff/camera_of_file.h"
#include "diff/told_values.h"

namespace skylapse::diff {
namespace {

std::optional<Direction<Enu>> sun_of(const ToldValues& told) {
  const auto azimuth = told.number("skylapse:sunAzimuth", "/frame/sun/azimuth_deg");
  const auto elevation = told.number("skylapse:sunElevation", "/frame/sun/elevation_deg");
  if (!azimuth || !elevation || std::abs(*elevation) > 90) return std::nullopt;
  return enu_direction(*azimuth * deg, *elevation * deg);
}

/// The space whose chromaticities these are, to their rounding in a file.
std::string space_of(const std::vector<double>& chromaticities) {
  using enum color::RgbSpace;
  for (const color::RgbSpace space : {rec709, rec2020, acescg, aces2065_1}) {
    const auto xy = color::exr_chromaticities(space);
    const bool same = std::ranges::equal(
        chromaticities, xy, [](double a, float b) { return std::abs(a - double(b)) < 1e-5; });
    if (same) return std::string(color::rgb_space_name(space));
  }
  return {};
}

void add_colour(const ToldValues& told, PictureFacts& facts) {
  facts.display = told.text("skylapse:display", "/output/display");
  facts.display_view = told.text("skylapse:view", "/output/view");
  if (!facts.display.empty() || !facts.display_view.empty()) return;
  facts.chromaticities = told.numbers("chromaticities", "/color/chromaticities");
  if (facts.chromaticities.size() != 8) facts.chromaticities.clear();
  facts.color_space = told.text("skylapse:colorSpace", "/color/space");
  if (facts.color_space.empty()) facts.color_space = space_of(facts.chromaticities);
  facts.white_luminance = told.number("whiteLuminance");
  if (facts.white_luminance) return;
  facts.white_luminance = told.number("", "/color/white_luminance_cd_m2");
  const auto scale = told.number("", "/file/encoding/scale");
  if (facts.white_luminance && scale && *scale > 0) *facts.white_luminance /= *scale;
}

void add_place_and_time(const ToldValues& told, PictureFacts& facts) {
  facts.file.utc = told.text("skylapse:utc", "/frame/utc");
  facts.site = told.text("skylapse:site", "/site/name");
  facts.latitude_deg = told.number("latitude", "/site/latitude_deg");
  facts.longitude_deg = told.number("longitude", "/site/longitude_deg");
  facts.height_m = told.number("altitude", "/site/height_m");
}

void add_view(const ToldValues& told, const output::ReadImage& part, PictureFacts& facts) {
  facts.projection = projection_of_file(told);
  facts.orientation = told.text("skylapse:orientation", "/output/orientation");
  facts.heading_deg = told.number("skylapse:heading");
  facts.view.camera = camera_of_file(told, part.width, part.height);
  facts.view.sun = sun_of(told);
  const auto radius = told.number("skylapse:sunRadius", "/frame/sun/radius_deg");
  facts.sun_radius_told = radius && *radius > 0 && *radius < 90;
  if (facts.sun_radius_told) facts.view.sun_radius = *radius * deg;
}

}  // namespace

PictureFacts facts_of_file(const output::ReadImage& part, const nlohmann::json* manifest_entry) {
  const ToldValues told(part.attributes, manifest_entry);
  PictureFacts facts;
  facts.file.format = part.format;
  facts.file.width = part.width;
  facts.file.height = part.height;
  facts.file.model = told.text("skylapse:model", "/frame/model");
  facts.file.renderer = told.text("skylapse:renderer", "/renderer");
  facts.parts = part.parts;
  facts.program = told.text("Software");
  facts.content = told.text("skylapse:content", "/content");
  facts.exposure_ev100 = told.number("skylapse:exposureEv100", "/frame/exposure/ev100");
  add_place_and_time(told, facts);
  add_colour(told, facts);
  add_view(told, part, facts);
  return facts;
}

}  // namespace skylapse::diff
