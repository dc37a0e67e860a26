#include "plan/sun_elevation_times.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/time_expression.h"

namespace skylapse::plan {
namespace {

using Half = config::SunElevations::Half;
using std::chrono::year_month_day;

/// "2026-01-01, 2026-01-02, 2026-01-03, ..."
std::string days_text(const std::vector<year_month_day>& days) {
  constexpr size_t kShown = 3;
  std::string text;
  for (size_t i = 0; i < std::min(days.size(), kShown); ++i)
    text += (i == 0 ? "" : ", ") + config::date_text(days[i]);
  return text + (days.size() > kShown ? ", ..." : "");
}

}  // namespace

std::vector<SunElevationTimes::Time> SunElevationTimes::of_day(const year_month_day& date,
                                                               const astro::CivilDay& day) {
  ++days_;
  const auto crossings =
      astro::sun_level_crossings(ephemeris_, site_.position, day.start, day.end, asked_.elevations);
  std::vector<Time> times;
  for (size_t i = 0; i < asked_.elevations.size(); ++i) {
    const auto take = [&](bool rising) {
      const auto first =
          std::find_if(crossings.begin(), crossings.end(), [&](const astro::LevelCrossing& c) {
            return c.level == asked_.elevations[i] && c.rising == rising;
          });
      if (first != crossings.end())
        times.push_back({first->instant, {asked_.elevations[i], rising}});
      else
        (rising ? absent_[i].rising : absent_[i].sinking).push_back(date);
    };
    const size_t before = times.size();
    if (asked_.half != Half::afternoon) take(true);
    if (asked_.half != Half::morning) take(false);
    std::sort(times.begin() + long(before), times.end(),
              [](const Time& a, const Time& b) { return a.instant < b.instant; });
  }
  return times;
}

std::vector<std::string> SunElevationTimes::notes() const {
  std::vector<std::string> notes;
  const auto add = [&](Angle elevation, std::string_view what,
                       const std::vector<year_month_day>& days) {
    if (!days.empty())
      notes.push_back(
          fmt::format("{}: the sun's centre does not {} {:g} deg on {} of {} days ({}); "
                      "passed over",
                      site_.name, what, elevation.in(deg), days.size(), days_, days_text(days)));
  };
  for (size_t i = 0; i < absent_.size(); ++i) {
    const auto& [rising, sinking] = absent_[i];
    if (rising == sinking) {
      add(asked_.elevations[i], "pass", rising);
    } else {
      add(asked_.elevations[i], "rise through", rising);
      add(asked_.elevations[i], "sink through", sinking);
    }
  }
  return notes;
}

}  // namespace skylapse::plan
