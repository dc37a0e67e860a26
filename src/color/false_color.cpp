#include "color/false_color.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace skylapse::color {

glm::dvec3 inferno(double t) {
  static constexpr std::array<glm::dvec3, 9> kNodes{{{0, 0, 4},
                                                     {31, 12, 72},
                                                     {85, 15, 109},
                                                     {136, 34, 106},
                                                     {186, 54, 85},
                                                     {227, 89, 51},
                                                     {249, 140, 10},
                                                     {249, 201, 50},
                                                     {252, 255, 164}}};
  const double place = (t > 0 ? std::min(t, 1.0) : 0.0) * (kNodes.size() - 1);
  const size_t k = std::min(size_t(place), kNodes.size() - 2);
  return glm::mix(kNodes[k], kNodes[k + 1], place - double(k));
}

}  // namespace skylapse::color
