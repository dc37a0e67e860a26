#include <fmt/format.h>

#include <cmath>

#include "astro/ephemeris/ephemeris.h"
#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/csv.h"
#include "cli/table.h"

namespace skylapse::cli {
namespace {

struct SunArguments {
  std::string at, time, to, step, zone, batch;
  std::string algorithm = "erfa";
  std::string format = "table";
};

constexpr long kMaxRows = 10'000'000;

const std::vector<std::string> kColumns{"utc",
                                        "lat_deg",
                                        "lon_deg",
                                        "height_m",
                                        "sun_az_deg",
                                        "sun_el_true_deg",
                                        "sun_el_app_deg",
                                        "sun_dist_au",
                                        "sun_radius_deg",
                                        "sun_dec_deg",
                                        "moon_az_deg",
                                        "moon_el_true_deg",
                                        "moon_dist_km",
                                        "moon_radius_deg",
                                        "moon_illum",
                                        "moon_phase_deg"};

/// The apparent elevation is given where the refraction formula is valid (true elevation at
/// least -1 deg) and nan below.
double apparent_elevation_deg(const astro::SkyState& sky) {
  return elevation(sky.sun_true) < -1 * deg ? std::nan("") : elevation(sky.sun_apparent).in(deg);
}

std::vector<Cell> row_of(const std::string& utc, const astro::GeodeticPosition& place,
                         const astro::SkyState& sky) {
  return {text_cell(utc),
          number_cell(place.latitude.in(deg), 9),
          number_cell(place.longitude.in(deg), 9),
          number_cell(place.height.in(metre), 3),
          number_cell(azimuth(sky.sun_true).in(deg), 10),
          number_cell(elevation(sky.sun_true).in(deg), 10),
          number_cell(apparent_elevation_deg(sky), 10),
          number_cell(sky.sun_distance.in(astronomical_unit), 12),
          number_cell(sky.sun_radius.in(deg), 10),
          number_cell(sky.sun_declination.in(deg), 10),
          number_cell(azimuth(sky.moon_true).in(deg), 10),
          number_cell(elevation(sky.moon_true).in(deg), 10),
          number_cell(sky.moon_distance.in(km), 4),
          number_cell(sky.moon_radius.in(deg), 10),
          number_cell(sky.moon_illuminated_fraction, 9),
          number_cell(sky.moon_phase_angle.in(deg), 9)};
}

Result<Table> single_place(const SunArguments& arguments, astro::SunAlgorithm algorithm) {
  const auto site = parse_place(arguments.at);
  if (!site) return site.error();
  const auto from = parse_time("--time", arguments.time, arguments.zone, *site);
  if (!from) return from.error();
  Table table{kColumns, {}};
  const astro::Ephemeris ephemeris({.algorithm = algorithm});
  const auto add = [&](const astro::Instant& instant) {
    table.rows.push_back(
        row_of(format_utc(instant, instant.utc.time_since_epoch().count() % 1'000'000 ? 3 : 0),
               site->position, ephemeris.sky_state(instant, site->position, {})));
  };
  if (arguments.to.empty() != arguments.step.empty())
    return option_error(arguments.to.empty() ? "--step" : "--to", "stands alone",
                        "--to and --step make a table together");
  if (arguments.to.empty()) {
    add(*from);
    return table;
  }
  const auto to = parse_time("--to", arguments.to, arguments.zone, *site);
  if (!to) return to.error();
  const auto step = parse_step("--step", arguments.step);
  if (!step) return step.error();
  const double count = std::floor((*to - *from).in(second) / step->in(second) + 1e-9) + 1;
  if (count < 1) return option_error("--to", "lies before --time", "give a later time");
  if (count > double(kMaxRows))
    return option_error("--step", fmt::format("asks for {:.3g} rows", count),
                        fmt::format("allowed: at most {}", kMaxRows));
  for (long i = 0; i < long(count); ++i) add(*from + double(i) * *step);
  return table;
}

struct BatchRow {
  std::string utc;
  astro::Instant instant;
  astro::GeodeticPosition place;
  astro::RefractionConditions air;
  std::optional<double> tt_minus_ut1;
};

/// A finite number of an optional column, or the default.
Result<double> optional_number(const CsvTable& table, size_t row, const std::string& column,
                               double absent, double lowest, double highest) {
  const int c = table.column(column);
  if (c < 0 || table.rows[row][c].empty() || table.rows[row][c] == "-") return absent;
  return csv_number(table, row, column, lowest, highest);
}

/// Beyond any estimate of TT - UT1 in historical times (about 17 000 s in 500 BC; Espenak and
/// Meeus 2006).
constexpr double kMaxTtMinusUt1 = 1e5;

Result<BatchRow> read_row(const CsvTable& table, size_t row) {
  BatchRow out;
  out.utc = csv_text(table, row, "utc");
  const auto instant = astro::parse_instant(out.utc);
  if (!instant)
    return csv_error(table, row, "utc", "utc: " + instant.error().message, instant.error().hint);
  out.instant = *instant;
  const auto place = csv_place(table, row);
  if (!place) return place.error();
  out.place = {place->latitude, place->longitude, place->height};
  const auto pressure = optional_number(table, row, "pressure_hpa", 1010, 0, 2000);
  if (!pressure) return pressure.error();
  const auto temperature = optional_number(table, row, "temp_c", 10, -273, 100);
  if (!temperature) return temperature.error();
  out.air = {true, *pressure * hPa, *temperature * degC};
  const auto tt =
      optional_number(table, row, "tt_minus_ut1_s", std::nan(""), -kMaxTtMinusUt1, kMaxTtMinusUt1);
  if (!tt) return tt.error();
  if (!std::isnan(*tt)) out.tt_minus_ut1 = *tt;
  return out;
}

Result<Table, Diagnostics> batch(const std::string& file, astro::SunAlgorithm algorithm) {
  const auto input = read_csv(file);
  if (!input) return Diagnostics{input.error()};
  const Status complete = require_columns(*input, {"utc", "lat_deg", "lon_deg", "height_m"});
  if (!complete) return Diagnostics{complete.error()};
  const auto rows = convert_rows<BatchRow>(*input, [&](size_t i) { return read_row(*input, i); });
  if (!rows) return rows.error();
  Table table{kColumns, {}};
  std::optional<double> tt_in_use;
  astro::Ephemeris ephemeris({.algorithm = algorithm});
  for (const BatchRow& row : *rows) {
    if (row.tt_minus_ut1 != tt_in_use) {
      tt_in_use = row.tt_minus_ut1;
      astro::EphemerisOptions options{.algorithm = algorithm};
      if (tt_in_use) options.tt_minus_ut1 = *tt_in_use * second;
      ephemeris = astro::Ephemeris(options);
    }
    table.rows.push_back(
        row_of(row.utc, row.place, ephemeris.sky_state(row.instant, row.place, row.air)));
  }
  return table;
}

ExitCode run_sun(const SunArguments& arguments, const ConsoleOptions& console) {
  const auto algorithm = astro::sun_algorithm_from_name(arguments.algorithm);
  if (!algorithm)
    return report(option_error("--algorithm", fmt::format("'{}' is unknown", arguments.algorithm),
                               "allowed: erfa, sg2, preetham-atan2, preetham"));
  auto format = table_format_from_name(arguments.format);
  if (!format) return report(format.error());
  if (console.json) format = TableFormat::json;
  if (!arguments.batch.empty()) {
    const auto table = batch(arguments.batch, *algorithm);
    if (!table) return report(table.error());
    print(format_table(*table, console.json ? TableFormat::json : TableFormat::csv));
    return ExitCode::done;
  }
  if (arguments.at.empty() || arguments.time.empty())
    return report(
        option_error("sun", "needs --at and --time, or --batch", "see skylapse sun --help"));
  const auto table = single_place(arguments, *algorithm);
  if (!table) return report(table.error());
  print(format_table(*table, *format));
  return ExitCode::done;
}

}  // namespace

void add_sun_command(CLI::App& app, Session& session) {
  auto* command = add_command(
      app, session, "sun", "Where the sun and the moon stand",
      "skylapse sun --at 50.0755,14.4378,235 --time 2026-06-21T12:00 --zone Europe/Prague\n"
      "  skylapse sun --at 0,0 --time 2026-03-20T00:00Z --to 2026-03-21T00:00Z --step '10 min'"
      " --format csv");
  auto arguments = std::make_shared<SunArguments>();
  command->add_option("--at", arguments->at, "Place as LAT,LON[,HEIGHT] (degrees, metres)");
  command->add_option("--time", arguments->time, "Time: ISO 8601, or as '2026-06-21 sunrise'");
  command->add_option("--zone", arguments->zone, "Zone of times without an offset (IANA name)");
  command->add_option("--to", arguments->to, "Last time of a table");
  command->add_option("--step", arguments->step, "Step of a table, as '10 min'");
  command->add_option("--algorithm", arguments->algorithm,
                      "erfa (default), sg2, preetham-atan2, preetham");
  command->add_option("--format", arguments->format, "table (default), csv, json");
  command->add_option(
      "--batch", arguments->batch,
      "CSV with utc,lat_deg,lon_deg,height_m[,pressure_hpa,temp_c,tt_minus_ut1_s]; - is "
      "standard input");
  command->callback([&session, arguments] {
    session.action = [&session, arguments] { return run_sun(*arguments, session.console); };
  });
}

}  // namespace skylapse::cli
