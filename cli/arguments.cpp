#include "cli/arguments.h"

#include <fmt/format.h>

#include "config/quantity_parser.h"
#include "config/time_expression.h"
#include "plan/frame_schedule.h"

namespace skylapse::cli {
namespace {

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

Error of_problem(const std::string& option, const config::Problem& problem) {
  return option_error(option, problem.message, problem.hint);
}

Error out_of_range(const std::string& value, const std::string& allowed) {
  return option_error("--at", value + " is out of range", "allowed: " + allowed);
}

}  // namespace

Result<gpu::Backend> parse_backend(const std::string& name) {
  if (name == "auto") return gpu::Backend::automatic;
  if (name == "egl") return gpu::Backend::egl;
  if (name == "osmesa") return gpu::Backend::osmesa;
  return option_error("--backend", fmt::format("'{}' is unknown", name),
                      "allowed: auto, egl, osmesa");
}

void add_backend_option(CLI::App& command, std::string& name) {
  command.add_option("--backend", name,
                     "OpenGL of the models that compute the atmosphere: auto, egl, osmesa");
}

Error option_error(const std::string& option, const std::string& message, const std::string& hint) {
  return {ErrorCode::invalid_input, option + ": " + message, {}, hint};
}

Result<config::Site> parse_place(const std::string& text) {
  const auto parts = split_at_commas(text);
  if (parts.size() < 2 || parts.size() > 3)
    return option_error("--at", fmt::format("'{}' is no place", text),
                        "write LAT,LON or LAT,LON,HEIGHT, for example 50.0755,14.4378,235");
  const auto latitude = config::parse_quantity(parts[0], config::Dimension::latitude);
  if (!latitude) return of_problem("--at", latitude.error());
  const auto longitude = config::parse_quantity(parts[1], config::Dimension::longitude);
  if (!longitude) return of_problem("--at", longitude.error());
  config::Site site;
  site.name = "here";
  site.position = {*latitude * rad, *longitude * rad, 0 * metre};
  if (parts.size() == 3) {
    const auto bare = config::parse_number(parts[2]);
    const auto height = bare ? Result<double, config::Problem>(*bare)
                             : config::parse_quantity(parts[2], config::Dimension::length);
    if (!height) return of_problem("--at", height.error());
    site.position.height = *height * metre;
  }
  if (abs(site.position.latitude) > 90.0000000001 * deg)
    return out_of_range("latitude " + parts[0], "-90 to 90 deg");
  if (site.position.longitude < -180.0000000001 * deg || site.position.longitude > 360 * deg)
    return out_of_range("longitude " + parts[1], "-180 to 360 deg");
  if (site.position.height < -500 * metre || site.position.height > 100 * km)
    return out_of_range("height " + parts[2], "-500 m to 100 km");
  return site;
}

Result<astro::Zone> parse_zone(const std::string& name) {
  auto zone = astro::Zone::find(name);
  if (zone) return zone;
  Error error = zone.error();
  error.message = "--zone: " + error.message;
  return error;
}

Result<astro::Instant> parse_time(const std::string& option, const std::string& text,
                                  const std::string& zone_name, const config::Site& site) {
  const auto expression = config::parse_time_expression(text);
  if (!expression) return of_problem(option, expression.error());
  if (!expression->date)
    return option_error(option, fmt::format("'{}' names no day", text),
                        "write for example 2026-06-21T04:30Z or 2026-06-21 sunrise");
  if (expression->clock && !expression->utc_offset && zone_name.empty())
    return option_error(option, fmt::format("'{}' has neither an offset nor a zone", text),
                        "end it with Z or +02:00, or give --zone, for example Europe/Prague");
  const auto zone = parse_zone(zone_name.empty() ? "UTC" : zone_name);
  if (!zone) return zone.error();
  auto instant = plan::resolve_time(*expression, *expression->date, site, *zone);
  if (instant) return instant;
  return option_error(option, instant.error().message, instant.error().hint);
}

Result<Duration> parse_step(const std::string& option, const std::string& text) {
  const auto seconds = config::parse_quantity(text, config::Dimension::duration);
  if (!seconds) return of_problem(option, seconds.error());
  if (!(*seconds >= 1e-3))
    return option_error(option, fmt::format("'{}' is no step", text), "allowed: 1 ms and more");
  return *seconds * second;
}

Result<std::chrono::year_month_day> parse_day(const std::string& option, const std::string& text) {
  const auto date = config::parse_date(text);
  if (!date) return of_problem(option, date.error());
  return *date;
}

}  // namespace skylapse::cli
