// Which cells of a chart a small disc on the sphere can touch.
#include <algorithm>
#include <limits>

#include "image/camera/chart.h"
#include "image/camera/fisheye.h"
#include "image/camera/lat_long.h"
#include "image/camera/perspective.h"

namespace skylapse::image {
namespace {

constexpr double kPi = std::numbers::pi;

struct Interval {
  double begin, end;
  [[nodiscard]] bool empty() const { return !(begin < end); }
};

Interval intersection(Interval a, Interval b) {
  return {std::max(a.begin, b.begin), std::min(a.end, b.end)};
}

/// Adds the cells of `row` whose centres lie in the interval of pixel columns.
void add_span(Footprint& f, int64_t row, Interval columns_px, int columns_per_pixel) {
  const auto begin = static_cast<int64_t>(std::floor(columns_px.begin * columns_per_pixel));
  const auto end = static_cast<int64_t>(std::ceil(columns_px.end * columns_per_pixel));
  if (begin < end) f.spans.push_back({row, begin, end});
}

Interval rows_of(Interval rows_px, int rows_per_pixel) {
  return {std::floor(rows_px.begin * rows_per_pixel), std::ceil(rows_px.end * rows_per_pixel)};
}

// ---- the plane: perspective and cube face

/// The range of u / w over the part with w > 0 of a cone about (u, w, v): the planes that contain
/// the v axis and touch the cone make the angle asin(sin radius / |(u, w)|) with its axis.
Interval tangent_range(double u, double w, Angle radius) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const double length = std::hypot(u, w), s = sin(radius);
  if (length <= s) return {-kInf, kInf};
  const double middle = std::atan2(u, w), half = std::asin(s / length);
  const Interval angles = intersection({middle - half, middle + half}, {-kPi / 2, kPi / 2});
  if (angles.empty()) return {0, 0};
  return {angles.begin > -kPi / 2 ? std::tan(angles.begin) : -kInf,
          angles.end < kPi / 2 ? std::tan(angles.end) : kInf};
}

struct PlaneView {
  glm::dvec3 centre;  // of the disc, along the plane's x (right), y (down) and axis
  double focal_px;
  double middle_x, middle_y;
  Interval x_limit, y_limit;  // where cells are wanted
  Interval x_picture, y_picture;
};

Footprint plane_footprint(const PlaneView& view, Angle radius, CellGrid grid) {
  const auto to_pixels = [&](Interval t, double middle) {
    return Interval{middle + view.focal_px * t.begin, middle + view.focal_px * t.end};
  };
  const Interval x = to_pixels(tangent_range(view.centre.x, view.centre.z, radius), view.middle_x);
  const Interval y = to_pixels(tangent_range(view.centre.y, view.centre.z, radius), view.middle_y);
  Footprint f;
  if (intersection(x, view.x_picture).empty() || intersection(y, view.y_picture).empty()) return f;
  const Interval xl = intersection(x, view.x_limit), yl = intersection(y, view.y_limit);
  f.complete = xl.begin == x.begin && xl.end == x.end && yl.begin == y.begin && yl.end == y.end;
  const Interval rows = rows_of(yl, grid.rows);
  for (auto row = static_cast<int64_t>(rows.begin); row < static_cast<int64_t>(rows.end); ++row)
    add_span(f, row, xl, grid.columns);
  return f;
}

// Room around a perspective picture for a disc that its frame cuts. A larger disc is incomplete.
constexpr double kMarginPx = 128;

Footprint perspective_footprint(const Camera& camera, const Direction<CameraFrame>& c, Angle radius,
                                CellGrid grid) {
  const double w = camera.width, h = camera.height;
  return plane_footprint({{c.x(), -c.y(), c.z()},
                          perspective_focal_length_px(camera),
                          0.5 * w,
                          0.5 * h,
                          {-kMarginPx, w + kMarginPx},
                          {-kMarginPx, h + kMarginPx},
                          {0, w},
                          {0, h}},
                         radius, grid);
}

Footprint cube_footprint(const Chart& chart, const Direction<CameraFrame>& c, Angle radius,
                         CellGrid grid) {
  const int n = cube_face_size(chart.camera);
  const auto [x, y] = cube_face_origin(chart.camera, *chart.face);
  const auto axes = cube_face_axes(chart.camera.cube_layout, *chart.face);
  const Interval columns{double(x), double(x + n)}, rows{double(y), double(y + n)};
  auto f = plane_footprint({{glm::dot(c.vec(), axes.right), -glm::dot(c.vec(), axes.up),
                             glm::dot(c.vec(), axes.forward)},
                            0.5 * n,
                            x + 0.5 * n,
                            y + 0.5 * n,
                            columns,
                            rows,
                            columns,
                            rows},
                           radius, grid);
  f.complete = true;  // what this face does not show, its neighbours do
  return f;
}

// ---- lat-long

Footprint lat_long_footprint(const Camera& camera, const Direction<CameraFrame>& c, Angle radius,
                             CellGrid grid) {
  const double row_rad = kPi / camera.height / grid.rows;
  const double column_rad = 2 * kPi / camera.width / grid.columns;
  const double zenith = std::atan2(std::hypot(c.x(), c.z()), c.y());
  const double longitude = std::atan2(c.x(), c.z());
  const double r = radius.in(rad);
  const auto last_row = static_cast<int64_t>(camera.height) * grid.rows;
  const auto turn = static_cast<int64_t>(camera.width) * grid.columns;
  const auto first = std::max<int64_t>(0, static_cast<int64_t>(std::floor((zenith - r) / row_rad)));
  Footprint f;
  for (int64_t row = first; row < last_row && (double(row) + 0.5) * row_rad < zenith + r; ++row) {
    const double theta = (double(row) + 0.5) * row_rad;
    // Haversine formula, solved for the difference in longitude.
    const double hr = std::sin(0.5 * r), ht = std::sin(0.5 * (theta - zenith));
    const double numerator = (hr - ht) * (hr + ht);
    const double denominator = std::sin(theta) * std::sin(zenith);
    if (numerator <= 0) continue;
    if (numerator >= denominator) {
      f.spans.push_back({row, 0, turn});
      continue;
    }
    const double half = 2 * std::asin(std::sqrt(numerator / denominator));
    const double middle = (longitude + kPi) / column_rad;
    const auto begin = static_cast<int64_t>(std::floor(middle - half / column_rad));
    const auto end = static_cast<int64_t>(std::ceil(middle + half / column_rad));
    f.spans.push_back({row, begin, std::min(end, begin + turn)});
  }
  return f;
}

// ---- fisheye

/// Bounds of a sector of a ring about the origin, in units of the image circle.
struct Sector {
  double r0, r1;
  double phi, half_phi;  // half_phi >= pi: the whole ring
  [[nodiscard]] bool has(double angle) const {
    return std::abs(std::remainder(angle - phi, 2 * kPi)) <= half_phi;
  }
  /// Range of r cos(angle - axis).
  [[nodiscard]] Interval along(double axis) const {
    const double a = std::cos(phi - half_phi - axis), b = std::cos(phi + half_phi - axis);
    double low = std::min(a, b), high = std::max(a, b);
    if (half_phi >= kPi || has(axis)) high = 1;
    if (half_phi >= kPi || has(axis + kPi)) low = -1;
    return {low < 0 ? low * r1 : low * r0, high > 0 ? high * r1 : high * r0};
  }
};

Footprint fisheye_footprint(const Camera& camera, const Direction<CameraFrame>& c, Angle radius,
                            CellGrid grid) {
  constexpr double kFarthest = 2;  // radii of the image circle
  const auto [cx, cy, circle_px] = fisheye_circle(camera);
  const double theta = separation(c, fisheye_axis(camera)).in(rad), rho = radius.in(rad);
  Footprint f;
  Sector s{fisheye_r(camera, std::max(0.0, theta - rho) * rad),
           fisheye_r(camera, std::min(kPi, theta + rho) * rad), std::atan2(-c.y(), c.x()), kPi};
  if (s.r0 > 1) return f;
  if (s.r1 > kFarthest) {
    s.r1 = kFarthest;
    f.complete = false;
  }
  if (rho < std::min(theta, kPi - theta)) s.half_phi = std::asin(std::sin(rho) / std::sin(theta));
  const Interval x = s.along(0), y = s.along(kPi / 2);
  const double cell = 1 / (circle_px * grid.columns);
  const Interval rows =
      rows_of({cy + circle_px * (y.begin - cell), cy + circle_px * (y.end + cell)}, grid.rows);
  for (auto row = static_cast<int64_t>(rows.begin); row < static_cast<int64_t>(rows.end); ++row) {
    const double v = ((double(row) + 0.5) / grid.rows - cy) / circle_px;
    const double outer = std::sqrt(std::max(0.0, s.r1 * s.r1 - v * v)) + cell;
    const double inner = std::sqrt(std::max(0.0, s.r0 * s.r0 - v * v)) - 2 * cell;
    // Named captures: C++20 as Clang reads it lets lambdas take structured bindings by value only.
    const auto add = [&, circle_px = circle_px, cx = cx](Interval u) {
      u = intersection(u, {x.begin - cell, x.end + cell});
      if (!u.empty())
        add_span(f, row, {cx + circle_px * u.begin, cx + circle_px * u.end}, grid.columns);
    };
    if (inner > 2 * cell) {  // else both pieces could hold the same cell
      add({-outer, -inner});
      add({inner, outer});
    } else {
      add({-outer, outer});
    }
  }
  return f;
}

// ---- octahedral

/// Rectangle of cells.
struct CellBlock {
  int64_t x0, x1, y0, y1;
};

/// Cells of a block that lie on the chart's octant.
void add_block(Footprint& f, const Chart& chart, CellBlock b, CellGrid grid) {
  for (int64_t row = b.y0; row < b.y1; ++row) {
    CellSpan span{row, b.x1, b.x1};
    for (int64_t i = b.x0; i < b.x1; ++i) {
      const PixelPosition p{(double(i) + 0.5) / grid.columns, (double(row) + 0.5) / grid.rows};
      if (octant_at(chart.camera, p) != chart.octant) continue;
      span.begin = std::min(span.begin, i);
      span.end = i + 1;
    }
    // Of a row an octant holds what is contiguous.
    if (span.begin < b.x1) f.spans.push_back(span);
  }
}

Footprint octahedral_footprint(const Chart& chart, const Direction<CameraFrame>& c, Angle radius,
                               CellGrid grid) {
  constexpr int64_t kSmallest = 4;  // cells: a block that is not halved any more
  const Camera& camera = chart.camera;
  const int64_t columns = int64_t{camera.width} * grid.columns;
  const int64_t rows = int64_t{camera.height} * grid.rows;
  const auto near = [&](const CellBlock& b) {
    const PixelPosition middle{0.5 * double(b.x0 + b.x1) / grid.columns,
                               0.5 * double(b.y0 + b.y1) / grid.rows};
    const double half_diagonal =
        std::hypot(double(b.x1 - b.x0) / double(columns), double(b.y1 - b.y0) / double(rows));
    return separation(octahedral_ray(camera, middle), c).in(rad) <
           radius.in(rad) + kOctahedralStretch * half_diagonal;
  };
  // The octant's quarter of the picture; the cells that its edge halves count to both.
  const auto half = [](int sign, int64_t count) {
    return sign > 0 ? Interval{double(count / 2), double(count)}
                    : Interval{0, double((count + 1) / 2)};
  };
  const Interval x = half(chart.octant->u, columns), y = half(chart.octant->v, rows);
  std::vector<CellBlock> blocks{
      {int64_t(x.begin), int64_t(x.end), int64_t(y.begin), int64_t(y.end)}};
  Footprint f;
  while (!blocks.empty()) {
    const CellBlock b = blocks.back();
    blocks.pop_back();
    if (b.x0 >= b.x1 || b.y0 >= b.y1 || !near(b)) continue;
    const int64_t w = b.x1 - b.x0, h = b.y1 - b.y0;
    if (std::max(w, h) <= kSmallest) {
      add_block(f, chart, b, grid);
    } else if (w >= h) {
      blocks.push_back({b.x0, b.x0 + w / 2, b.y0, b.y1});
      blocks.push_back({b.x0 + w / 2, b.x1, b.y0, b.y1});
    } else {
      blocks.push_back({b.x0, b.x1, b.y0, b.y0 + h / 2});
      blocks.push_back({b.x0, b.x1, b.y0 + h / 2, b.y1});
    }
  }
  return f;
}

}  // namespace

Footprint footprint(const Chart& chart, const Direction<CameraFrame>& centre, Angle radius,
                    CellGrid grid) {
  switch (chart.camera.projection) {
    case Projection::perspective:
      return perspective_footprint(chart.camera, centre, radius, grid);
    case Projection::cube:
      return cube_footprint(chart, centre, radius, grid);
    case Projection::lat_long:
      return lat_long_footprint(chart.camera, centre, radius, grid);
    case Projection::octahedral:
      return octahedral_footprint(chart, centre, radius, grid);
    case Projection::mirror_ball:
    case Projection::fisheye_equidistant:
    case Projection::fisheye_equisolid:
    case Projection::fisheye_stereographic:
      break;
  }
  return fisheye_footprint(chart.camera, centre, radius, grid);
}

}  // namespace skylapse::image
