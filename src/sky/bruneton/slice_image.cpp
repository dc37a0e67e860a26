#include "sky/bruneton/slice_image.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/parallel.h"
#include "image/camera/octahedral.h"
#include "sky/bruneton/slice_table.h"
#include "sky/facet.h"

namespace skylapse::sky::bruneton {
namespace {

using kernel::BlockCoordinates;
using kernel::kBlock;

constexpr double kPi = std::numbers::pi;

/// What all rows of one call share.
struct Scene {
  const image::Camera& camera;
  const SliceTable& table;
  glm::dvec3 along, across;  // level axes: towards the sun, and at right angles
};

/// Elevations of a pixel near the horizon, split there; `share` is that of the sky.
struct Split {
  double share = 1;
  RowWeights sky, ground;
};

/// Rows for a pixel whose centre is `over` the horizon and whose side is `side` [rad].
Split split_of(const SliceTable& table, double over, double side) {
  if (!(std::abs(over) < kMeanPixels * side)) {
    Split split{over < 0 ? 0.0 : 1.0, {}, {}};
    (over < 0 ? split.ground : split.sky) = table.rows_at(over);
    return split;
  }
  const double low = over - 0.5 * side, high = over + 0.5 * side;
  Split split{image::horizon_coverage(over * rad, side * side * sr), {}, {}};
  if (split.share > 0) split.sky = table.mean_rows(std::max(0.0, low), high);
  if (split.share < 1) split.ground = table.mean_rows(low, std::min(0.0, high));
  return split;
}

double phase_at(const kernel::Shape& shape, double nu) {
  const double x = shape.phase_a - shape.phase_b * nu;
  return (1 + nu * nu) / (x * std::sqrt(x));
}

glm::dvec3 radiance_of(const std::array<double, kernel::kNodeFloats>& node, double phase) {
  return glm::max(
      glm::dvec3(node[0], node[1], node[2]) + phase * glm::dvec3(node[4], node[5], node[6]), 0.0);
}

/// A pixel near the horizon: its place in double, sky and ground mixed.
glm::vec3 horizon_pixel(const Scene& scene, const Facet& facet, int column, int row) {
  const glm::dvec3 view = facet.direction(facet.x_of(column), facet.y_of(row));
  const kernel::Shape& shape = scene.table.shape();
  const double along = glm::dot(view, scene.along), across = glm::dot(view, scene.across);
  const double level = std::hypot(along, across);
  const double over = std::atan2(view.z * shape.horizon_sine - level * shape.horizon_cosine,
                                 view.z * shape.horizon_cosine + level * shape.horizon_sine);
  const double side = std::sqrt(image::pixel_solid_angle(scene.camera, column, row).in(sr));
  const auto place = scene.table.column_at(std::atan2(std::abs(across), along));
  const double phase = phase_at(shape, along * shape.sun_sine + view.z * shape.sun_cosine);
  const Split split = split_of(scene.table, over, side);
  const glm::dvec3 sky = radiance_of(scene.table.blend(split.sky, place), phase);
  const glm::dvec3 ground = radiance_of(scene.table.blend(split.ground, place), phase);
  return glm::vec3(split.share * sky + (1 - split.share) * ground);
}

int octahedral_coordinates(const kernel::Shape& shape, const kernel::RowView& view, int count,
                           BlockCoordinates& out) {
  std::array<kernel::Vec3d, kBlock> directions;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 d = image::octahedral_direction(view.x_first + i * view.x_step, -view.y);
    directions[size_t(i)] = {d.x, d.y, d.z};
  }
  return kernel::direction_coordinates(shape, view, directions.data(), count, out);
}

int coordinates(const kernel::Shape& shape, const Facet& facet, const kernel::RowView& view,
                int count, BlockCoordinates& out) {
  switch (facet.lens) {
    case Facet::Lens::plane:
      return kernel::plane_coordinates(shape, view, count, out);
    case Facet::Lens::equisolid:
      return kernel::equisolid_coordinates(shape, view, facet.lens_factor, count, out);
    case Facet::Lens::stereographic:
      return kernel::stereographic_coordinates(shape, view, facet.lens_factor, count, out);
    case Facet::Lens::octahedral:
      return octahedral_coordinates(shape, view, count, out);
    case Facet::Lens::equidistant:
      break;
  }
  return kernel::equidistant_coordinates(shape, view, facet.lens_factor, count, out);
}

void render_block(const Scene& scene, const Facet& facet, kernel::RowView view, int column,
                  int count, int row, float* rgb) {
  view.x_first = facet.x_of(column);
  BlockCoordinates at;
  const int near = coordinates(scene.table.shape(), facet, view, count, at);
  kernel::look_up(scene.table.nodes(), scene.table.grid().azimuths, at, count, rgb);
  if (near == 0) return;
  for (int i = 0; i < count; ++i) {
    if (std::abs(at.over_horizon[i]) >= view.near) continue;
    const glm::vec3 colour = horizon_pixel(scene, facet, column + i, row);
    std::copy_n(&colour.x, 3, rgb + 3 * i);
  }
}

kernel::Vec3d in_axes(const glm::dmat3& axes, const glm::dvec3& enu) {
  const glm::dvec3 v(enu * axes);
  return {v.x, v.y, v.z};
}

/// Fills one facet's part of an image row; returns the pixels it has written.
PixelSpan render_facet_row(const Scene& scene, const Facet& facet, int row, float* rgb) {
  kernel::RowView view{};
  view.x_step = 1 / facet.unit_px;
  view.y = facet.y_of(row);
  view.along = in_axes(facet.axes, scene.along);
  view.across = in_axes(facet.axes, scene.across);
  view.up = in_axes(facet.axes, {0, 0, 1});
  view.near = float(kMeanPixels * facet.largest_pixel_side() * (1 + 1e-5));
  const PixelSpan span = facet.visible(row);
  for (int column = span.begin; column < span.end; column += kBlock)
    render_block(scene, facet, view, column, std::min(kBlock, span.end - column), row,
                 rgb + size_t{3} * column);
  return span;
}

void render_facets(const Scene& scene, int first_row, image::FrameBuffer& out) {
  const std::vector<Facet> facets = facets_of(scene.camera);
  const size_t grain = std::max(1, 8192 / out.width());
  parallel_for_ranges(size_t(out.height()), grain, [&](size_t begin, size_t end) {
    for (size_t y = begin; y < end; ++y) {
      const int row = first_row + int(y);
      float* rgb = out.row(int(y));
      int done = 0;  // pixels; what no facet shows is black
      for (const Facet& facet : facets) {
        if (row < facet.y0 || row >= facet.y0 + facet.height) continue;
        const PixelSpan span = render_facet_row(scene, facet, row, rgb);
        std::fill(rgb + size_t{3} * done, rgb + size_t{3} * span.begin, 0.0f);
        done = span.end;
      }
      std::fill(rgb + size_t{3} * done, rgb + size_t{3} * out.width(), 0.0f);
    }
  });
}

/// Columns of a lat-long map: all rows have the same azimuths.
struct MapColumns {
  std::vector<std::int32_t> offset;
  std::vector<float> fraction;
  std::vector<double> cos_azimuth;
};

MapColumns map_columns(const Scene& scene) {
  const int width = scene.camera.width;
  const glm::dvec3 sun = scene.along * scene.camera.camera_to_enu;
  const double sun_longitude = std::atan2(sun.x, sun.z);
  MapColumns columns;
  for (int i = 0; i < width; ++i) {
    const double turn = ((i + 0.5) / width - 0.5) * 2 * kPi - sun_longitude;
    const auto place = scene.table.column_at(std::abs(std::remainder(turn, 2 * kPi)));
    columns.offset.push_back(place.index * kernel::kNodeFloats);
    columns.fraction.push_back(float(place.fraction));
    columns.cos_azimuth.push_back(std::cos(turn));
  }
  return columns;
}

void render_level_row(const Scene& scene, const MapColumns& columns, int row, float* rgb) {
  const image::Camera& camera = scene.camera;
  const kernel::Shape& shape = scene.table.shape();
  const double zenith = (row + 0.5) / camera.height * kPi;
  const Split split =
      split_of(scene.table, scene.table.grid().horizon_zenith_rad - zenith, kPi / camera.height);
  const kernel::LevelRow level{.offset = columns.offset.data(),
                               .fraction = columns.fraction.data(),
                               .cos_azimuth = columns.cos_azimuth.data(),
                               .nu_base = std::cos(zenith) * shape.sun_cosine,
                               .nu_slope = std::sin(zenith) * shape.sun_sine,
                               .phase_a = shape.phase_a,
                               .phase_b = shape.phase_b};
  std::fill_n(rgb, size_t{3} * camera.width, 0.0f);
  const auto add = [&](const RowWeights& rows, double share) {
    if (share == 0 || rows.weight.empty()) return;
    const std::vector<float> blended = scene.table.blend(rows);
    kernel::add_level_row(blended.data(), level, float(share), 0, camera.width, rgb);
  };
  add(split.sky, split.share);
  add(split.ground, 1 - split.share);
}

void render_map(const Scene& scene, int first_row, image::FrameBuffer& out) {
  const MapColumns columns = map_columns(scene);
  const size_t grain = std::max(1, 8192 / out.width());
  parallel_for_ranges(size_t(out.height()), grain, [&](size_t begin, size_t end) {
    for (size_t y = begin; y < end; ++y)
      render_level_row(scene, columns, first_row + int(y), out.row(int(y)));
  });
}

}  // namespace

glm::dvec3 level_direction(const Direction<Enu>& sun) {
  const double level = std::hypot(sun.x(), sun.y());
  if (level == 0) return {0, 1, 0};
  return {sun.x() / level, sun.y() / level, 0};
}

void render_slice_rows(const image::Camera& camera, const SliceImageInputs& inputs, int first_row,
                       image::FrameBuffer& out) {
  assert(inputs.slice != nullptr && out.width() == camera.width);
  assert(first_row >= 0 && first_row + out.height() <= camera.height);
  const SliceTable table(inputs);
  const glm::dvec3 along = level_direction(inputs.sun);
  const Scene scene{camera, table, along, {along.y, -along.x, 0}};
  if (camera.projection == image::Projection::lat_long)
    render_map(scene, first_row, out);
  else
    render_facets(scene, first_row, out);
}

void render_slice(const image::Camera& camera, const SliceImageInputs& inputs,
                  image::FrameBuffer& out) {
  assert(out.height() == camera.height);
  render_slice_rows(camera, inputs, 0, out);
}

}  // namespace skylapse::sky::bruneton
