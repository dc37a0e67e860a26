#pragma once
// Values of the command line in the product's own types; errors name the option.
#include <CLI/CLI.hpp>
#include <chrono>
#include <string>

#include "astro/time/zone.h"
#include "config/job_config.h"
#include "gpu/context.h"

namespace skylapse::cli {

/// "LAT,LON" or "LAT,LON,HEIGHT": degrees or any spelling a config allows; height in metres or
/// with a unit.
Result<config::Site> parse_place(const std::string& text);

/// The zone of --zone.
Result<astro::Zone> parse_zone(const std::string& name);

/// A time as in a config ("2026-06-21T04:30Z", "2026-06-21 sunrise - 45 min"). A clock time
/// without an offset is read in `zone_name`; with neither it is an error.
Result<astro::Instant> parse_time(const std::string& option, const std::string& text,
                                  const std::string& zone_name, const config::Site& site);

/// "2 min": positive.
Result<Duration> parse_step(const std::string& option, const std::string& text);

Result<std::chrono::year_month_day> parse_day(const std::string& option, const std::string& text);

/// "auto", "egl", "osmesa".
Result<gpu::Backend> parse_backend(const std::string& name);
void add_backend_option(CLI::App& command, std::string& name);

/// An error that says which option is meant.
Error option_error(const std::string& option, const std::string& message, const std::string& hint);

}  // namespace skylapse::cli
