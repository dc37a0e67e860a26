#include "sky/hosek_wilkie/sky_image.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/parallel.h"
#include "image/camera/octahedral.h"
#include "sky/facet.h"
#include "sky/hosek_wilkie/frame_table.h"
#include "sky/hosek_wilkie/sky_kernel.h"

namespace skylapse::sky::hosek_wilkie {
namespace {

using kernel::BlockCoordinates;
using kernel::kBlock;

/// Below this sine of elevation a pixel's coordinates are taken in double: the root of cos theta
/// magnifies the rounding of float there.
constexpr double kExactSine = 1e-3;

/// What all rows of one call share.
struct Scene {
  const image::Camera& camera;
  glm::dvec3 sun;
  glm::vec3 ground;
  AlignedFloats rows;  // facets only
};

void fill(float* rgb, int count, const glm::vec3& colour) {
  kernel::fill_pixels(count, {colour.x, colour.y, colour.z}, rgb);
}

/// Coordinate q of sky_kernel.h in double.
double sun_coordinate(const glm::dvec3& view, const glm::dvec3& sun) {
  const bool near = glm::dot(view, sun) >= 0;
  const glm::dvec3 chord = near ? view - sun : view + sun;
  const double length = std::sqrt(0.5 * glm::dot(chord, chord));
  return near ? length : 2 - length;
}

/// A pixel at or near the horizon: exact place, mixed with the ground by its coverage.
glm::vec3 horizon_pixel(const Scene& scene, const Facet& facet, int column, int row) {
  const glm::dvec3 view = facet.direction(facet.x_of(column), facet.y_of(row));
  const glm::vec3 sky = look_up_one(scene.rows, sun_coordinate(view, scene.sun),
                                    std::sqrt(std::clamp(view.z, 0.0, 1.0)));
  if (view.z >= 0.5 * facet.largest_pixel_side()) return sky;
  const Angle elevation = std::asin(std::clamp(view.z, -1.0, 1.0)) * rad;
  const float share = static_cast<float>(
      image::horizon_coverage(elevation, image::pixel_solid_angle(scene.camera, column, row)));
  return share * sky + (1 - share) * scene.ground;
}

int octahedral_coordinates(const kernel::RowView& view, int count, BlockCoordinates& out) {
  std::array<kernel::Vec3f, kBlock> directions;
  for (int i = 0; i < count; ++i) {
    const glm::vec3 d(
        image::octahedral_direction(double(view.x_first) + double(i) * view.x_step, -view.y));
    directions[size_t(i)] = {d.x, d.y, d.z};
  }
  return kernel::direction_coordinates(view, directions.data(), count, out);
}

int coordinates(const Facet& facet, const kernel::RowView& view, int count, BlockCoordinates& out) {
  const float k = static_cast<float>(facet.lens_factor);
  switch (facet.lens) {
    case Facet::Lens::plane:
      return kernel::plane_coordinates(view, count, out);
    case Facet::Lens::equidistant:
      return kernel::equidistant_coordinates(view, k, count, out);
    case Facet::Lens::equisolid:
      return kernel::equisolid_coordinates(view, k, count, out);
    case Facet::Lens::stereographic:
      return kernel::stereographic_coordinates(view, k, count, out);
    case Facet::Lens::octahedral:
      return octahedral_coordinates(view, count, out);
  }
  return 0;
}

/// True if a block of a plane is below `sine` (negative) at both ends and therefore all along: the
/// unscaled height of its directions is linear in x, and their length at most that at one end.
bool plane_block_below(const Facet& facet, double sine, int column, int count, double y) {
  if (facet.lens != Facet::Lens::plane) return false;
  const glm::dvec3 zenith(facet.axes[0].z, facet.axes[1].z, facet.axes[2].z);
  const glm::dvec3 first(facet.x_of(column), y, 1), last(facet.x_of(column + count - 1), y, 1);
  const double longest = std::max(glm::length(first), glm::length(last));
  return std::max(glm::dot(zenith, first), glm::dot(zenith, last)) < sine * longest;
}

void render_block(const Scene& scene, const Facet& facet, kernel::RowView view, int column,
                  int count, int row, float* rgb) {
  // Narrower than this about the horizon: mixed with the ground. The rest of float's error is
  // far below 1e-6.
  const double straddle = 0.5 * facet.largest_pixel_side() + 1e-6;
  if (plane_block_below(facet, -straddle, column, count, facet.y_of(row)))
    return fill(rgb, count, scene.ground);
  view.x_first = static_cast<float>(facet.x_of(column));
  view.low_sine = static_cast<float>(std::max(straddle, kExactSine));
  BlockCoordinates at;
  const int low = coordinates(facet, view, count, at);
  if (low == count && std::all_of(at.sine, at.sine + count, [&](float s) { return s < -straddle; }))
    return fill(rgb, count, scene.ground);
  kernel::look_up(scene.rows.data(), at, count, rgb);
  if (low == 0) return;
  for (int i = 0; i < count; ++i) {
    if (at.sine[i] >= view.low_sine) continue;
    const glm::vec3 colour =
        at.sine[i] < -straddle ? scene.ground : horizon_pixel(scene, facet, column + i, row);
    std::copy_n(&colour.x, 3, rgb + 3 * i);
  }
}

kernel::Vec3f in_axes(const glm::dmat3& axes, const glm::dvec3& enu) {
  const glm::vec3 v(enu * axes);
  return {v.x, v.y, v.z};
}

/// Fills one facet's part of an image row; returns the pixels it has written.
PixelSpan render_facet_row(const Scene& scene, const Facet& facet, int row, float* rgb) {
  kernel::RowView view{};
  view.x_step = static_cast<float>(1 / facet.unit_px);
  view.y = static_cast<float>(facet.y_of(row));
  view.sun = in_axes(facet.axes, scene.sun);
  view.zenith = in_axes(facet.axes, {0, 0, 1});
  const PixelSpan span = facet.visible(row);
  for (int column = span.begin; column < span.end; column += kBlock)
    render_block(scene, facet, view, column, std::min(kBlock, span.end - column), row,
                 rgb + size_t{3} * column);
  return span;
}

void render_facets(const Scene& scene, int first_row, image::FrameBuffer& out) {
  const std::vector<Facet> facets = facets_of(scene.camera);
  const size_t grain = std::max(1, 32768 / out.width());
  parallel_for_ranges(size_t(out.height()), grain, [&](size_t begin, size_t end) {
    for (size_t y = begin; y < end; ++y) {
      const int row = first_row + static_cast<int>(y);
      float* rgb = out.row(static_cast<int>(y));
      int done = 0;  // pixels; what no facet shows is black
      for (const Facet& facet : facets) {
        if (row < facet.y0 || row >= facet.y0 + facet.height) continue;
        const PixelSpan span = render_facet_row(scene, facet, row, rgb);
        fill(rgb + size_t{3} * done, span.begin - done, glm::vec3(0));
        done = span.end;
      }
      fill(rgb + size_t{3} * done, out.width() - done, glm::vec3(0));
    }
  });
}

/// 2 sin^2 and 2 cos^2 of half the azimuth between each column and the sun.
struct ColumnAngles {
  std::vector<float> near, far;
};

ColumnAngles column_angles(const image::Camera& camera, const glm::dvec3& sun) {
  const glm::dvec3 in_camera = sun * camera.camera_to_enu;
  const double sun_longitude = std::atan2(in_camera.x, in_camera.z);
  ColumnAngles angles{std::vector<float>(camera.width), std::vector<float>(camera.width)};
  for (int i = 0; i < camera.width; ++i) {
    const double longitude = ((i + 0.5) / camera.width - 0.5) * 2 * std::numbers::pi;
    const double s = std::sin(0.5 * (longitude - sun_longitude));
    angles.near[i] = static_cast<float>(2 * s * s);
    angles.far[i] = static_cast<float>(2 * (1 - s) * (1 + s));
  }
  return angles;
}

void render_level_row(const FrameTable& table, const Scene& scene, const ColumnAngles& columns,
                      int row, float* rgb) {
  const image::Camera& camera = scene.camera;
  const int width = camera.width;
  const double theta = (row + 0.5) / camera.height * std::numbers::pi;
  const Angle elevation = (0.5 * std::numbers::pi - theta) * rad;
  const double share = image::horizon_coverage(elevation, image::pixel_solid_angle(camera, 0, row));
  if (share == 0) return fill(rgb, width, scene.ground);

  // 1 - cos gamma = 2 sin^2((theta - theta_s)/2) + sin theta sin theta_s 2 sin^2(dphi/2), and the
  // like for 1 + cos gamma: sums of positive terms, so nothing cancels at either end.
  const double theta_s = std::atan2(std::hypot(scene.sun.x, scene.sun.y), scene.sun.z);
  const double s = std::sin(0.5 * (theta - theta_s)), c = std::cos(0.5 * (theta + theta_s));
  alignas(64) float polynomials[kernel::kRowFloats];
  table.make_row(std::sqrt(std::max(0.0, std::cos(theta))), polynomials);
  const kernel::LevelRow level{.near_base = static_cast<float>(2 * s * s),
                               .far_base = static_cast<float>(2 * c * c),
                               .slope = static_cast<float>(std::sin(theta) * std::sin(theta_s)),
                               .near = columns.near.data(),
                               .far = columns.far.data()};
  kernel::RowCoordinates place;
  for (int first = 0; first < width; first += kBlock) {
    const int count = std::min(kBlock, width - first);
    kernel::level_coordinates(level, first, count, place);
    kernel::look_up_row(polynomials, place, count, rgb + size_t{3} * first);
  }
  if (share == 1) return;
  for (int i = 0; i < width; ++i)
    for (int channel = 0; channel < 3; ++channel)
      rgb[3 * i + channel] = static_cast<float>(share) * rgb[3 * i + channel] +
                             static_cast<float>(1 - share) * scene.ground[channel];
}

void render_lat_long(const FrameTable& table, const Scene& scene, int first_row,
                     image::FrameBuffer& out) {
  const ColumnAngles columns = column_angles(scene.camera, scene.sun);
  const size_t grain = std::max(1, 32768 / out.width());
  parallel_for_ranges(size_t(out.height()), grain, [&](size_t begin, size_t end) {
    for (size_t y = begin; y < end; ++y)
      render_level_row(table, scene, columns, first_row + static_cast<int>(y),
                       out.row(static_cast<int>(y)));
  });
}

}  // namespace

void render_sky_rows(const image::Camera& camera, const ImageInputs& inputs, int first_row,
                     image::FrameBuffer& out) {
  assert(inputs.sky != nullptr && out.width() == camera.width);
  assert(first_row >= 0 && first_row + out.height() <= camera.height);
  const FrameTable table(*inputs.sky, inputs.scale * inputs.xyz_to_rgb);
  Scene scene{camera, inputs.sun.vec(), glm::vec3(inputs.ground_rgb), {}};
  if (camera.projection == image::Projection::lat_long)
    return render_lat_long(table, scene, first_row, out);
  scene.rows = table.make_rows();
  render_facets(scene, first_row, out);
}

void render_sky(const image::Camera& camera, const ImageInputs& inputs, image::FrameBuffer& out) {
  assert(out.height() == camera.height);
  render_sky_rows(camera, inputs, 0, out);
}

}  // namespace skylapse::sky::hosek_wilkie
