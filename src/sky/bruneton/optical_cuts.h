#pragma once
// Where a march begins anew: the air ahead is hidden by the air behind, or a layer begins or ends.
#include <vector>

#include "sky/bruneton/columns.h"

namespace skylapse::sky::bruneton {

/// Ascending distances in (0, length) at which the ray from h towards mu passes its lowest point,
/// corners of the density of what scatters, or set optical depths (mean extinction of the bands) if
/// it is much thicker than those; at most MAX_CUTS.
std::vector<double> march_cuts(const Columns& columns, double h, double mu, double length);

}  // namespace skylapse::sky::bruneton
