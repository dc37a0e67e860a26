#pragma once
// Scenes drawn from the whole domain by a seeded generator: the same on every machine.
#include <cstdint>
#include <string>

namespace skylapse::effects_proof {

/// How scenes are rendered; scenes themselves do not depend on it.
struct Fineness {
  std::string level = "draft";
  std::string more = "wavelengths: 4, precision: double";  // further keys of the sky
  int largest_side = 40;                                   // of pictures, pixels
};

/// A config with "@" where the word of sky.effects belongs. Places with the poles, heights from 0
/// to 36,000 km, suns from +90 to -18 degrees, all projections, fields of view from a part of the
/// sun to the sphere, clear, thick, thin and no air, ozone from 0 to 500 DU, albedo 0 to 1, every
/// kind of exposure. Scene `number` of seed 1 is always the same.
std::string drawn_scene(uint64_t seed, int number, const Fineness& fineness);

}  // namespace skylapse::effects_proof
