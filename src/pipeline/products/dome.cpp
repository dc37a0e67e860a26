#include "pipeline/products/dome.h"

#include <fmt/format.h>

#include <algorithm>

#include "output/sun_policy.h"
#include "pipeline/output_view.h"
#include "pipeline/products/sun_light.h"
#include "pipeline/products/usda.h"

namespace skylapse::pipeline {
namespace {

struct Map {
  const config::ImageOutput* output;
  size_t index;
  image::Camera camera;
};

Result<Map> map_of(const ProductRequest& request) {
  const auto& wanted = request.output.map_path;
  const auto& outputs = request.plan.job.outputs;
  const auto refused = [&](const std::string& message, const std::string& hint) {
    return Error{ErrorCode::invalid_input, message, wanted.span, hint};
  };
  for (size_t i = 0; i < outputs.size(); ++i) {
    const auto* const image = std::get_if<config::ImageOutput>(&outputs[i]);
    if (image == nullptr || image->path.value != wanted.value) continue;
    const image::Camera camera = view_of_output(request.plan, request.frame, *image).camera.camera;
    if (camera.projection != image::Projection::lat_long)
      return refused("the map of a dome is a lat-long map", "projection: lat-long");
    if (image->display || image->view)
      return refused("the map of a dome is scene-linear", "leave out `view` and `display`");
    return Map{image, i, camera};
  }
  return refused("no image output has the path \"" + wanted.value + "\"",
                 "the path of a lat-long image output, as it is written there");
}

/// Whether the sun policy changes what the file holds.
bool has_policy(const config::ImageOutput& map) {
  return map.sample_type == output::SampleType::half_float || map.format == "hdr";
}

/// By what the file's values were multiplied: found from the brightest sample, in strips, as the
/// map itself may be larger than memory.
Result<double> scale_of(const ProductRequest& request, const Map& map, StageTimes& times) {
  if (!has_policy(*map.output) || map.output->sun_policy != output::SunPolicy::scale) return 1.0;
  const Disc disc = leaves_disc_out(*map.output) ? Disc::without : Disc::with;
  constexpr int kRows = 64;
  image::FrameBuffer brightest(1, 1);
  float& largest = brightest.pixel(0, 0)[0];
  for (int row = 0; row < map.camera.height; row += kRows) {
    image::FrameBuffer strip(map.camera.width, std::min(kRows, map.camera.height - row));
    const Status filled = request.light.fill_rows(map.camera, disc, row, strip, times);
    if (!filled) return filled.error();
    for (const float v : strip.data()) largest = std::max(largest, v);
  }
  const auto record = output::apply_sun_policy(brightest, output::SunPolicy::scale);
  if (!record) return record.error();
  return record->scale;
}

/// The dome's own axes, those of OpenEXR (Y up, Z in the middle of the map, X to the left of it),
/// in the stage's.
glm::dmat3 dome_axes(const ProductRequest& request, const Map& map) {
  const glm::dvec3 z = map.camera.camera_to_enu[2], y = map.camera.camera_to_enu[1];
  return image::enu_to_world(request.output.orientation) * glm::dmat3{glm::cross(y, z), y, z};
}

std::string dome_usda(const ProductRequest& request, const Map& map, double scale) {
  const std::string file = plan::files_of(request.plan, request.frame, map.index).front();
  return fmt::format(
      "    def DomeLight \"Dome\"\n    {{\n"
      "        color3f inputs:color = (1, 1, 1)\n"
      "        float inputs:exposure = 0\n"
      "        float inputs:intensity = {:.9g}\n"
      "        asset inputs:texture:file = {} (\n"
      "            colorSpace = \"{}\"\n        )\n"
      "        token inputs:texture:format = \"latlong\"\n"
      "{}    }}\n",
      1 / scale, usda_asset(file, request.files.front()), usda_color_space(request),
      usda_transform(dome_axes(request, map), "        "));
}

}  // namespace

bool leaves_disc_out(const config::ImageOutput& map) {
  return map.content == config::ImageContent::sky ||
         (has_policy(map) && map.sun_policy == output::SunPolicy::split);
}

Result<std::vector<ProductFile>> make_dome(const ProductRequest& request, StageTimes& times) {
  const auto map = map_of(request);
  if (!map) return map.error();
  auto text = usda_head(request);
  if (!text) return text.error();
  const auto scale = scale_of(request, *map, times);
  if (!scale) return scale.error();
  *text += "def Xform \"Sky\"\n{\n" + dome_usda(request, *map, *scale);
  if (leaves_disc_out(*map->output))
    *text += "\n" + distant_light_usda(request, sun_light_of(request.light), "    ");
  return std::vector<ProductFile>{text_product(*text + "}\n")};
}

}  // namespace skylapse::pipeline
