#pragma once
// The disc cut into packets of light along the pixel grid.
#include "sky/sun_disc.h"
#include "sky/sun_disc_splat.h"

namespace skylapse::sky {

/// Sums over packets.
struct PacketSums {
  glm::dvec3 flux{0};
  glm::dvec3 horizontal{0};  // flux times sine of the elevation
  double weight = 0;
};

/// How finely the disc is cut, and how far its packets are spread.
struct LatticePlan {
  image::CellGrid grid;
  double tent = 1;
  double pixel_extent_rad = 0;  // the larger side of a pixel
  double cell_extent_rad = 0;   // the larger side of a cell
};
LatticePlan plan_lattice(const image::Camera& camera, const SunDisc& disc);

/// What the lattice found: all of the disc above the horizon, and the part inside the picture.
struct LatticeSums {
  PacketSums whole;
  PacketSums seen;
  bool complete = true;  // false: `whole` lacks something that lies outside the picture
};

/// Lays the packets of the part of the disc on this chart onto `plane`.
void splat_chart(const image::Chart& chart, const SunDisc& disc, const LatticePlan& plan,
                 SplatPlane& plane, LatticeSums& sums);

}  // namespace skylapse::sky
