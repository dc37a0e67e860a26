#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "astro/ephemeris/ephemeris.h"
#include "astro/time/zone.h"
#include "cli/commands.h"
#include "core/parallel.h"
#include "core/version.h"
#include "gpu/context.h"
#include "gpu/self_test.h"
#include "output/atomic_file.h"
#include "output/image_writer.h"
#include "output/movie_writer.h"
#include "sky/hosek_wilkie/probe.h"

namespace skylapse::cli {
namespace {

struct Finding {
  std::string name;
  bool ok = false;
  std::string text;
};

/// The reference implementation's radiance at T 2, albedo 0, sun at 30 deg, in the zenith.
Finding check_sky() {
  sky::hosek_wilkie::ProbeQuery query;
  query.band = "560";
  query.turbidity = 2;
  query.sun_elevation = 30 * deg;
  query.view_zenith = 0 * deg;
  query.gamma = 60 * deg;
  const auto radiance = sky::hosek_wilkie::probe(query);
  if (!radiance) return {"sky model", false, radiance.error().message};
  const bool sane = *radiance > 0.005 && *radiance < 0.2;
  return {"sky model", sane,
          fmt::format("hosek-wilkie answers: {:.6f} W m^-2 sr^-1 nm^-1 in the zenith at 560 nm",
                      *radiance)};
}

/// The example of the NREL SPA report (Reda and Andreas 2004, table A5.1).
Finding check_sun() {
  const auto instant = astro::parse_instant("2003-10-17T19:30:30Z");
  const astro::Ephemeris ephemeris({.tt_minus_ut1 = 67 * second});
  const auto sky = ephemeris.sky_state(
      *instant, {39.742476 * deg, -105.1786 * deg, 1830.14 * metre}, {true, 820 * hPa, 11 * degC});
  const double zenith = 90 - elevation(sky.sun_apparent).in(deg);
  const bool ok = std::abs(zenith - 50.11162) < 0.0003;
  return {"sun position", ok,
          fmt::format("zenith angle {:.5f} deg where the SPA report prints 50.11162", zenith)};
}

Finding check_zones() {
  const auto zone = astro::Zone::find("Europe/Prague");
  if (!zone) return {"time zones", false, zone.error().message + "; " + zone.error().hint};
  const auto summer = zone->to_local(*astro::parse_instant("2050-07-01T12:00Z"));
  const bool ok = summer.utc_offset == std::chrono::hours(2);
  return {"time zones", ok,
          ok ? "zone files found, their rules continue after the last transition"
             : "summer time after 2037 is missing: update tzdata"};
}

Finding check_images() {
  const auto io = output::open_image_io();
  if (!io) return {"images", false, io.error().message + "; " + io.error().hint};
  const std::vector<float> grey(3 * 4 * 2, 0.5f);
  output::EncodeRequest request{
      .format = "exr", .width = 4, .height = 2, .pixels = grey.data(), .attributes = {}};
  const auto bytes = (*io)->encode(request);
  return {"images", bool(bytes), bytes ? (*io)->versions() : bytes.error().message};
}

Finding check_colour() {
  const auto io = output::open_image_io();
  if (!io) return {"colour", false, io.error().message};
  const char* file = std::getenv("OCIO");
  const std::string config = file != nullptr ? file : "";
  const auto views = (*io)->views(config);
  if (!views) return {"colour", false, views.error().message};
  return {"colour", true,
          fmt::format("{}: {}", config.empty() ? "built-in ACES config" : config,
                      fmt::join(*views, ", "))};
}

Finding check_movies() {
  const auto version = output::ffmpeg_version();
  return {"movies", bool(version),
          version ? *version : version.error().message + "; " + version.error().hint};
}

Finding check_temporary_files() {
  const auto file = std::filesystem::temp_directory_path() /
                    fmt::format("skylapse-doctor-{}", std::hash<std::string>{}(kSourceHash));
  const std::string text = "self-test";
  const Status written =
      output::write_file_atomically(file, std::as_bytes(std::span(text.data(), text.size())));
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
  return {"files", bool(written),
          written ? "written whole and by rename" : written.error().message};
}

/// What `--backend NAME` would take, why it passed over others, and whether it computes.
Finding check_gl(const char* name, gpu::Backend backend) {
  const auto context = gpu::Context::create(backend);
  if (!context) return {name, false, context.error().message + "; " + context.error().hint};
  const gpu::ContextInfo& info = (*context)->info();
  std::string text =
      fmt::format("{}: {}, {}, OpenGL {}", info.backend, info.renderer, info.vendor, info.version);
  const Status computes = gpu::self_test(**context);
  text += computes ? "; computes" : "; " + computes.error().message;
  for (const gpu::Attempt& attempt : info.attempts)
    if (!attempt.reason.empty())
      text += fmt::format("; passed over {}: {}", attempt.what, attempt.reason);
  return {name, computes.ok(), text};
}

/// Either backend will do.
Finding check_any_gl(const Finding& egl, const Finding& osmesa) {
  const char* text = egl.ok      ? "--backend auto takes EGL"
                     : osmesa.ok ? "--backend auto takes OSMesa"
                                 : "only models that run on the CPU can be rendered";
  return {"OpenGL", egl.ok || osmesa.ok, text};
}

ExitCode run_doctor(const ConsoleOptions& console) {
  const Finding egl = check_gl("OpenGL/egl", gpu::Backend::egl);
  const Finding osmesa = check_gl("OpenGL/osmesa", gpu::Backend::osmesa);
  const std::vector<Finding> findings{
      {"program", true, fmt::format("skylapse {} (source {:.12})", kVersion, kSourceHash)},
      {"cores", true, fmt::format("{}", available_cores())},
      check_sun(),
      check_sky(),
      check_zones(),
      check_images(),
      check_colour(),
      check_movies(),
      check_temporary_files(),
      egl,
      osmesa,
      check_any_gl(egl, osmesa)};
  bool healthy = true;
  auto json = nlohmann::ordered_json::array();
  for (const Finding& finding : findings) {
    const bool one_of_two = finding.name.starts_with("OpenGL/");
    healthy = healthy && (finding.ok || one_of_two);
    if (console.json)
      json.push_back({{"check", finding.name}, {"ok", finding.ok}, {"text", finding.text}});
    else
      print(fmt::format("{:<5} {:<13} {}\n",
                        finding.ok   ? "ok"
                        : one_of_two ? "none"
                                     : "FAIL",
                        finding.name, finding.text));
  }
  if (console.json) print(json_text(json));
  return healthy ? ExitCode::done : ExitCode::missing_backend;
}

}  // namespace

void add_doctor_command(CLI::App& app, Session& session) {
  auto* command = add_command(app, session, "doctor",
                              "What works on this machine, with a self-test", "skylapse doctor");
  command->callback(
      [&session] { session.action = [&session] { return run_doctor(session.console); }; });
}

}  // namespace skylapse::cli
