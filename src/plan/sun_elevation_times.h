#pragma once
// The moments of a job that asks for elevations of the sun.
#include <string>
#include <vector>

#include "plan/frame_schedule.h"

namespace skylapse::plan {

/// The moments of one site's days, and which of them the sun leaves out.
class SunElevationTimes {
 public:
  /// All must outlive it.
  SunElevationTimes(const config::SunElevations& asked, const config::Site& site,
                    const astro::Ephemeris& ephemeris)
      : asked_(asked), site_(site), ephemeris_(ephemeris), absent_(asked.elevations.size()) {}

  struct Time {
    astro::Instant instant;
    AskedSun sun;
  };
  /// Of one day: by elevation as written, then by time. Of the moments at which the sun passes one
  /// elevation in the same sense the first counts: near the poles a day may hold two.
  std::vector<Time> of_day(const std::chrono::year_month_day& date, const astro::CivilDay& day);

  /// Which elevations the sun did not pass on how many of the days that were asked for.
  [[nodiscard]] std::vector<std::string> notes() const;

 private:
  struct Absent {
    std::vector<std::chrono::year_month_day> rising, sinking;
  };
  const config::SunElevations& asked_;
  const config::Site& site_;
  const astro::Ephemeris& ephemeris_;
  std::vector<Absent> absent_;  // of each elevation
  long days_ = 0;
};

}  // namespace skylapse::plan
