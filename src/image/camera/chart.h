#pragma once
// Charts: the smooth pieces a picture is made of, for those who spread something small over it.
// A chart is a plane of pixels with one formula from position to direction that goes on beyond the
// picture's edge. A cube has six, an octahedral map eight, every other projection one.
#include <vector>

#include "image/camera/cube.h"
#include "image/camera/octahedral.h"

namespace skylapse::image {

struct Chart {
  Camera camera;
  std::optional<CubeFace> face = {};  // of a cube
  std::optional<Octant> octant = {};  // of an octahedral map
};
std::vector<Chart> charts(const Camera& camera);

struct ChartSample {
  Direction<CameraFrame> direction;
  double sr_per_pixel;  // solid angle per area at this very point, the pixel's area being 1
};
/// Direction at a position of the chart's plane, in pixels of the image; nothing where the
/// formula has left the sphere.
std::optional<ChartSample> chart_sample(const Chart& chart, PixelPosition position);

/// Share of a small cell around a sample that lies on the picture and on this chart: 0 or 1 at
/// straight edges, which cells are taken not to straddle; at a fisheye's circle
/// clamp((fov / 2 - theta) / side + 1/2) with side = sqrt(cell), as horizon_coverage, so that the
/// rim of an all-sky image and the horizon are the same edge.
double share_in_picture(const Chart& chart, PixelPosition position, const ChartSample& sample,
                        SolidAngle cell);

/// Whether the pixel (x, y) is filled by this chart: direction_at answers at its centre. Columns
/// of a lat-long map repeat, its rows go on over the poles, and the faces of cubes and octahedra go
/// on in others, so there every pixel is.
bool fills_pixel(const Chart& chart, int x, int y);

/// Angles that a pixel spans in x and y where a disc of the given radius is centred (the nearest
/// place in the picture if that is outside), and its solid angle. Where they change within the
/// disc, x and y are the largest; in a fisheye both are the larger of the radial and the
/// tangential angle, in an octahedral map both are the larger.
struct PixelExtent {
  Angle x, y;
  SolidAngle area;
};
PixelExtent pixel_extent(const Camera& camera, const Direction<CameraFrame>& centre, Angle radius);

/// Each pixel cut into columns x rows equal cells.
struct CellGrid {
  int columns = 1;
  int rows = 1;
};

/// Cells [begin, end) of one row of cells, counted from the image's upper left corner; they may
/// lie outside the picture (perspective, fisheye) or be repeated columns (lat-long).
struct CellSpan {
  int64_t row, begin, end;
};

struct Footprint {
  std::vector<CellSpan> spans;
  bool complete = true;  // no part of the disc falls where this chart could go but the spans do not
};

/// The cells whose centre may lie within `radius` of `centre`: all of those and few others.
Footprint footprint(const Chart& chart, const Direction<CameraFrame>& centre, Angle radius,
                    CellGrid grid);

}  // namespace skylapse::image
