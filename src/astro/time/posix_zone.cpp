#include "astro/time/posix_zone.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "astro/time/text_scanner.h"

namespace skylapse::astro {
namespace {

using namespace std::chrono_literals;
using std::chrono::days;
using std::chrono::local_days;
using std::chrono::local_seconds;
using std::chrono::seconds;
using std::chrono::sys_seconds;
using std::chrono::year;

/// "CET" or "<+0330>".
std::optional<std::string> take_name(TextScanner& in) {
  const bool quoted = in.take('<');
  std::string name;
  const auto belongs = [&](unsigned char c) {
    return std::isalpha(c) || (quoted && (std::isdigit(c) || c == '+' || c == '-'));
  };
  while (belongs(static_cast<unsigned char>(in.peek()))) name += in.take_any();
  if ((quoted && !in.take('>')) || name.size() < 3) return std::nullopt;
  return name;
}

/// "[+-]hh[:mm[:ss]]", positive as written.
std::optional<seconds> take_time(TextScanner& in) {
  const int sign = in.take('-') ? -1 : 1;
  if (sign > 0) in.take('+');
  const auto h = in.take_number(1, 3);
  if (!h || *h > 167) return std::nullopt;
  seconds total = std::chrono::hours{*h};
  for (const seconds unit : {60s, 1s}) {
    if (!in.take(':')) break;
    const auto part = in.take_number(2, 2);
    if (!part || *part > 59) return std::nullopt;
    total += *part * unit;
  }
  return sign * total;
}

}  // namespace

std::optional<PosixZone::Switch> PosixZone::take_switch(TextScanner& in) {
  Switch s;
  if (in.take('M')) {
    const auto field = [&](bool introduced, int digits) {
      return introduced ? in.take_number(1, digits).value_or(-1) : -1;
    };
    s.month = field(true, 2);
    s.week = field(in.take('.'), 1);
    s.weekday = field(in.take('.'), 1);
    const bool valid = s.month >= 1 && s.month <= 12 && s.week >= 1 && s.week <= 5 &&
                       s.weekday >= 0 && s.weekday <= 6;
    if (!valid) return std::nullopt;
  } else {
    const bool without_leap_day = in.take('J');
    s.rule = without_leap_day ? DayRule::julian_without_leap_day : DayRule::zero_based_day;
    const auto day = in.take_number(1, 3);
    if (!day || *day > 365 || (without_leap_day && *day < 1)) return std::nullopt;
    s.day = *day;
  }
  s.local_time = 2h;
  if (in.take('/')) {
    const auto time = take_time(in);
    if (!time) return std::nullopt;
    s.local_time = *time;
  }
  return s;
}

std::optional<PosixZone> PosixZone::parse(std::string_view text) {
  TextScanner in(text);
  PosixZone zone;
  const auto name = take_name(in);
  const auto west = name ? take_time(in) : std::nullopt;
  if (!west) return std::nullopt;
  zone.name_ = *name;
  zone.utc_offset_ = -*west;
  if (in.at_end()) return zone;

  Summer summer;
  const auto summer_name = take_name(in);
  if (!summer_name) return std::nullopt;
  summer.name = *summer_name;
  summer.utc_offset = zone.utc_offset_ + 1h;
  if (in.peek() != ',') {
    const auto summer_west = take_time(in);
    if (!summer_west) return std::nullopt;
    summer.utc_offset = -*summer_west;
  }
  const auto begin = in.take(',') ? take_switch(in) : std::nullopt;
  const auto end = begin && in.take(',') ? take_switch(in) : std::nullopt;
  if (!end || !in.at_end()) return std::nullopt;
  summer.begin = *begin, summer.end = *end;
  zone.summer_ = std::move(summer);
  return zone;
}

local_seconds PosixZone::Switch::in_year(year y) const {
  const local_days new_year{y / 1 / 1};
  switch (rule) {
    case DayRule::julian_without_leap_day:  // J60 is 1 March in every year
      return new_year + days{day - 1 + (y.is_leap() && day >= 60 ? 1 : 0)} + local_time;
    case DayRule::zero_based_day:
      return new_year + days{day} + local_time;
    case DayRule::month_week_day:
      break;
  }
  const auto this_month = y / std::chrono::month{static_cast<unsigned>(month)};
  const std::chrono::weekday wanted{static_cast<unsigned>(weekday)};
  const local_days date = week == 5 ? local_days{this_month / wanted[std::chrono::last]}
                                    : local_days{this_month / wanted[static_cast<unsigned>(week)]};
  return date + local_time;
}

ZonePeriod PosixZone::period_at(sys_seconds t) const {
  if (!summer_) return {kFarPast, kFarFuture, utc_offset_, name_};
  struct Transition {
    sys_seconds at;
    bool to_summer;
    auto operator<=>(const Transition&) const = default;
  };
  const auto as_utc = [](local_seconds wall, seconds offset) {
    return sys_seconds{wall.time_since_epoch() - offset};
  };
  // Two years before to two after: enough to find both ends of the period, also where a switch
  // falls into the neighbouring year on the UTC clock or all-year summer time joins two years.
  std::array<Transition, 10> transitions;
  const year middle = std::chrono::year_month_day{std::chrono::floor<days>(t)}.year();
  for (int i = 0; i < 5; ++i) {
    const year y = middle + std::chrono::years{i - 2};
    transitions[2 * i] = {as_utc(summer_->begin.in_year(y), utc_offset_), true};
    transitions[2 * i + 1] = {as_utc(summer_->end.in_year(y), summer_->utc_offset), false};
  }
  std::sort(transitions.begin(), transitions.end());
  const auto next = std::find_if(transitions.begin(), transitions.end(),
                                 [&](const Transition& x) { return x.at > t; });
  const Transition& last = *(next - 1);
  return last.to_summer ? ZonePeriod{last.at, next->at, summer_->utc_offset, summer_->name}
                        : ZonePeriod{last.at, next->at, utc_offset_, name_};
}

}  // namespace skylapse::astro
