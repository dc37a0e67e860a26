#include <fmt/format.h>

#include "astro/events.h"
#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/csv.h"
#include "cli/table.h"
#include "config/time_expression.h"

namespace skylapse::cli {
namespace {

using astro::EventKind;

struct EventArguments {
  std::string at, zone, date, batch;
  std::string format = "table";
  int days = 1;
};

constexpr int kMaxDays = 100'000;

const std::vector<EventKind> kOrder{
    EventKind::solar_noon,    EventKind::solar_midnight, EventKind::sunrise,
    EventKind::sunset,        EventKind::civil_dawn,     EventKind::civil_dusk,
    EventKind::nautical_dawn, EventKind::nautical_dusk,  EventKind::astro_dawn,
    EventKind::astro_dusk,    EventKind::moonrise,       EventKind::moonset};

std::vector<std::string> columns() {
  std::vector<std::string> names{"place",      "lat_deg",       "lon_deg",     "height_m", "zone",
                                 "local_date", "day_start_utc", "day_end_utc", "day_hours"};
  for (const EventKind kind : kOrder) {
    names.push_back(name_of(kind) + "_utc");
    if (kind == EventKind::solar_midnight) {
      names.emplace_back("sun_el_max_deg");
      names.emplace_back("sun_el_min_deg");
    }
  }
  return names;
}

std::string times_text(const astro::EventTimes& event) {
  if (event.times.empty()) switch (event.absent) {
      case astro::AbsentEvent::above:
        return "above";
      case astro::AbsentEvent::below:
        return "below";
      case astro::AbsentEvent::none:
        return "none";
    }
  std::string text;
  for (const auto& time : event.times) text += (text.empty() ? "" : ";") + format_utc(time, 3);
  return text;
}

std::vector<Cell> row_of(const config::Site& site, const astro::Zone& zone,
                         const astro::DayEvents& events) {
  const double hours = (events.day.end - events.day.start).in(hour);
  std::vector<Cell> row{text_cell(site.name),
                        number_cell(site.position.latitude.in(deg), 6),
                        number_cell(site.position.longitude.in(deg), 6),
                        number_cell(site.position.height.in(metre), 2),
                        text_cell(zone.name()),
                        text_cell(config::date_text(events.day.date)),
                        text_cell(format_utc(events.day.start)),
                        text_cell(format_utc(events.day.end)),
                        {fmt::format("{:g}", hours), true}};
  for (const EventKind kind : kOrder) {
    row.push_back(text_cell(times_text(events.of(kind))));
    if (kind == EventKind::solar_midnight) {
      row.push_back(number_cell(events.sun_elevation_max.in(deg), 4));
      row.push_back(number_cell(events.sun_elevation_min.in(deg), 4));
    }
  }
  return row;
}

Result<Table> one_place(const EventArguments& arguments) {
  const auto site = parse_place(arguments.at);
  if (!site) return site.error();
  const auto zone = parse_zone(arguments.zone);
  if (!zone) return zone.error();
  const auto first = parse_day("--date", arguments.date);
  if (!first) return first.error();
  if (arguments.days < 1 || arguments.days > kMaxDays)
    return option_error("--days", fmt::format("{} is out of range", arguments.days),
                        fmt::format("allowed: 1 to {}", kMaxDays));
  const astro::Ephemeris ephemeris;
  Table table{columns(), {}};
  for (int i = 0; i < arguments.days; ++i) {
    const auto day = zone->civil_day(std::chrono::sys_days(*first) + std::chrono::days(i));
    if (day)
      table.rows.push_back(row_of(*site, *zone, day_events(ephemeris, site->position, *day)));
    else if (arguments.days == 1)  // inside a range, a day that the zone skips has no row
      return option_error("--date", day.error().message, day.error().hint);
  }
  return table;
}

/// The columns of one row of a batch.
Result<std::vector<Cell>> batch_row(const CsvTable& input, size_t row,
                                    const astro::Ephemeris& ephemeris) {
  const auto wrong = [&](const char* column, const Error& error) {
    return csv_error(input, row, column, fmt::format("{}: {}", column, error.message), error.hint);
  };
  const auto place = csv_place(input, row);
  if (!place) return place.error();
  config::Site site;
  site.name = csv_text(input, row, "place");
  site.position = {place->latitude, place->longitude, place->height};
  const auto zone = astro::Zone::find(csv_text(input, row, "zone"));
  if (!zone) return wrong("zone", zone.error());
  const auto date = config::parse_date(csv_text(input, row, "local_date"));
  if (!date)
    return csv_error(input, row, "local_date", "local_date: " + date.error().message,
                     date.error().hint);
  const auto day = zone->civil_day(*date);
  if (!day) return wrong("local_date", day.error());
  return row_of(site, *zone, day_events(ephemeris, site.position, *day));
}

Result<Table, Diagnostics> batch(const std::string& file) {
  const auto input = read_csv(file);
  if (!input) return Diagnostics{input.error()};
  const Status complete =
      require_columns(*input, {"place", "lat_deg", "lon_deg", "height_m", "zone", "local_date"});
  if (!complete) return Diagnostics{complete.error()};
  const astro::Ephemeris ephemeris;
  auto rows = convert_rows<std::vector<Cell>>(
      *input, [&](size_t row) { return batch_row(*input, row, ephemeris); });
  if (!rows) return rows.error();
  return Table{columns(), *std::move(rows)};
}

/// For reading: one event a line, with local times.
std::string readable(const Table& table, const astro::Zone& zone) {
  std::string text;
  for (const auto& row : table.rows) {
    text += fmt::format("{}  {} h  {}\n", row[5].text, row[8].text, zone.name());
    for (size_t c = 9; c < row.size(); ++c) {
      std::string value = row[c].text;
      if (const auto instant = astro::parse_instant(value.substr(0, value.find(';'))); instant)
        value += "  " + format_local(zone.to_local(*instant));
      text += fmt::format("  {:<18} {}\n", table.columns[c], value);
    }
  }
  return text;
}

ExitCode run_events(const EventArguments& arguments, const ConsoleOptions& console) {
  auto format = table_format_from_name(arguments.format);
  if (!format) return report(format.error());
  if (console.json) format = TableFormat::json;
  if (!arguments.batch.empty()) {
    const auto table = batch(arguments.batch);
    if (!table) return report(table.error());
    print(format_table(*table, console.json ? TableFormat::json : TableFormat::csv));
    return ExitCode::done;
  }
  if (arguments.at.empty() || arguments.zone.empty() || arguments.date.empty())
    return report(option_error("events", "needs --at, --zone and --date, or --batch",
                               "see skylapse events --help"));
  const auto table = one_place(arguments);
  if (!table) return report(table.error());
  print(*format == TableFormat::table ? readable(*table, *parse_zone(arguments.zone))
                                      : format_table(*table, *format));
  return ExitCode::done;
}

}  // namespace

void add_events_command(CLI::App& app, Session& session) {
  auto* command = add_command(
      app, session, "events", "Rise, set, noon and twilights of local days",
      "skylapse events --at 50.0755,14.4378,235 --zone Europe/Prague --date 2026-06-21 --days 7"
      " --format csv");
  auto arguments = std::make_shared<EventArguments>();
  command->add_option("--at", arguments->at, "Place as LAT,LON[,HEIGHT] (degrees, metres)");
  command->add_option("--zone", arguments->zone, "Zone whose days are meant (IANA name)");
  command->add_option("--date", arguments->date, "First day, as 2026-06-21");
  command->add_option("--days", arguments->days, "Number of days (default 1)");
  command->add_option("--format", arguments->format, "table (default), csv, json");
  command->add_option(
      "--batch", arguments->batch,
      "CSV with place,lat_deg,lon_deg,height_m,zone,local_date; - is standard input");
  command->callback([&session, arguments] {
    session.action = [&session, arguments] { return run_events(*arguments, session.console); };
  });
}

}  // namespace skylapse::cli
