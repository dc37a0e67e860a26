#include "astro/time/zone.h"

#include <date/tz.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <exception>
#include <optional>
#include <vector>

#include "astro/time/posix_zone.h"
#include "astro/time/text_scanner.h"
#include "astro/time/zone_file.h"

namespace skylapse::astro {

using namespace std::chrono_literals;
using std::chrono::days;
using std::chrono::floor;
using std::chrono::local_days;
using std::chrono::microseconds;
using std::chrono::seconds;
using std::chrono::sys_seconds;
using std::chrono::sys_time;
using std::chrono::year_month_day;

namespace {

/// Largest offset that a user may write; the widest ever in force was 15:13:42 (Juneau).
constexpr seconds kLargestOffset = 18h;
/// A wall clock is never farther from UTC than this (15:13:42, rounded up generously).
constexpr seconds kReach = 26h;

sys_time<microseconds> as_if_utc(WallTime wall) {
  return sys_time<microseconds>{wall.time_since_epoch()};
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string last_part(const std::string& name) { return name.substr(name.rfind('/') + 1); }

/// The known name that was probably meant: another spelling, the city alone, or a typing slip.
std::optional<std::string> probable_name(const std::string& word) {
  std::vector<std::string> names;
  for (const date::time_zone& zone : date::get_tzdb().zones) names.push_back(zone.name());
  const std::string wanted = lower_case(word);
  for (const std::string& name : names)
    if (lower_case(name) == wanted) return name;
  for (const std::string& name : names)
    if (lower_case(last_part(name)) == wanted) return name;
  if (const auto near = nearest_name(word, names)) return near;
  std::vector<std::string> cities;
  for (const std::string& name : names) cities.push_back(last_part(name));
  const auto city = nearest_name(word, cities);
  if (!city) return std::nullopt;
  return names[std::find(cities.begin(), cities.end(), *city) - cities.begin()];
}

/// The error of a machine without tzdata; nothing if there are zones.
std::optional<Error> missing_zone_data() {
  try {
    if (!date::get_tzdb().zones.empty()) return std::nullopt;
  } catch (const std::exception&) {  // there is no folder at all
  }
  return Error{.code = ErrorCode::missing_backend,
               .message = fmt::format("no time-zone data in {}", zone_folder().string()),
               .hint = "install the package tzdata, or give the zone as an offset (+02:00)"};
}

Error unknown_zone(const std::string& name) {
  const auto meant = probable_name(name);
  return {.code = ErrorCode::invalid_input,
          .message = fmt::format("unknown time zone \"{}\"", name),
          .hint = (meant ? fmt::format("did you mean {}? ", *meant) : std::string{}) +
                  "allowed: an IANA name (Europe/Prague), UTC, or an offset (+02:00)"};
}

std::string describe(WallTime wall) {
  const int decimals = wall == floor<seconds>(wall) ? 0 : 6;
  return format_clock(wall.time_since_epoch(), false, decimals);
}

std::optional<seconds> fixed_offset(const std::string& name) {
  if (name == "UTC") return 0s;
  TextScanner in(name);
  const auto offset = in.take_utc_offset();
  if (!offset || !in.at_end()) return std::nullopt;
  return offset;
}

}  // namespace

struct Zone::Rules {
  std::string name;
  ZonePeriod fixed{kFarPast, kFarFuture, 0s, "UTC"};  // in force if there is no `table`
  const date::time_zone* table = nullptr;
  std::optional<PosixZone> footer;

  [[nodiscard]] ZonePeriod period_at(sys_seconds t) const {
    if (!table) return fixed;
    const date::sys_info info = table->get_info(t);
    ZonePeriod period{std::max(info.begin, kFarPast), std::min(info.end, kFarFuture), info.offset,
                      info.abbrev};
    const bool after_last_transition = period.end == kFarFuture;
    if (!after_last_transition || !footer) return period;
    ZonePeriod ruled = footer->period_at(t);
    ruled.begin = std::max(ruled.begin, period.begin);
    return ruled;
  }

  /// The periods that touch [from, to], in order.
  [[nodiscard]] std::vector<ZonePeriod> periods(sys_seconds from, sys_seconds to) const {
    std::vector<ZonePeriod> list{period_at(from)};
    while (list.back().end <= to) list.push_back(period_at(list.back().end));
    return list;
  }

