#include "plan/rung.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plan/sky_model.h"

namespace skylapse::plan {
namespace {

using config::SkyModel;
using sky::bruneton::Level;

struct Share {
  ErrorPart part;
  double factor = 1;
};

/// The finest tables are taken to be within half of what parts them from the next coarser ones:
/// the path tracer cannot tell in deep twilight, where its noise is greatest.
constexpr double kOfFinest = 0.5;

ErrorPart part_of(Level level) {
  switch (level) {
    case Level::draft:
      return ErrorPart::draft;
    case Level::low:
      return ErrorPart::low;
    default:
      return ErrorPart::standard;
  }
}

/// Parts of the error of a rung.
std::vector<Share> parts_of(const Rung& rung) {
  if (rung.model == SkyModel::hosek_wilkie) return {{ErrorPart::hosek_wilkie}};
  std::vector<Share> parts;
  if (rung.model == SkyModel::single_scattering) {
    parts.push_back({ErrorPart::single_scattering});
  } else {
    parts.push_back({ErrorPart::fine});
    parts.push_back({part_of(rung.level), rung.level == Level::fine ? kOfFinest : 1});
  }
  if (rung.wavelengths == 4) parts.push_back({ErrorPart::bands_4});
  if (rung.wavelengths == 8) parts.push_back({ErrorPart::bands_8});
  if (rung.wavelengths == 16) parts.push_back({ErrorPart::bands_16});
  return parts;
}

}  // namespace

const std::vector<Rung>& ladder() {
  using enum SkyModel;
  static const std::vector<Rung> rungs{{hosek_wilkie, Level::standard, 16},
                                       {single_scattering, Level::standard, 4},
                                       {single_scattering, Level::standard, 8},
                                       {bruneton, Level::draft, 4},
                                       {bruneton, Level::draft, 8},
                                       {bruneton, Level::draft, 16},
                                       {bruneton, Level::low, 8},
                                       {bruneton, Level::low, 16},
                                       {bruneton, Level::standard, 8},
                                       {bruneton, Level::standard, 16},
                                       {bruneton, Level::standard, 32},
                                       {bruneton, Level::fine, 16},
                                       {bruneton, Level::fine, 32}};
  return rungs;
}

std::string name_of(const Rung& rung) {
  const std::string model = name_of(rung.model);
  if (is_fitted(rung.model)) return model;
  if (rung.model != SkyModel::bruneton)
    return fmt::format("{}, {} wavelengths", model, rung.wavelengths);
  return fmt::format("{} {}, {} wavelengths", model, sky::bruneton::name_of(rung.level),
                     rung.wavelengths);
}

double error_bound(const Rung& rung, const PictureScene& scene, const ErrorTable& table) {
  if (std::ranges::all_of(scene.shares, [](double share) { return share == 0; })) return 0;
  double square = kNegligibleError * kNegligibleError;
  for (const Share& share : parts_of(rung)) {
    const ErrorRow& row = table[size_t(share.part)];
    square +=
        std::pow(share.factor * row.margin, 2) * typical_square(row, scene.features, scene.shares);
  }
  const bool known = scene.known_air && within_calibration(scene.features);
  const double bound = (known ? 1 : kUnknownAir) * std::sqrt(square);
  if (is_beyond_truth(scene.features)) return std::max(bound, 1.0);
  return rung.model == SkyModel::single_scattering ? std::min(bound, 1.0) : bound;
}

PathOutlook path_outlook(const PictureScene& scene, const ErrorTable& table) {
  const auto of = [&](ErrorPart part) {
    return std::sqrt(typical_square(table[size_t(part)], scene.features, scene.shares));
  };
  return {of(ErrorPart::path), 1e-6 * of(ErrorPart::path_time)};
}

void take(const Rung& rung, config::Sky& sky) {
  sky.model = rung.model;
  sky.level = rung.level;
  sky.wavelengths = rung.wavelengths;
  sky.wavelengths_given = true;  // what is promised is not left to another rule
}

}  // namespace skylapse::plan
