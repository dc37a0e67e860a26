#include "study/honesty.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>
#include <random>

#include "astro/ephemeris/ephemeris.h"
#include "pipeline/frame_sky.h"
#include "plan/accuracy_choice.h"
#include "plan/plan.h"
#include "sky/bruneton/twin.h"
#include "sky/monte_carlo/reference.h"

namespace skylapse::study {
namespace {

constexpr int kTruthBands = 32, kTruthNodes = 64;
/// Pixels of the horizon are means over their height: no single direction answers for them.
constexpr double kFromHorizon = 2.5;

class Draw {
 public:
  explicit Draw(uint64_t seed) : random_(seed) { random_.discard(16); }
  double share() { return double(random_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * share(); }

 private:
  std::mt19937_64 random_;
};

struct PlaceAndTime {
  double latitude_deg = 0;
  astro::Instant instant;
};

/// A place on the meridian of Greenwich and a minute of 2026 at which the sun stands about as high
/// as the scene has it.
PlaceAndTime place_of(const AccuracyScene& scene, Draw& draw) {
  const astro::Ephemeris ephemeris;
  const double wanted = scene.sun_elevation.in(deg);
  while (true) {
    PlaceAndTime best;
    best.latitude_deg = draw.between(-60, 60);
    const auto day = astro::parse_instant("2026-01-01T00:00:00Z").value() +
                     std::floor(draw.between(0, 365)) * 86400.0 * second;
    const astro::GeodeticPosition site{best.latitude_deg * deg, 0 * deg, scene.height};
    double off = 1;
    for (int minute = 0; minute < 1440; minute += 2) {
      const auto at = day + minute * 60.0 * second;
      const double el = elevation(ephemeris.sky_state(at, site, {}).sun_apparent).in(deg);
      if (std::abs(el - wanted) < off) off = std::abs(el - wanted), best.instant = at;
    }
    if (off < 1) return best;
  }
}

std::string camera_text(const AccuracyScene& scene, Draw& draw) {
  const double kind = draw.share(), azimuth = draw.between(0, 360), fov = draw.between(30, 100);
  const double height = draw.between(-5, 60);
  if (kind < 0.35) return "{projection: lat-long, size: 640x320}";
  if (kind < 0.6 && scene.height < 20.0 * km)
    return "{projection: fisheye-equidistant, look_at: zenith, fov: 180 deg, size: 320x320}";
  // From above the camera looks at its horizon, far below.
  const double up = scene.height < 20.0 * km ? height : scene.height < 100.0 * km ? 0 : -18;
  return fmt::format(
      "{{projection: perspective, look_at: {{azimuth: {:.1f} deg, elevation: {:.1f} deg}}, "
      "fov: {:.1f} deg, size: 480x320}}",
      azimuth, up, fov);
}

}  // namespace

HonestyJob draw_honesty_job(uint64_t seed, int index) {
  HonestyJob job;
  job.scene = draw_scene(seed, index);
  Draw draw(seed * 7'919 + uint64_t(index));
  job.accuracy = 0.01 * std::pow(30, draw.share());
  const bool plain = draw.share() < 0.5;
  const PlaceAndTime place = place_of(job.scene, draw);
  const auto& air = job.scene.air;
  std::string rest;
  if (!plain)
    rest = fmt::format(
        ", ozone: {:.0f} DU, aerosol: {{g: {:.3f}, single_scattering_albedo: {:.3f}, "
        "angstrom_exponent: {:.2f}}}",
        air.ozone_du, air.aerosol_g, air.aerosol_single_scattering_albedo, air.angstrom_exponent);
  job.config = fmt::format(
      "location: {{latitude: {:.4f} deg, longitude: 0 deg, height: {:.1f} m}}\n"
      "time: {{at: [\"{}\"]}}\n"
      "air: {{aerosol_optical_depth: {:.4f}, ground_albedo: {:.3f}{}}}\n"
      "sky: {{accuracy: {:.3f} %}}\ncamera: {}\noutputs: [{{image: sky.exr}}]\n",
      place.latitude_deg, job.scene.height.in(metre), format_utc(place.instant),
      air.aerosol_optical_depth, job.scene.ground_albedo, rest, 100 * job.accuracy,
      camera_text(job.scene, draw));
  return job;
}

namespace {

struct Pixel {
  int x = 0, y = 0;
  Direction<Enu> toward;
};

/// Pixels of the sky, evenly over its solid angle.
std::vector<Pixel> pixels_of(const image::Camera& camera, const plan::Frame& frame,
                             const sky::atmosphere::AirDescription& air, int count) {
  // Above the air there is nothing to see from outside it.
  const double grazing =
      (air.planet_radius + air.top_height) / (air.planet_radius + frame.camera_height);
  const Angle highest = grazing < 1 ? -std::acos(grazing) * rad : 90 * deg;
  struct Weighed {
    Pixel pixel;
    double until;
  };
  std::vector<Weighed> sky;
  double all = 0;
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const auto toward = image::direction_at(camera, {x + 0.5, y + 0.5});
      if (!toward) continue;
      const double solid_angle = pixel_solid_angle(camera, x, y).in(sr);
      const Angle side = std::sqrt(solid_angle) * rad;
      const Angle row = camera.projection == image::Projection::lat_long
                            ? 180 * deg / double(camera.height)
                            : side;
      if (elevation(*toward) < frame.horizon + kFromHorizon * std::max(row, side)) continue;
      if (elevation(*toward) > highest) continue;
      if (separation(*toward, frame.sun.direction) < 0.5 * deg + side) continue;
      sky.push_back({{x, y, *toward}, all += solid_angle});
    }
  std::vector<Pixel> chosen;
  size_t next = 0;
  for (int i = 0; i < count && !sky.empty(); ++i) {
    while (sky[next].until < all * (i + 0.5) / count) ++next;
    chosen.push_back(sky[next].pixel);
  }
  return chosen;
}

glm::dvec3 xyz_of(const sky::atmosphere::Medium& medium, const std::vector<double>& a,
                  const std::vector<double>& b) {
  glm::dvec3 xyz(0);
  for (size_t i = 0; i < a.size(); ++i) xyz += (a[i] + b[i]) * medium.bands[i].xyz_weight;
  return xyz;
}

/// The light of a direction at 1 au, twice: the first order integrated, the rest of other paths.
class Truth {
 public:
  Truth(const config::JobConfig& job, const plan::Plan& plan, const plan::Frame& frame)
      : frame_(frame), medium_(medium_in_full(job, plan, frame)), exact_(bare(medium_)) {}

  [[nodiscard]] std::array<glm::dvec3, 2> operator()(const Direction<Enu>& toward, long paths,
                                                     uint64_t seed) const {
    const sky::bruneton::Query query{
        frame_.camera_height, 90 * deg - elevation(frame_.sun.direction),
        90 * deg - elevation(toward), azimuth(toward) - azimuth(frame_.sun.direction)};
    const auto first =
        exact_.answer(query, {.samples = kTruthNodes, .multiple_scattering = false}).radiance;
    std::array<glm::dvec3, 2> halves;
    for (const uint64_t half : {0, 1}) {
      const auto rest = sky::monte_carlo::reference_answer(
          medium_, query, {.samples = paths, .seed = 2 * seed + half, .min_order = 2});
      halves[half] = xyz_of(medium_, first, rest.radiance);
    }
    return halves;
  }

 private:
  /// In many bands, with all that effects may have left out.
  static sky::atmosphere::Medium medium_in_full(config::JobConfig job, const plan::Plan& plan,
                                                const plan::Frame& frame) {
    job.sky.wavelengths = kTruthBands;
    plan::AirTimeline air = plan.air;
    air.ozone = air.aerosol = true;
    return plan::medium_of_frame(job, air, frame).value();
  }
  static std::shared_ptr<const sky::bruneton::Tables> bare(const sky::atmosphere::Medium& medium) {
    sky::bruneton::Tables tables;
    tables.medium = medium;
    return std::make_shared<const sky::bruneton::Tables>(std::move(tables));
  }

  const plan::Frame& frame_;
  sky::atmosphere::Medium medium_;
  sky::bruneton::Twin exact_;
};

/// Renders the picture in XYZ and tells the core seconds it took.
Result<double> render(const plan::Plan& plan, const image::Camera& camera, gpu::Backend backend,
                      image::FrameBuffer& out) {
  const std::clock_t start = std::clock();
  pipeline::AtmosphereService service(plan, backend, {}, sky::bruneton::TableCache(""));
  const auto sky = pipeline::sky_of(plan, plan.frames.front(), service);
  if (!sky) return sky.error();
  const Status filled = sky->fill(camera, glm::dmat3(1.0), 0, out);
  if (!filled) return filled.error();
  return double(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Paths (for each half) that make the noise of the mean square a third of the promise's square.
long paths_for(const plan::Plan& plan, const HonestyJob& job, const HonestyOptions& options) {
  plan::PictureScene scene;
  const plan::Frame& frame = plan.frames.front();
  scene.features = {
      elevation(frame.sun.direction),      -frame.horizon,          frame.camera_height,
      job.scene.air.aerosol_optical_depth, job.scene.ground_albedo, job.scene.air.ozone_du};
  scene.shares.fill(1.0 / plan::kSkyParts);
  const double deviation = plan::path_outlook(scene).deviation;
  const double wanted = 3 * std::pow(deviation / job.accuracy, 2) / std::sqrt(options.pixels);
  return std::clamp(long(wanted), 500L, options.most_paths / 2);
}

void measure(const HonestyJob& job, const plan::Plan& plan, const image::FrameBuffer& picture,
             uint64_t seed, const HonestyOptions& options, HonestyResult& result) {
  const plan::Frame& frame = plan.frames.front();
  const Truth truth(plan.job, plan, frame);
  const long paths = paths_for(plan, job, options);
  double sum = 0, squares = 0, n = 0;
  for (const Pixel& pixel : pixels_of(plan.job.cameras.front().camera, frame,
                                      plan.job.air.description, options.pixels)) {
    const auto halves = truth(pixel.toward, paths, seed * 100'003 + uint64_t(n));
    const float* p = picture.pixel(pixel.x, pixel.y);
    const glm::dvec3 xyz = glm::dvec3(p[0], p[1], p[2]) / frame.sun.distance_factor;
    const glm::dvec3 middle = 0.5 * (halves[0] + halves[1]);
    const double square = glm::dot(xyz - halves[0], xyz - halves[1]) / glm::dot(middle, middle);
    sum += square, squares += square * square, n += 1;
  }
  if (n < 2) {
    result.refused = "no pixel of the sky stands clear of the horizon";
    return;
  }
  const double mean = sum / n,
               spread = std::sqrt(std::max(0.0, squares / n - mean * mean) / (n - 1));
  result.measured = std::sqrt(std::max(0.0, mean));
  result.uncertainty = std::min(std::sqrt(spread), spread / (2 * std::max(result.measured, 1e-9)));
}

}  // namespace

Result<HonestyResult> measure_honesty(const HonestyJob& job, uint64_t seed,
                                      const HonestyOptions& options) {
  auto config = config::parse_job(job.config, "honesty.yaml");
  if (!config) return config.error().front();
  const auto planned = plan::make_plan(*config);
  HonestyResult result;
  if (!planned) {
    result.refused = planned.error().front().message;
    return result;
  }
  const plan::Promise& promise = *planned->promise;
  const image::Camera& camera = planned->job.cameras.front().camera;
  result.taken = promise.taken.name;
  result.bound = promise.taken.error;
  result.predicted_s = promise.taken.core_seconds;
  const auto best = std::ranges::min_element(promise.ladder, {}, &plan::Outlook::error);
  result.best_predicted_s = best->core_seconds;
  image::FrameBuffer picture(camera.width, camera.height);
  const auto seconds = render(*planned, camera, options.backend, picture);
  if (!seconds) return seconds.error();
  result.measured_s = *seconds;
  measure(job, *planned, picture, seed, options, result);
  if (!options.time_best) return result;
  config->sky.accuracy = {};
  plan::take(plan::ladder().back(), config->sky);
  const auto finest = plan::make_plan(*config);
  if (!finest) return finest.error().front();
  const auto best_seconds = render(*finest, camera, options.backend, picture);
  if (!best_seconds) return best_seconds.error();
  result.best_measured_s = *best_seconds;
  return result;
}

}  // namespace skylapse::study
