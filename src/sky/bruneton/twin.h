#pragma once
// The CPU twin: the same physics in double, complete. It judges the GPU's floats, answers where a
// few directions are asked for, and knows the transmittance that the sun's disc needs.
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>

#include "core/result.h"
#include "sky/atmosphere/medium.h"
#include "sky/bruneton/query.h"
#include "sky/bruneton/sky_slice.h"
#include "sky/bruneton/tables.h"

namespace skylapse::sky::bruneton {

/// How finely the twin marches; the defaults are those of the GPU's slice.
struct MarchSettings {
  int samples = 16;  // Gauss nodes of each piece of a view ray
  bool multiple_scattering = true;
  bool ground = false;  // add what the ground at the end of the ray reflects
  /// Slices alone; as SliceContent.
  bool aerial_perspective = true;
  std::optional<SliceWindow> window{};
};

/// A medium with its table of optical columns: Rayleigh, aerosol and ozone from any height in any
/// direction to the top, free of wavelength. Costs some 10 ms to make.
class Columns;
struct PhysicsData;
std::shared_ptr<const Columns> make_columns(const atmosphere::Medium& medium);

/// Told the share of the work that is done, 0..1, from the thread that computes; answers whether to
/// go on.
using Progress = std::function<bool(double)>;

/// The tables in double on all cores; the stored numbers are rounded to float.
Tables precompute_twin(const atmosphere::Medium& medium, const Settings& settings);
/// Error interrupted where `progress` says no.
Result<Tables> precompute_twin(const atmosphere::Medium& medium, const Settings& settings,
                               const Progress& progress);

class Twin {
 public:
  explicit Twin(std::shared_ptr<const Tables> tables);  // source may be empty: single scattering

  [[nodiscard]] Answer answer(const Query& query, const MarchSettings& march = {}) const;

  /// Transmittance per band from `height` towards `zenith`, to space; 0 through the planet.
  [[nodiscard]] std::vector<double> transmittance(Length height, Angle zenith) const;

  /// Horizontal irradiance per band at `height` [W m^-2 nm^-1]: by the sun's disc, by the sky.
  struct Irradiance {
    std::vector<double> sun, sky;
  };
  [[nodiscard]] Irradiance irradiance(Length height, Angle sun_zenith) const;

  /// In-scattered light and transmittance between two points, in km from the planet's centre, the
  /// sun in direction `to_sun` (unit). Points may lie outside the air; where the planet is between
  /// them, the path ends at its surface. Continuous in both points, across the horizon too.
  struct AerialPerspective {
    std::vector<double> in_scatter;  // W m^-2 sr^-1 nm^-1, arriving at `from`
    std::vector<double> transmittance;
  };
  [[nodiscard]] AerialPerspective aerial_perspective(const glm::dvec3& from_km,
                                                     const glm::dvec3& to_km,
                                                     const glm::dvec3& to_sun,
                                                     const MarchSettings& march = {}) const;

  [[nodiscard]] SkySlice slice(Length camera_height, Angle sun_zenith, const SliceGrid& grid,
                               const MarchSettings& march = {}) const;

  [[nodiscard]] const atmosphere::Medium& medium() const;

 private:
  std::shared_ptr<const Tables> tables_;
  std::shared_ptr<const Columns> columns_;
  std::shared_ptr<const PhysicsData> data_;  // for marches of the default fineness
};

}  // namespace skylapse::sky::bruneton
