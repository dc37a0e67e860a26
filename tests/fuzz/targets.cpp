#include "fuzz/targets.h"

#include <array>

namespace skylapse::fuzz {

std::span<const Target> targets() {
  static constexpr std::array<Target, 9> kTargets{{{"job", job},
                                                   {"atmosphere", atmosphere},
                                                   {"yaml", yaml},
                                                   {"quantity", quantity},
                                                   {"time_expression", time_expression},
                                                   {"batch_csv", batch_csv},
                                                   {"image", image},
                                                   {"manifest", manifest},
                                                   {"golden", golden}}};
  return kTargets;
}

}  // namespace skylapse::fuzz
