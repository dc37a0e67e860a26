#pragma once
// Where the pixels of a row look, and which regions of the sky they belong to.
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "image/diff/picture.h"

namespace skylapse::image {

/// Regions may overlap; a pixel belongs to one if its centre does.
enum class SkyRegion {
  sky,        // above the level
  ground,     // below it
  zenith,     // elevation of 60 deg and more
  horizon,    // within 5 deg of the level
  disc,       // the sun with a rim of 1.5 pixels
  aureole,    // around that, to 15 deg from the sun
  antisolar,  // within 30 deg of the point opposite the sun's azimuth, at the sun's elevation
};
inline constexpr int kSkyRegions = 7;

/// "sky", "ground", "zenith", "horizon", "disc", "aureole", "antisolar".
std::string_view name_of(SkyRegion region);
/// For people: "sky", "ground", "zenith", "horizon ring", "sun's disc", "aureole", "anti-solar
/// sky".
std::string_view title_of(SkyRegion region);

/// The regions of a direction, one bit each. `pixel`: angle across a pixel.
uint8_t regions_at(const glm::dvec3& direction, const SkyView& view, Angle pixel);

/// The most telling of the regions: the disc before the aureole before the ring ... before the sky.
std::optional<SkyRegion> chief_region(uint8_t regions);

/// What is known of each pixel of a row. Pixels outside a fisheye's circle have no solid angle and
/// no region.
struct SkyRow {
  std::vector<float> east, north, up;
  std::vector<float> solid_angle;  // sr
  std::vector<uint8_t> regions;    // bits by SkyRegion
};

/// Rows of a picture whose camera is known. Directions are those of pixel centres within half a
/// pixel, solid angles those of pixel_solid_angle within 6 % (of pixels of a degree and less:
/// 1e-3): one is computed, the others follow from the projection's density; pixels cut by the rim
/// of a circle count whole.
class SkyRows {
 public:
  /// `view.camera` is set.
  explicit SkyRows(const SkyView& view);
  /// Thread-safe; `row` keeps its memory from call to call.
  void fill(int y, SkyRow& row) const;

 private:
  SkyView view_;
  std::vector<float> sin_azimuth_, cos_azimuth_;  // of columns of a lat-long map
  double unit_ = 0;  // sr of a pixel where the projection's density is 1
  [[nodiscard]] double density(const glm::dvec3& enu) const;
  void find_unit();
  void set_pixel(size_t x, const glm::dvec3& direction, SkyRow& row) const;
  void fill_stretch(int y, int begin, int end, SkyRow& row) const;
  void fill_lat_long(int y, SkyRow& row) const;
  void set_regions(SkyRow& row) const;
};

}  // namespace skylapse::image
