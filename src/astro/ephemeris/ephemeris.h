#pragma once
#include <memory>
#include <optional>
#include <string>

#include "astro/sky_state.h"
#include "astro/time/instant.h"

namespace skylapse::astro {

/// Rungs of the accuracy ladder for the sun's position, best first.
enum class SunAlgorithm {
  erfa,            // ERFA epv00, IAU 2006/2000A, topocentric; 0.02 arcsec
  sg2,             // SG2 (Blanc & Wald 2012)
  preetham_atan2,  // the thesis's formulas (Preetham et al. 1999) with atan2 for the azimuth
  preetham,        // the thesis's formulas with its arctan: the azimuth flaw, kept for study
};
std::optional<SunAlgorithm> sun_algorithm_from_name(const std::string& name);
std::string name_of(SunAlgorithm algorithm);

struct EphemerisOptions {
  SunAlgorithm algorithm = SunAlgorithm::erfa;
  Duration dut1{};  // UT1 - UTC, |dut1| <= 0.9 s; before 1972 the stamp is UT1 and this is unused
  std::optional<Duration> tt_minus_ut1{};  // overrides leap seconds (and Delta T before 1972)
};

/// Sun and moon for one observer after another. Caches the slow part (precession-nutation) per
/// hour; results do not depend on the order of the calls. One object per thread.
class Ephemeris {
 public:
  explicit Ephemeris(EphemerisOptions options = {});
  ~Ephemeris();
  Ephemeris(Ephemeris&&) noexcept;
  Ephemeris& operator=(Ephemeris&&) noexcept;
  [[nodiscard]] const EphemerisOptions& options() const;
  [[nodiscard]] SkyState sky_state(const Instant& instant, const GeodeticPosition& observer,
                                   const RefractionConditions& refraction) const;
  /// The sun's part alone (moon fields left at their defaults): what sequences and event finding
  /// use; at most 5 microseconds at one-minute steps.
  [[nodiscard]] SkyState sun_state(const Instant& instant, const GeodeticPosition& observer,
                                   const RefractionConditions& refraction) const;

 private:
  struct Cache;
  std::unique_ptr<Cache> cache_;
};

}  // namespace skylapse::astro
