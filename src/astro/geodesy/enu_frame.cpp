#include "astro/geodesy/enu_frame.h"

#include <GeographicLib/Geocentric.hpp>
#include <cassert>
#include <vector>

namespace skylapse::astro {

EnuFrame enu_frame(const GeodeticPosition& position) {
  const double latitude = position.latitude.in(deg);
  assert(std::abs(latitude) <= 90);
  EnuFrame frame;
  std::vector<double> m(9);  // row-major; its columns are east, north, up
  GeographicLib::Geocentric::WGS84().Forward(latitude, position.longitude.in(deg),
                                             position.height.in(metre), frame.origin_m.x,
                                             frame.origin_m.y, frame.origin_m.z, m);
  frame.east = {m[0], m[3], m[6]};
  frame.north = {m[1], m[4], m[7]};
  frame.up = {m[2], m[5], m[8]};
  return frame;
}

}  // namespace skylapse::astro
