#include <fmt/format.h>

#include <algorithm>
#include <array>
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

/// `look_at`; `absent` if it is not written.
View read_view(const Section& camera, Projection projection, const View& absent,
               const ReadContext& context) {
  const auto refuse_tilt = [&](const Place& place) {
    context.errors.add(place, "images of the whole sphere stand upright",
                       "their look_at takes the azimuth of the image centre alone");
  };
  if (const auto word = camera.get<std::string>("look_at")) {
    const View view = view_of_word(*word);
    if (image::stands_upright(projection) && view.elevation != 0 * deg)
      refuse_tilt(camera.place_of("look_at"));
    return view;
  }
  const auto section = only_section(camera, "look_at");
  if (!section) {
    if (projection == Projection::perspective && !camera.has("look_at"))
      context.errors.add(camera.place, fmt::format("{} is missing", camera.path_of("look_at")),
                         "add \"look_at: {azimuth: 270 deg, elevation: 15 deg}\"");
    return absent;
  }
  if (image::stands_upright(projection))
    for (const std::string_view key : {"elevation", "roll"})
      if (section->get<double>(key).value_or(0) != 0) refuse_tilt(section->place_of(key));
  return {section->get<double>("azimuth").value_or(0) * rad,
          section->get<double>("elevation").value_or(0) * rad,
          section->get<double>("roll").value_or(0) * rad};
}

void read_field_of_view(const Section& section, image::Camera& camera, const ReadContext& context) {
  const auto fov = section.get<double>("fov");
  if (!fov) return;
  if (image::sees_whole_sphere(camera.projection)) {
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
    case image::CubeLayout::vertical_cross:
      return {3, 4};
  }
  return {1, 1};
}

/// One number: the side of a square, or the width of a lat-long map.
int height_of(Projection projection, int width) {
  if (projection == Projection::perspective) return 0;
  return projection == Projection::lat_long ? (width + 1) / 2 : width;
}

