#pragma once
// Where a march begins anew because the air ahead is hidden by the air behind.
#include <vector>

#include "sky/bruneton/columns.h"

namespace skylapse::sky::bruneton {

/// Ascending distances in (0, length) at which the ray from h towards mu passes its lowest point,
/// or set optical depths (mean extinction of the bands) if it is much thicker than those.
std::vector<double> march_cuts(const Columns& columns, double h, double mu, double length);

}  // namespace skylapse::sky::bruneton
