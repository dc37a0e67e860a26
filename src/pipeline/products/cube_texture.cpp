#include "pipeline/products/cube_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "color/rgb_space.h"
#include "core/constants.h"
#include "image/irradiance.h"
#include "image/lighting/cube_mips.h"
#include "output/ktx2.h"
#include "output/stored_numbers.h"
#include "output/sun_policy.h"

namespace skylapse::pipeline {
namespace {

std::string text_of(const output::Attribute& attribute) {
  const auto text = [](const auto& value) -> std::string {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, std::string>)
      return value;
    else if constexpr (std::is_same_v<Value, std::vector<float>>)
      return fmt::format("{}", fmt::join(value, " "));
    else
      return fmt::format("{}", value);
  };
  return std::visit(text, attribute.value);
}

/// Where the axes of the vector that samplers are given point, in words. KTX is left-handed: the
/// camera's left, up, and what is behind it.
std::string axes_of(const image::Camera& camera) {
  const auto place = [&](const glm::dvec3& axis) {
    const auto d = image::to_enu(camera, Direction<CameraFrame>::from_vector(axis));
    return fmt::format("{:.6g}", azimuth(d).in(deg));
  };
  return fmt::format("+X azimuth {} deg, +Y up, +Z azimuth {} deg", place({-1, 0, 0}),
                     place({0, 0, -1}));
}

/// Faces of a vertical strip in another order.
image::FrameBuffer reordered(const image::FrameBuffer& strip,
                             const std::array<image::CubeFace, 6>& faces) {
  const int side = strip.width();
  image::FrameBuffer out(side, strip.height());
  const size_t face_samples = size_t{3} * size_t(side) * size_t(side);
  for (size_t i = 0; i < faces.size(); ++i)
    std::copy_n(strip.row(int(faces[i]) * side), face_samples, out.row(int(i) * side));
  return out;
}

}  // namespace

Result<ProductFile> cube_texture_of(std::span<const image::FrameBuffer> levels,
                                    const image::Camera& camera, output::SampleType type,
                                    const output::FrameMetadata& meta,
                                    std::optional<image::Orientation> orientation, Notes notes,
                                    StageTimes& times) {
  const StageTimer timer(times, Stage::encode);
  for (const output::Attribute& attribute : output::frame_attributes(meta))
    if (attribute.name != "textureformat" && attribute.name != "Software")
      notes.emplace_back(attribute.name, text_of(attribute));
  notes.emplace_back("skylapse:axes", axes_of(camera));
  if (orientation && meta.orientation.empty())
    notes.emplace_back("skylapse:orientation", image::name_of(*orientation));
  auto bytes = output::ktx2_file({.levels = levels,
                                  .faces = image::faces_in(image::CubeOrder::opengl),
                                  .type = type,
                                  .space = meta.space,
                                  .notes = std::move(notes)});
  if (!bytes) return bytes.error();
  image::FrameBuffer stored = levels.front();
  round_as_stored("ktx2", type, stored);
  const glm::dvec3 rgb =
      image::image_irradiance(image::strip_camera(camera, stored.width()), stored);
  const double lux = kLuminousEfficacy * (color::rgb_to_xyz(meta.space) * rgb).y;
  const double scale = meta.sun_policy ? meta.sun_policy->scale : 1;
  return ProductFile{*std::move(bytes), {{"horizontal_lux", lux / scale}}};
}

Result<ProductFile> make_cube_texture(const image::FrameBuffer& strip, const image::Camera& camera,
                                      output::SampleType type, const output::FrameMetadata& meta,
                                      std::optional<image::Orientation> orientation,
                                      StageTimes& times) {
  std::vector<image::FrameBuffer> levels;
  {
    const StageTimer timer(times, Stage::product);
    levels = image::box_mips(strip, image::level_count(strip.width(), 1));
  }
  return cube_texture_of(levels, camera, type, meta, orientation, {}, times);
}

image::Camera product_camera(const config::ProductOutput& output) {
  image::Camera camera = output.view->camera;
  const Angle own = azimuth(image::to_enu(camera, Direction<CameraFrame>()));
  camera.camera_to_enu =
      image::look_at(own + image::map_heading(camera.projection, output.orientation), {}, {});
  return camera;
}

void round_as_stored(const std::string& format, output::SampleType type,
                     image::FrameBuffer& image) {
  if (format == "hdr")
    output::round_to_rgbe(image.data());
  else if (type == output::SampleType::half_float)
    output::round_to_half(image.data());
}

output::SampleType stored_type(const ProductRequest& request, const image::FrameBuffer& picture) {
  constexpr double kMostLost = 5e-4;  // a tenth of what products promise
  const output::SampleType asked = request.output.sample_type;
  if (asked != output::SampleType::half_float) return asked;
  glm::dvec3 exact{0}, stored{0};
  for (size_t i = 0; i < picture.data().size(); ++i) {
    exact[int(i % 3)] += picture.data()[i];
    stored[int(i % 3)] += output::rounded_to_half(picture.data()[i]);
  }
  // Of the light as a whole: a channel that hardly counts may be dark by day too.
  const double lost = std::abs((exact.x + exact.y + exact.z) - (stored.x + stored.y + stored.z));
  return lost > kMostLost * (exact.x + exact.y + exact.z) ? output::SampleType::float32 : asked;
}

double horizontal_lux(const FrameLight& light, const glm::dvec3& horizontal_rgb) {
  return kLuminousEfficacy * (glm::inverse(light.xyz_to_rgb) * horizontal_rgb).y;
}

double true_horizontal_lux(const ProductRequest& request) {
  const FrameLight& light = request.light;
  const bool disc = request.output.sun_disc && light.disc_shows;
  return kLuminousEfficacy *
         (light.sky.sky_irradiance_xyz.y + (disc ? light.disc_energy.horizontal_irradiance.y : 0));
}

std::vector<image::PointLight> disc_lights(const ProductRequest& request) {
  if (!request.output.sun_disc || !request.light.disc_shows) return {};
  return sky::disc_points(request.light.disc);
}

Result<std::vector<ProductFile>> picture_files(const ProductRequest& request,
                                               const image::FrameBuffer& picture,
                                               output::SampleType type, const Notes& notes,
                                               StageTimes& times) {
  const StageTimer timer(times, Stage::encode);
  const config::CameraConfig& view = *request.output.view;
  const bool cube = view.camera.projection == image::Projection::cube;
  const auto& convention = image::convention_of(request.output.orientation);
  const image::FrameBuffer ordered =
      cube ? reordered(picture, image::faces_in(convention.cube_order)) : picture;
  const int parts = cube && view.cube_faces_apart ? 6 : 1;
  output::FrameMetadata meta = request.meta;
  if (!cube)
    meta.environment = output::EnvironmentMap::lat_long;
  else if (parts == 1 && convention.cube_order == image::CubeOrder::openexr)
    meta.environment = output::EnvironmentMap::cube;
  output::EncodeRequest encode;
  encode.format = request.output.format;
  encode.width = ordered.width();
  encode.height = ordered.height() / parts;
  encode.type = type;
  encode.attributes = output::frame_attributes(meta);
  encode.attributes.push_back({"skylapse:orientation", std::string(convention.name)});
  for (const auto& [name, value] : notes) encode.attributes.push_back({name, value});
  std::vector<ProductFile> files;
  for (int part = 0; part < parts; ++part) {
    encode.pixels = ordered.row(part * encode.height);
    auto bytes = request.io.encode(encode);
    if (!bytes) return bytes.error();
    files.push_back({*std::move(bytes), {}});
  }
  return files;
}

}  // namespace skylapse::pipeline
