#include <fmt/format.h>

#include <cstdint>
#include <map>

#include "config/build_job.h"
#include "config/words.h"
#include "image/camera/camera_check.h"

namespace skylapse::config {
namespace {

using image::Projection;

constexpr int64_t kMostPixels = int64_t{1} << 30;

bool is_fisheye(Projection p) {
  return p == Projection::fisheye_equidistant || p == Projection::fisheye_equisolid ||
         p == Projection::fisheye_stereographic;
}
bool is_whole_sphere(Projection p) { return p == Projection::lat_long || p == Projection::cube; }

struct View {
  Angle azimuth, elevation, roll;
};

/// All-sky cameras by custom have north at the top; for images of the whole sphere it is in the
/// middle.
View default_view(Projection projection) {
  if (is_fisheye(projection)) return {180 * deg, 90 * deg, 0 * deg};
  return {0 * deg, 0 * deg, 0 * deg};
}

View view_of_word(const std::string& word) {
  if (word == "zenith") return {180 * deg, 90 * deg, 0 * deg};
  if (word == "nadir") return {0 * deg, -90 * deg, 0 * deg};
  return {*value_of(kCompassWords, word) * deg, 0 * deg, 0 * deg};
}

View read_view(const Section& camera, Projection projection, const ReadContext& context) {
  const auto refuse_tilt = [&](const Place& place) {
    context.errors.add(place, "images of the whole sphere stand upright",
                       "their look_at takes the azimuth of the image centre alone");
  };
  if (const auto word = camera.get<std::string>("look_at")) {
    const View view = view_of_word(*word);
    if (is_whole_sphere(projection) && view.elevation != 0 * deg)
      refuse_tilt(camera.place_of("look_at"));
    return view;
  }
  const auto section = only_section(camera, "look_at");
  if (!section) {
    if (projection == Projection::perspective && !camera.has("look_at"))
      context.errors.add(camera.place, fmt::format("{} is missing", camera.path_of("look_at")),
                         "add \"look_at: {azimuth: 270 deg, elevation: 15 deg}\"");
    return default_view(projection);
  }
  if (is_whole_sphere(projection))
    for (const std::string_view key : {"elevation", "roll"})
      if (section->get<double>(key).value_or(0) != 0) refuse_tilt(section->place_of(key));
  return {section->get<double>("azimuth").value_or(0) * rad,
          section->get<double>("elevation").value_or(0) * rad,
          section->get<double>("roll").value_or(0) * rad};
}

void read_field_of_view(const Section& section, image::Camera& camera, const ReadContext& context) {
  camera.field_of_view = is_fisheye(camera.projection) ? 180 * deg : 90 * deg;
  const auto fov = section.get<double>("fov");
  if (!fov) return;
  if (is_whole_sphere(camera.projection)) {
    context.errors.add(section.field("fov")->key_place,
                       fmt::format("{} has no meaning here", section.path_of("fov")),
                       "images of the whole sphere have no field of view");
    return;
  }
  camera.field_of_view = *fov * rad;
  const bool perspective = camera.projection == Projection::perspective;
  const bool open_end = perspective || camera.projection == Projection::fisheye_stereographic;
  const Angle limit = perspective ? 180 * deg : 360 * deg;
  if (open_end && camera.field_of_view >= limit)
    context.errors.add(section.place_of("fov"),
                       fmt::format("{} = {:g} deg is too wide for this projection",
                                   section.path_of("fov"), camera.field_of_view.in(deg)),
                       fmt::format("allowed: less than {:g} deg{}", limit.in(deg),
                                   perspective ? "; fisheyes see more" : ""));
}

PixelSize default_size(Projection projection) {
  if (projection == Projection::perspective) return {1920, 1080};
  if (projection == Projection::lat_long) return {2048, 1024};
  if (projection == Projection::cube) return {512, 0};
  return {1024, 1024};
}

/// Columns and rows in faces of a cube.
std::pair<int, int> faces_across(image::CubeLayout layout) {
  switch (layout) {
    case image::CubeLayout::horizontal_strip:
      return {6, 1};
    case image::CubeLayout::vertical_strip:
      return {1, 6};
    case image::CubeLayout::cross:
      return {4, 3};
  }
  return {1, 1};
}

void read_size(const Section& section, image::Camera& camera, const ReadContext& context) {
  const auto written = section.get<PixelSize>("size");
  const PixelSize size = written.value_or(default_size(camera.projection));
  const Place place = section.place_of("size");
  const auto refuse = [&](std::string message, std::string hint) {
    context.errors.add(place, fmt::format("{}: {}", section.path_of("size"), message), hint);
  };
  int64_t width = size.width, height = size.height;
  if (camera.projection == Projection::cube) {
    if (size.height != 0 && size.height != size.width)
      refuse("the faces of a cube are squares",
             fmt::format("give the side of a face, such as {}", size.width));
    const auto [across, down] = faces_across(camera.cube_layout);
    height = width * down;
    width *= across;
    const int most = image::kMaxImageSide / std::max(across, down);
    if (size.width > most) {
      refuse(fmt::format("a cube of {} pixel faces is {}x{} in all", size.width, width, height),
             fmt::format("allowed: faces of at most {} pixels in this layout", most));
      return;
    }
  } else if (size.height == 0) {
    refuse("the height is missing", fmt::format("such as {}x{}", size.width, size.width));
    return;
  }
  if (width * height > kMostPixels) {
    refuse(fmt::format("{}x{} is more than {} pixels", width, height, kMostPixels),
           "allowed: 2^30 pixels in all");
    return;
  }
  camera.width = int(width);
  camera.height = int(height);
}

void read_layout(const Section& section, CameraConfig& config, const ReadContext& context) {
  const auto word = section.get<std::string>("layout");
  if (!word) return;
  if (config.camera.projection != Projection::cube) {
    context.errors.add(section.field("layout")->key_place,
                       fmt::format("{} has no meaning here", section.path_of("layout")),
                       "it belongs to \"projection: cube\"");
    return;
  }
  const LayoutChoice choice = *value_of(kLayoutWords, *word);
  config.camera.cube_layout = choice.layout;
  config.cube_faces_apart = choice.faces_apart;
}

CameraConfig build_camera(const Section& section, const std::string& default_name,
                          const ReadContext& context) {
  CameraConfig config;
  config.name = section.get<std::string>("name").value_or(default_name);
  config.span = context.sources.span(section.place);
  if (section.has("name") && !names_a_file(config.name))
    context.errors.add(
        section.place_of("name"),
        fmt::format("{} = {} holds no letter or digit", section.path_of("name"), config.name),
        "names become part of file names");
  const auto projection = section.get<std::string>("projection");
  if (section.has("projection") && !projection) return config;  // the rest depends on it
  if (projection) config.camera.projection = *value_of(kProjectionWords, *projection);
  const size_t errors_before = context.errors.count();
  const View view = read_view(section, config.camera.projection, context);
  config.camera.camera_to_enu = image::look_at(view.azimuth, view.elevation, view.roll);
  read_field_of_view(section, config.camera, context);
  read_layout(section, config, context);
  read_size(section, config.camera, context);
  const bool complete = context.errors.count() == errors_before && config.camera.width > 0;
  if (!complete) return config;
  if (const auto problem = image::camera_problem(config.camera))
    context.errors.add(section.place, *problem);
  return config;
}

}  // namespace

std::vector<CameraConfig> build_cameras(const Section& root, const ReadContext& context) {
  std::vector<std::shared_ptr<const Section>> sections = root.sections("camera");
  const bool single = !sections.empty();
  if (!single) sections = root.sections("cameras");
  std::vector<CameraConfig> cameras;
  std::map<std::string, int> lines;
  for (size_t i = 0; i < sections.size(); ++i) {
    const std::string name = single ? "camera" : fmt::format("camera{}", i + 1);
    cameras.push_back(build_camera(*sections[i], name, context));
    const auto [first, is_new] = lines.emplace(cameras.back().name, cameras.back().span.line);
    if (!is_new)
      context.errors.add(
          sections[i]->has("name") ? sections[i]->place_of("name") : sections[i]->place,
          fmt::format("two cameras are named {}", first->first),
          fmt::format("the first is on line {}; names must differ", first->second));
  }
  return cameras;
}

}  // namespace skylapse::config
