#include "effects/drawn_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "astro/ephemeris/ephemeris.h"

namespace skylapse::effects_proof {
namespace {

/// splitmix64 (Steele, Lea and Flood 2014): the standard library's distributions differ between
/// libraries.
class Draw {
 public:
  explicit Draw(uint64_t seed) : state_(seed) {}

  double uniform(double low, double high) {
    state_ += 0x9E3779B97F4A7C15;
    uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    z ^= z >> 31;
    return low + (high - low) * double(z >> 11) * 0x1p-53;
  }
  double logarithmic(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  bool chance(double share) { return uniform(0, 1) < share; }
  template <class T, size_t N>
  T one_of(const T (&items)[N]) {
    return items[size_t(uniform(0, double(N)))];
  }

 private:
  uint64_t state_;
};

struct Place {
  double latitude, longitude;  // deg
};

/// Where the sun stands at that elevation at that instant: on a circle about the point below it.
Place place_with_sun(const astro::Instant& instant, double elevation_deg, double bearing_deg) {
  const astro::Ephemeris ephemeris(astro::EphemerisOptions{});
  const auto sky = ephemeris.sky_state(instant, {}, {});
  // At latitude and longitude 0, east, north and up are the axes Y, Z and X of the Earth.
  const glm::dvec3 sun(sky.sun_true.z(), sky.sun_true.x(), sky.sun_true.y());
  const glm::dvec3 side = glm::normalize(glm::cross(sun, glm::dvec3(0.1, 0.2, 1)));
  const glm::dvec3 up = glm::cross(side, sun);
  const Angle away = (90 - elevation_deg) * deg, bearing = bearing_deg * deg;
  const glm::dvec3 p = sun * cos(away) + (side * cos(bearing) + up * sin(bearing)) * sin(away);
  constexpr double kDeg = 180 / std::numbers::pi;
  return {std::asin(std::clamp(p.z, -1.0, 1.0)) * kDeg, std::atan2(p.y, p.x) * kDeg};
}

double drawn_elevation(Draw& draw) {
  if (draw.chance(0.35)) return draw.uniform(-3, 8);
  return draw.uniform(-18, 90);
}

double drawn_height_m(Draw& draw) {
  const double kind = draw.uniform(0, 1);
  if (kind < 0.35) return 0;
  if (kind < 0.45) return draw.uniform(0.5, 3);
  if (kind < 0.60) return draw.uniform(3, 900);
  if (kind < 0.75) return draw.uniform(1e3, 12e3);
  if (kind < 0.85) return draw.uniform(12e3, 90e3);
  if (kind < 0.95) return draw.uniform(100e3, 400e3);
  return 36e6;
}

std::string drawn_air(Draw& draw) {
  std::string air;
  if (draw.chance(0.5))
    air = fmt::format("turbidity: {:.3f}", draw.uniform(1, 10));
  else
    air = fmt::format("aerosol_optical_depth: {:.7f}",
                      draw.chance(0.3) ? 0 : draw.logarithmic(1e-6, 3));
  if (draw.chance(0.35)) {
    const char* pressures[] = {"0", "0.01", "6", "300", "1013", "3000"};
    air += fmt::format(", surface_pressure: {} hPa", draw.one_of(pressures));
  }
  if (draw.chance(0.5)) {
    const char* columns[] = {"0", "0.01", "1", "100", "300", "500"};
    air += fmt::format(", ozone: {} DU", draw.one_of(columns));
  }
  const char* grounds[] = {"0", "1", "0.2", "0.5", "grass", "snow"};
  air += fmt::format(", ground_albedo: {}", draw.one_of(grounds));
  if (draw.chance(0.15)) air += ", refraction: off";
  if (draw.chance(0.3))
    air += fmt::format(", pressure: {:.0f} hPa, temperature: {:.0f} degC", draw.uniform(0, 1085),
                       draw.uniform(-60, 50));
  return air;
}

std::string drawn_camera(Draw& draw, double sun_azimuth, double sun_elevation, int largest) {
  const int width = int(draw.uniform(8, largest + 1)), height = int(draw.uniform(8, largest + 1));
  const double kind = draw.uniform(0, 1);
  if (kind < 0.15) return fmt::format("projection: lat-long, size: {}x{}", 2 * height, height);
  if (kind < 0.25) {
    const int side = std::max(4, largest / 4);
    return fmt::format("projection: cube, size: {}", side);
  }
  const bool at_sun = draw.chance(0.4);
  const double azimuth = at_sun ? sun_azimuth + draw.uniform(-3, 3) : draw.uniform(0, 360);
  const double elevation =
      std::clamp(at_sun ? sun_elevation + draw.uniform(-3, 3) : draw.uniform(-90, 90), -90., 90.);
  std::string look = fmt::format("look_at: {{azimuth: {:.3f} deg, elevation: {:.3f} deg}}",
                                 std::fmod(azimuth + 360, 360), elevation);
  if (draw.chance(0.2))
    look.insert(look.size() - 1, fmt::format(", roll: {:.1f} deg", draw.uniform(-90, 90)));
  if (kind < 0.65) {
    const double fov = draw.chance(0.25) ? draw.logarithmic(0.2, 10) : draw.uniform(10, 130);
    return fmt::format("projection: perspective, {}, fov: {:.3f} deg, size: {}x{}", look, fov,
                       width, height);
  }
  const char* fisheyes[] = {"fisheye-equidistant", "fisheye-equisolid", "fisheye-stereographic"};
  return fmt::format("projection: {}, {}, fov: {:.1f} deg, size: {}x{}", draw.one_of(fisheyes),
                     look, draw.uniform(30, 220), height, height);
}

std::string drawn_exposure(Draw& draw) {
  const double compensation = draw.chance(0.5) ? 0 : draw.uniform(-3, 3);
  const double kind = draw.uniform(0, 1);
  if (kind < 0.25)
    return fmt::format("mode: fixed, ev: {:.2f}, compensation: {:.2f} stops", draw.uniform(-3, 16),
                       compensation);
  return fmt::format("mode: {}, compensation: {:.2f} stops", kind < 0.85 ? "sun-curve" : "metered",
                     compensation);
}

}  // namespace

std::string drawn_scene(uint64_t seed, int number, const Fineness& fineness) {
  Draw draw(seed * 1'000'003 + uint64_t(number) * 7919);
  const int day = int(draw.uniform(0, 365)), minute = int(draw.uniform(0, 1440));
  const astro::Instant instant{std::chrono::sys_days(std::chrono::year(2026) / 1 / 1) +
                               std::chrono::days(day) + std::chrono::minutes(minute)};
  Place place = place_with_sun(instant, drawn_elevation(draw), draw.uniform(0, 360));
  if (draw.chance(0.06)) place = {draw.chance(0.5) ? 90.0 : -90.0, draw.uniform(-180, 180)};
  const double height = drawn_height_m(draw);
  const astro::Ephemeris ephemeris(astro::EphemerisOptions{});
  const auto sky = ephemeris.sky_state(
      instant, {place.latitude * deg, place.longitude * deg, height * metre}, {});
  const std::string air = drawn_air(draw);
  const std::string camera =
      drawn_camera(draw, azimuth(sky.sun_apparent).in(deg), elevation(sky.sun_apparent).in(deg),
                   fineness.largest_side);
  const bool single = draw.chance(0.1);
  const auto date = std::chrono::year_month_day(
      std::chrono::sys_days(std::chrono::year(2026) / 1 / 1) + std::chrono::days(day));
  return fmt::format(
      "location: {{name: drawn, latitude: {:.6f}, longitude: {:.6f}, height: {:.2f} m}}\n"
      "time: {{zone: UTC, at: [{:04}-{:02}-{:02}T{:02}:{:02}Z]}}\n"
      "air: {{{}}}\n"
      "sky: {{model: {}, effects: @{}}}\n"
      "camera: {{{}}}\n"
      "exposure: {{{}}}\n"
      "outputs: [{{image: drawn.png}}]\n",
      place.latitude, place.longitude, height, int(date.year()), unsigned(date.month()),
      unsigned(date.day()), minute / 60, minute % 60, air,
      single ? "single-scattering" : "auto, level: " + fineness.level,
      fineness.more.empty() ? "" : ", " + fineness.more, camera, drawn_exposure(draw));
}

}  // namespace skylapse::effects_proof