  /// First instant whose local calendar date is `date`; nothing if the zone skips that date.
  [[nodiscard]] std::optional<sys_seconds> first_instant(local_days date) const {
    const sys_seconds nominal{date.time_since_epoch()};
    for (const ZonePeriod& p : periods(nominal - kReach, nominal + days{1} + kReach)) {
      const sys_seconds begin = std::max(p.begin, nominal - p.utc_offset);
      const sys_seconds end = std::min(p.end, nominal + days{1} - p.utc_offset);
      if (begin < end) return begin;
    }
    return std::nullopt;
  }
};

Zone::Zone(std::shared_ptr<const Rules> rules) : rules_(std::move(rules)) {}

Result<Zone> Zone::find(const std::string& name) {
  Rules rules;
  rules.name = name;
  if (const auto offset = fixed_offset(name)) {
    if (std::chrono::abs(*offset) > kLargestOffset)
      return Error{.code = ErrorCode::invalid_input,
                   .message = fmt::format("UTC offset {} is out of range", name),
                   .hint = "allowed: -18:00 to +18:00"};
    rules.fixed.utc_offset = *offset;
    rules.fixed.abbreviation = *offset == 0s ? "UTC" : format_offset(*offset);
    return Zone(std::make_shared<const Rules>(std::move(rules)));
  }
  if (const auto missing = missing_zone_data()) return *missing;
  try {
    rules.table = date::locate_zone(name);
  } catch (const std::exception&) {
    return unknown_zone(name);
  }
  if (!is_zone_file(name))
    return Error{
        .code = ErrorCode::missing_backend,
        .message = fmt::format("{} is not a time-zone file", (zone_folder() / name).string()),
        .hint = "reinstall the package tzdata"};
  rules.footer = read_zone_footer(name);
  return Zone(std::make_shared<const Rules>(std::move(rules)));
}

const std::string& Zone::name() const { return rules_->name; }

LocalTime Zone::to_local(const Instant& instant) const {
  // The leap second still belongs to the offset of the second before it.
  const auto second_in_force = floor<seconds>(instant.utc) - (instant.leap_second ? 1s : 0s);
  ZonePeriod period = rules_->period_at(second_in_force);
  return {.wall = WallTime{(instant.utc + period.utc_offset).time_since_epoch()},
          .utc_offset = period.utc_offset,
          .abbreviation = std::move(period.abbreviation),
          .leap_second = instant.leap_second};
}

Result<Instant> Zone::to_instant(WallTime wall) const {
  const sys_time<microseconds> nominal = as_if_utc(wall);
  const sys_seconds whole = floor<seconds>(nominal);
  const auto periods = rules_->periods(whole - kReach, whole + kReach);
  std::vector<const ZonePeriod*> matches;
  for (const ZonePeriod& p : periods)
    if (nominal - p.utc_offset >= p.begin && nominal - p.utc_offset < p.end) matches.push_back(&p);
  if (matches.size() == 1) return Instant{.utc = nominal - matches.front()->utc_offset};
  if (matches.size() > 1)
    return Error{
        .code = ErrorCode::invalid_input,
        .message = fmt::format("{} happens twice in {}: at {} and again at {}", describe(wall),
                               name(), format_offset(matches.front()->utc_offset),
                               format_offset(matches.back()->utc_offset)),
        .hint = fmt::format("say which one: {}{} or {}{}", describe(wall),
                            format_offset(matches.front()->utc_offset), describe(wall),
                            format_offset(matches.back()->utc_offset))};
  for (size_t i = 0; i + 1 < periods.size(); ++i) {
    const ZonePeriod& before = periods[i];
    const ZonePeriod& after = periods[i + 1];
    if (nominal < before.end + before.utc_offset || nominal >= before.end + after.utc_offset)
      continue;
    const auto clock = [&](seconds offset) {
      return format_clock((before.end + offset).time_since_epoch(), false, 0) +
             format_offset(offset);
    };
    return Error{
        .code = ErrorCode::invalid_input,
        .message = fmt::format("{} does not exist in {}: clocks jump from {} to {}", describe(wall),
                               name(), clock(before.utc_offset), clock(after.utc_offset)),
        .hint = fmt::format("write the offset that you mean: {} or {}",
                            format_offset(before.utc_offset), format_offset(after.utc_offset))};
  }
  return Error{.code = ErrorCode::internal,
               .message = fmt::format("no offset of {} fits {}", name(), describe(wall))};
}

Result<CivilDay> Zone::civil_day(year_month_day date) const {
  if (!date.ok())
    return Error{.code = ErrorCode::invalid_input,
                 .message = "that is not a date of the calendar",
                 .hint = "dates read YYYY-MM-DD"};
  const local_days day{date};
  const auto start = rules_->first_instant(day);
  if (!start)
    return Error{.code = ErrorCode::invalid_input,
                 .message = fmt::format("{:04}-{:02}-{:02} does not exist in {}: the zone skipped "
                                        "that day when it crossed the date line",
                                        int{date.year()}, unsigned{date.month()},
                                        unsigned{date.day()}, name()),
                 .hint = "choose the day before or after"};
  auto end = rules_->first_instant(day + days{1});
  if (!end) end = rules_->first_instant(day + days{2});
  if (!end)
    return Error{.code = ErrorCode::internal,
                 .message = fmt::format("{} skips two days in a row", name())};
  return CivilDay{.date = date, .start = {.utc = *start}, .end = {.utc = *end}};
}

std::string format_local(const LocalTime& local, int decimals) {
  assert(decimals >= 0 && decimals <= 6);
  const WallTime rounded = round_to_decimals(local.wall, decimals);
  const bool leap = local.leap_second && floor<seconds>(rounded) == floor<seconds>(local.wall);
  return format_clock((leap || !local.leap_second ? rounded : WallTime{floor<seconds>(local.wall)})
                          .time_since_epoch(),
                      leap, decimals) +
         format_offset(local.utc_offset);
}

}  // namespace skylapse::astro