void read_size(const Section& section, PixelSize absent, image::Camera& camera,
               const ReadContext& context) {
  const PixelSize size = section.get<PixelSize>("size").value_or(absent);
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
    height = height_of(camera.projection, size.width);
    if (height == 0) {
      refuse("the height is missing", fmt::format("such as {}x{}", size.width, size.width));
      return;
    }
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

/// Size, projection and axes belong together.
void check_camera(const Section& section, const CameraConfig& config, size_t errors_before,
                  const ReadContext& context) {
  const bool complete = context.errors.count() == errors_before && config.camera.width > 0;
  if (!complete) return;
  if (const auto problem = image::camera_problem(config.camera))
    context.errors.add(section.place, *problem);
}

glm::dmat3 axes_of(const View& view) {
  return image::look_at(view.azimuth, view.elevation, view.roll);
}

/// A view whose projection is known, with nothing of another one. `absent`: where it looks if no
/// key says so.
void read_fresh_view(const Section& section, const View& absent, CameraConfig& config,
                     const ReadContext& context) {
  image::Camera& camera = config.camera;
  camera.camera_to_enu = axes_of(read_view(section, camera.projection, absent, context));
  camera.field_of_view = is_fisheye(camera.projection) ? 180 * deg : 90 * deg;
  read_field_of_view(section, camera, context);
  read_layout(section, config, context);
  read_size(section, default_size(camera.projection), camera, context);
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
  read_fresh_view(section, default_view(config.camera.projection), config, context);
  check_camera(section, config, errors_before, context);
  return config;
}

/// Where the job's maps and cubes are centred, if they agree.
std::optional<View> common_heading(const std::vector<CameraConfig>& cameras) {
  std::optional<View> common;
  for (const CameraConfig& config : cameras) {
    if (!image::stands_upright(config.camera.projection)) continue;
    const Angle azimuth =
        skylapse::azimuth(Direction<Enu>::from_vector(config.camera.camera_to_enu[2]));
    if (common && common->azimuth != azimuth) return std::nullopt;
    common = View{azimuth, 0 * deg, 0 * deg};
  }
  return common ? common : View{0 * deg, 0 * deg, 0 * deg};
}

/// A map or cube without look_at and orientation is centred as the job's others are.
View view_of_map(const Section& section, const std::vector<CameraConfig>& cameras,
                 const ReadContext& context) {
  const auto heading = common_heading(cameras);
  const bool needs_it = !section.has("look_at") && !section.has("orientation");
  if (!heading && needs_it)
    context.errors.add(section.place_of("projection"),
                       "the job's maps and cubes are centred on different directions",
                       "add look_at or orientation to this output");
  return heading && needs_it ? *heading : default_view(Projection::lat_long);
}

/// The job's camera, with what the output says otherwise.
void change_view(const Section& section, CameraConfig& config, const ReadContext& context) {
  image::Camera& camera = config.camera;
  if (section.has("orientation"))
    camera.camera_to_enu = axes_of(default_view(camera.projection));
  else if (section.has("look_at"))
    camera.camera_to_enu = axes_of(read_view(section, camera.projection, View{}, context));
  read_field_of_view(section, camera, context);
  const auto [across, down] =
      camera.projection == Projection::cube ? faces_across(camera.cube_layout) : std::pair{1, 1};
  const PixelSize size{camera.width / across,
                       camera.projection == Projection::cube ? 0 : camera.height / down};
  read_layout(section, config, context);
  read_size(section, size, camera, context);
}

bool check_orientation(const Section& section, const CameraConfig& config,
                       const ReadContext& context) {
  if (!section.has("orientation")) return true;
  const auto refuse = [&](std::string hint) {
    context.errors.add(section.field("orientation")->key_place,
                       fmt::format("{} has no meaning here", section.path_of("orientation")),
                       std::move(hint));
    return false;
  };
  if (section.has("look_at")) return refuse("look_at says where the centre is");
  const bool square = config.camera.projection == Projection::octahedral;
  const bool pbrt = section.get<std::string>("orientation") == "pbrt";
  if (pbrt != square && image::stands_upright(config.camera.projection))
    return refuse(pbrt ? "pbrt reads square octahedral maps alone" : "octahedral maps are pbrt's");
  if (image::stands_upright(config.camera.projection)) return true;
  return refuse(
      "it belongs to images of the whole sphere that stand upright: lat-long, cube, octahedral");
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

std::optional<CameraConfig> build_own_view(const Section& section,
                                           const std::vector<CameraConfig>& cameras,
                                           const ReadContext& context) {
  constexpr std::array<std::string_view, 6> kKeys{"projection", "size",   "fov",
                                                  "look_at",    "layout", "orientation"};
  const auto first = std::find_if(kKeys.begin(), kKeys.end(),
                                  [&](std::string_view key) { return section.has(key); });
  if (first == kKeys.end() || cameras.empty()) return std::nullopt;
  const auto projection = section.get<std::string>("projection");
  if (section.has("projection") && !projection) return std::nullopt;  // reported
  const size_t errors_before = context.errors.count();
  CameraConfig config = cameras.front();
  if (projection) {
    config = CameraConfig{};
    config.name = "view";
    config.camera.projection = *value_of(kProjectionWords, *projection);
    const View absent = image::stands_upright(config.camera.projection)
                            ? view_of_map(section, cameras, context)
                            : default_view(config.camera.projection);
    read_fresh_view(section, absent, config, context);
  } else if (cameras.size() > 1) {
    context.errors.add(section.field(*first)->key_place,
                       fmt::format("{} does not say of which camera", section.path_of(*first)),
                       "add projection: the job has several cameras");
    return std::nullopt;
  } else {
    change_view(section, config, context);
  }
  config.span = context.sources.span(section.place);
  check_orientation(section, config, context);
  check_camera(section, config, errors_before, context);
  return config;
}

CameraConfig build_product_view(const Section& section, Projection projection, int size,
                                const ReadContext& context) {
  CameraConfig config;
  config.name = "view";
  config.span = context.sources.span(section.place);
  config.camera.projection = projection;
  const size_t errors_before = context.errors.count();
  read_size(section, {size, 0}, config.camera, context);
  check_camera(section, config, errors_before, context);
  return config;
}

}  // namespace skylapse::config
