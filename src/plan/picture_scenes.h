#pragma once
// The pictures of a job before its frames are made: what the choice of a rung looks at.
#include <vector>

#include "plan/accuracy_choice.h"
#include "plan/rung.h"

namespace skylapse::plan {

struct Picture {
  size_t time = 0;  // of the schedule
  int turbidity = 0, albedo = 0, camera = 0;
  PictureScene scene;
};

/// All pictures (of the views of an output of its own too: every one is promised), or evenly spaced
/// ones of more than kPicturesLookedAt.
std::vector<Picture> picture_scenes(const PromiseInputs& inputs);
inline constexpr size_t kPicturesLookedAt = 20'000;

/// Whether air is of a kind that the calibration covers, its amount of haze and ozone apart.
bool is_known_air(const sky::atmosphere::AirDescription& air);

}  // namespace skylapse::plan
