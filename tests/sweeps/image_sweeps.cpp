// Cameras: which direction a place of the image sees, and back.
#include <fmt/format.h>

#include <array>

#include "image/camera/camera.h"
#include "sweeps/sweep.h"

namespace skylapse::sweeps {
namespace {

using namespace skylapse::image;

/// Any projection, orientation and size, one pixel and the longest strip included.
Camera draw_camera(Draw& draw, Projection projection) {
  Camera camera;
  camera.projection = projection;
  constexpr std::array kSides{1, 2, 7, 512, 4096, 32768};
  const int side = kSides[size_t(draw.below(int(kSides.size())))];
  camera.width = side;
  camera.height = kSides[size_t(draw.below(int(kSides.size())))];
  camera.camera_to_enu =
      look_at(draw.in(0, 360) * deg, draw.in(-90, 90) * deg, draw.in(-180, 180) * deg);
  switch (projection) {
    case Projection::perspective:
      camera.field_of_view = draw.in(0.01, 179) * deg;
      break;
    case Projection::fisheye_stereographic:
      camera.field_of_view = draw.in(1, 350) * deg;
      break;
    case Projection::lat_long:
    case Projection::cube: {
      camera.camera_to_enu = look_at(draw.in(0, 360) * deg, 0 * deg, 0 * deg);
      camera.cube_layout = CubeLayout(draw.below(3));
      const int across = camera.cube_layout == CubeLayout::horizontal_strip ? 6
                         : camera.cube_layout == CubeLayout::cross          ? 4
                                                                            : 1;
      const int down = camera.cube_layout == CubeLayout::vertical_strip ? 6
                       : camera.cube_layout == CubeLayout::cross        ? 3
                                                                        : 1;
      if (projection == Projection::lat_long) break;
      camera.width = side * across;
      camera.height = side * down;
      break;
    }
    default:
      camera.field_of_view = draw.in(1, 360) * deg;
  }
  return camera;
}

std::string text_of(const Camera& camera, PixelPosition p) {
  return fmt::format("{}x{} fov {:.17g} layout {} at {:.17g} {:.17g}", camera.width, camera.height,
                     camera.field_of_view.in(deg), int(camera.cube_layout), p.x, p.y);
}

/// What the image shows at a place is found again there: as an angle, since a direction at a seam
/// or a pole has several places.
void there_and_back(Projection projection, Draw& draw, Tally& tally) {
  const Camera camera = draw_camera(draw, projection);
  const PixelPosition p{draw.in(0, camera.width), draw.in(0, camera.height)};
  const auto where = [&] { return text_of(camera, p); };
  const auto seen = direction_at(camera, p);
  if (!seen) return;  // outside the circle, or the blank part of a cross
  if (!tally.finite(seen->x() + seen->y() + seen->z(), where)) return;
  const auto again = position_of(camera, *seen);
  // A direction on the very edge may count as outside after its rounding.
  const bool at_edge =
      p.x < 1e-6 || p.y < 1e-6 || p.x > camera.width - 1e-6 || p.y > camera.height - 1e-6;
  const bool fisheye = projection == Projection::fisheye_equidistant ||
                       projection == Projection::fisheye_equisolid ||
                       projection == Projection::fisheye_stereographic;
  tally.law(again.has_value() || at_edge || fisheye, where);
  if (!again) return;
  tally.law(std::isfinite(again->x) && std::isfinite(again->y), where);
  tally.law(again->x >= -1e-9 * camera.width && again->x <= camera.width * (1 + 1e-9) &&
                again->y >= -1e-9 * camera.height && again->y <= camera.height * (1 + 1e-9),
            where);
  const auto back = direction_at(camera, {std::clamp(again->x, 0.0, double(camera.width)),
                                          std::clamp(again->y, 0.0, double(camera.height))});
  if (back) tally.error(separation(*seen, *back).in(rad), where);
}

void any_direction(Projection projection, Draw& draw, Tally& tally) {
  const Camera camera = draw_camera(draw, projection);
  const auto d = enu_direction(draw.in(0, 360) * deg, draw.in(-90, 90) * deg);
  const auto where = [&] {
    return text_of(camera, {azimuth(d).in(deg), elevation(d).in(deg)}) + " (a direction)";
  };
  const auto p = position_of(camera, d);
  const bool all_round = projection == Projection::lat_long || projection == Projection::cube;
  tally.law(p.has_value() || !all_round, where);
  if (!p) return;
  if (!tally.finite(p->x + p->y, where)) return;
  const auto back = direction_at(camera, {std::clamp(p->x, 0.0, double(camera.width)),
                                          std::clamp(p->y, 0.0, double(camera.height))});
  if (back) tally.error(separation(d, *back).in(rad), where);
}

std::pair<double, const char*> bound_of(Projection projection) {
  switch (projection) {
    case Projection::perspective:
      return {1e-9,
              "32768 rows high at 179 deg across one column: 16384 in double is 4e-10 rad there"};
    case Projection::fisheye_equisolid:
      return {1e-4, "a radius within 1e-9 of the rim is on it: 2 sqrt(2e-9) rad of a whole sphere"};
    case Projection::fisheye_equidistant:
    case Projection::fisheye_stereographic:
      return {1e-8, "a radius within 1e-9 of the rim is on it"};
    default:
      return {1e-12, "a place in double of up to 2e5 pixels"};
  }
}

void add_cameras(std::vector<Sweep>& sweeps) {
  const std::array<std::pair<Projection, const char*>, 6> kAll{
      {{Projection::perspective, "perspective"},
       {Projection::fisheye_equidistant, "equidistant"},
       {Projection::fisheye_equisolid, "equisolid"},
       {Projection::fisheye_stereographic, "stereographic"},
       {Projection::lat_long, "lat_long"},
       {Projection::cube, "cube"}}};
  for (const auto& [projection, name] : kAll) {
    const auto [bound, reason] = bound_of(projection);
    sweeps.push_back({std::string("camera: ") + name + " pixel to direction", "rad, there and back",
                      bound, reason, 1, [projection](Draw& draw, Tally& tally) {
                        there_and_back(projection, draw, tally);
                      }});
    sweeps.push_back({std::string("camera: ") + name + " direction to pixel", "rad, there and back",
                      bound, reason, 1, [projection](Draw& draw, Tally& tally) {
                        any_direction(projection, draw, tally);
                      }});
  }
  sweeps.push_back({"camera: pixel_solid_angle", "none", 0,
                    "laws alone; a fisheye pixel counts whole: 4 / pi of a sphere", 0.05,
                    [](Draw& draw, Tally& tally) {
                      const Camera camera = draw_camera(draw, Projection(draw.below(6)));
                      const int x = draw.below(camera.width), y = draw.below(camera.height);
                      const auto where = [&] {
                        return fmt::format("projection {} {}", int(camera.projection),
                                           text_of(camera, {double(x), double(y)}));
                      };
                      const double value = pixel_solid_angle(camera, x, y).in(sr);
                      if (tally.finite(value, where))
                        tally.law(value >= 0 && value <= 16 * (1 + 1e-5), where);
                    }});
  sweeps.push_back(
      {"camera: horizon_coverage", "none", 0, "laws alone", 1, [](Draw& draw, Tally& tally) {
         const double e = draw.in(-90, 90), size = draw.in(0, 12), horizon = draw.in(-90, 0);
         const auto where = [&] {
           return fmt::format("elevation {:.17g} pixel {:.17g} sr horizon {:.17g}", e, size,
                              horizon);
         };
         const double value = horizon_coverage(e * deg, size * sr, horizon * deg);
         if (!tally.finite(value, where)) return;
         tally.law(value >= 0 && value <= 1, where);
         tally.law(
             horizon_coverage(std::min(90.0, e + 0.01) * deg, size * sr, horizon * deg) >= value,
             where);
       }});
}

}  // namespace

void add_image_sweeps(std::vector<Sweep>& sweeps) { add_cameras(sweeps); }

}  // namespace skylapse::sweeps
