#pragma once
// Parts of the sky in which models err in their own ways. Every direction above the camera's
// horizon lies in one of them, so that the error of a picture is the mean over the parts it shows.
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "core/frames.h"
#include "image/camera/camera.h"

namespace skylapse::plan {

enum class SkyPart {
  aureole,          // within 12 deg of the sun, wherever that stands
  horizon_sunward,  // up to 5 deg above the horizon, azimuth within 90 deg of the sun's
  horizon_away,     // as low, on the other side
  low_sunward,      // from there to 25 deg
  low_away,
  high,  // the rest
};
inline constexpr int kSkyParts = 6;
inline constexpr std::array<std::string_view, kSkyParts> kSkyPartNames{
    "aureole", "horizon_sunward", "horizon_away", "low_sunward", "low_away", "high"};

inline constexpr Angle kAureoleRadius = 12 * deg, kHorizonBand = 5 * deg, kLowSky = 25 * deg;

/// The part of a direction; nothing below the horizon, whose elevation is at most 0.
std::optional<SkyPart> part_of(const Direction<Enu>& view, const Direction<Enu>& sun,
                               Angle horizon);

/// Share of the solid angle of a picture's sky in each part; all 0 if it shows none.
using PartShares = std::array<double, kSkyParts>;

/// A camera as a few hundred directions, or as many thousand where few of those fall into the sky
/// (the limb from orbit is thin): what it sees of the sky for a sun anywhere.
class CameraSky {
 public:
  explicit CameraSky(const image::Camera& camera);

  /// Shares for a sun; `horizon` and `highest` bound what counts as sky: highest is where the air
  /// ends for a camera above it, else the zenith.
  [[nodiscard]] PartShares shares(const Direction<Enu>& sun, Angle horizon,
                                  Angle highest = 90 * deg) const;

 private:
  struct Look {
    Direction<Enu> toward;
    Angle elevation;
    double solid_angle;
  };
  using Looks = std::vector<Look>;
  static Looks looks_of(const image::Camera& camera, int cells);
  Looks coarse_, fine_;
};

}  // namespace skylapse::plan
