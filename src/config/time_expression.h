#pragma once
// Days and times as people write them.
#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "config/job_config.h"
#include "config/source_text.h"

namespace skylapse::config {

/// "2026-06-21": a day of the proleptic Gregorian calendar, year 1900 to 2199.
Result<std::chrono::year_month_day, Problem> parse_date(std::string_view text);

/// "2026-06-21" or "2026-06-01 .. 2026-06-30", both days included, every day of it.
Result<DateRange, Problem> parse_date_range(std::string_view text);

/// [date] (clock [zone] | anchor) [+|- duration], the date joined by a blank or a "T":
///   sunrise - 45 min | 2026-06-21 civil_dusk + 10 min | 04:30 | 24:00 | 2026-06-21T04:30+02:00
/// Clock: hh:mm[:ss[.ffffff]], 24:00 at most, seconds to 60 (a leap second, whose clock reads one
/// second past the minute's last). Zone: "Z", "UTC" or an offset hh:mm up to 18 hours. The span is
/// left empty. Offsets of a day or more are allowed.
Result<TimeExpression, Problem> parse_time_expression(std::string_view text);

/// "2026-06-21"
std::string date_text(std::chrono::year_month_day date);

/// Names of the anchors, for messages, schema and docs.
std::vector<std::string> anchor_names();

}  // namespace skylapse::config
