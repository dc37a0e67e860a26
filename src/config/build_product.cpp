#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "config/output_section.h"
#include "config/words.h"
#include "image/orientation.h"

namespace skylapse::config {
namespace {

using image::Orientation;
using output::SampleType;

constexpr int kDefaultSpecularSize = 256, kDefaultIrradianceSize = 64;
constexpr int kSmallestLevel = 4;  // pixels a face: below it a level is hardly a cube
/// Larger ones would be an integral over a sphere of samples for each of 10^7 pixels.
constexpr int kMostProductPixels = 2048;

OutputItem::Endings endings_of(ProductKind kind) {
  switch (kind) {
    case ProductKind::specular:
    case ProductKind::irradiance:
      return {{"ktx2", "ktx2"}, {"exr", "exr"}, {"hdr", "hdr"}};
    case ProductKind::harmonics:
      return {{"json", "json"}};
    case ProductKind::sun:
      return {{"json", "json"}, {"usda", "usda"}};
    case ProductKind::dome:
      return {{"usda", "usda"}};
  }
  return {};
}

/// Numbers of a map or cube: .hdr has but one kind. A map of irradiance is small, and the night is
/// darker than half numbers reach (6e-8 times 683 cd/m^2).
void read_type(const OutputItem& item, ProductOutput& out) {
  const bool small_map = out.kind == ProductKind::irradiance && out.format == "exr";
  out.sample_type = out.format == "hdr" || small_map ? SampleType::float32 : SampleType::half_float;
  const auto word = item.section.get<std::string>("type");
  if (!word) return;
  const SampleType type = *value_of(kSampleTypeWords, *word);
  if (out.format == "hdr" && type != SampleType::float32)
    item.context.errors.add(
        item.section.place_of("type"),
        fmt::format("{} = {} cannot be stored in hdr", item.section.path_of("type"), *word),
        "allowed: float");
  else
    out.sample_type = type;
}

/// The side of a product is bounded: what it shows is smooth.
bool size_is_bounded(const OutputItem& item, const CameraConfig& view) {
  if (view.camera.width <= kMostProductPixels) return true;
  item.context.errors.add(item.section.place_of("size"),
                          fmt::format("{}: {} pixels are more than the light has detail",
                                      item.section.path_of("size"), view.camera.width),
                          fmt::format("allowed: at most {}", kMostProductPixels));
  return false;
}

void read_levels(const OutputItem& item, ProductOutput& out) {
  const int side = out.view->camera.width;
  if (!std::has_single_bit(unsigned(side))) {
    item.context.errors.add(
        item.section.place_of("size"),
        fmt::format("{} = {} is no power of 2", item.section.path_of("size"), side),
        fmt::format("such as {}", std::bit_floor(unsigned(side))));
    return;
  }
  const int most = int(std::bit_width(unsigned(side)));  // down to one pixel
  const long written = item.section.get<long>("levels").value_or(0);
  out.levels = written > 0 ? int(written)
                           : std::max(1, most - int(std::bit_width(unsigned(kSmallestLevel))) + 1);
  if (out.levels > most)
    item.context.errors.add(item.section.place_of("levels"),
                            fmt::format("{} = {}: faces of {} pixels have fewer levels",
                                        item.section.path_of("levels"), written, side),
                            fmt::format("allowed: at most {}", most));
}

void read_specular(const OutputItem& item, ProductOutput& out) {
  out.view =
      build_product_view(item.section, image::Projection::cube, kDefaultSpecularSize, item.context);
  if (out.view->camera.width == 0 || !size_is_bounded(item, *out.view)) return;
  read_levels(item, out);
  if (out.format == "ktx2") {
    item.refuse_tokens({"level", "face"}, "has no meaning here",
                       "a ktx2 file holds all faces and levels");
    return;
  }
  if (!item.has_token("level"))
    item.refuse_path("all levels would be written to one file",
                     "add the token {level} to the name, or write ktx2");
  out.view->cube_faces_apart = item.has_token("face");
}

void read_irradiance(const OutputItem& item, ProductOutput& out) {
  const auto word = item.section.get<std::string>("projection");
  const bool by_name = out.format == "ktx2" || item.has_token("face");
  const bool cube = word ? *word == "cube" : by_name;
  if (!cube && by_name)
    item.context.errors.add(
        item.section.place_of("projection"),
        fmt::format("{} = {}, but {}", item.section.path_of("projection"), *word,
                    out.format == "ktx2" ? "ktx2 holds cubes" : "{face} belongs to cubes"),
        "allowed: cube");
  out.view =
      build_product_view(item.section, cube ? image::Projection::cube : image::Projection::lat_long,
                         kDefaultIrradianceSize, item.context);
  if (out.view->camera.width == 0 || !size_is_bounded(item, *out.view)) return;
  out.view->cube_faces_apart = item.has_token("face");
  item.refuse_tokens({"level"}, "has no meaning here", "it belongs to specular outputs");
  if (out.format == "ktx2")
    item.refuse_tokens({"face"}, "has no meaning here", "a ktx2 file holds six faces");
}

}  // namespace

std::optional<ProductOutput> build_product(const OutputItem& item, ProductKind kind) {
  if (item.path.empty() || !item.allowed_place()) return std::nullopt;
  const auto format = item.format_of(endings_of(kind), item.path_key);
  if (!format) return std::nullopt;
  ProductOutput out;
  out.kind = kind;
  out.path = item.spanned_path();
  out.format = *format;
  if (out.format == "usda") out.orientation = Orientation::usd;
  if (const auto word = item.section.get<std::string>("orientation"))
    out.orientation = *value_of(kOrientationWords, *word);
  if (out.format == "usda" && glm::determinant(image::enu_to_world(out.orientation)) < 0)
    item.context.errors.add(
        item.section.place_of("orientation"),
        fmt::format("{} is left-handed, and USD stages are not", image::name_of(out.orientation)),
        "allowed in usda: usd, openexr, blender, three, gltf, mitsuba");
  const bool has_pixels = kind == ProductKind::specular || kind == ProductKind::irradiance;
  if (has_pixels && out.orientation == Orientation::pbrt)
    item.no_meaning("orientation", "pbrt reads square octahedral maps alone");
  if (has_pixels) read_type(item, out);
  if (has_pixels || kind == ProductKind::harmonics)
    out.sun_disc = item.section.get<bool>("sun_disc").value_or(true);
  if (kind == ProductKind::specular) read_specular(item, out);
  if (kind == ProductKind::irradiance) read_irradiance(item, out);
  if (!has_pixels)
    item.refuse_tokens({"face", "level", "size"}, "has no meaning here", "this file has no pixels");
  item.check_names_of_frames();
  return out;
}

}  // namespace skylapse::config
