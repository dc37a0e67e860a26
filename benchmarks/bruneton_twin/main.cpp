// Accuracy of the atmosphere model, from its CPU twin.
//
//   bruneton_twin accuracy | twilight [LEVEL] | illuminance [LEVEL] | energy [LEVEL] | slices |
//   draws [COUNT]
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "studies.h"

int main(int argc, char** argv) {
  using namespace skylapse::sky::bruneton;
  const std::string what = argc > 1 ? argv[1] : "";
  const std::string detail = argc > 2 ? argv[2] : "";
  const auto& names = level_names();
  const auto found = std::find(names.begin(), names.end(), detail);
  const Level level = found == names.end() ? Level::standard : Level(found - names.begin());
  if (what == "accuracy")
    study_accuracy();
  else if (what == "twilight")
    study_twilight(level);
  else if (what == "illuminance")
    study_illuminance(level);
  else if (what == "energy")
    study_energy(level);
  else if (what == "slices")
    study_slices();
  else if (what == "draws")
    study_draws(detail.empty() ? 10'000'000 : std::stoll(detail));
  else
    return fmt::print(stderr, "accuracy, twilight, illuminance, energy, slices or draws?\n"), 2;
  return 0;
}
