#include "image/diff/sky_rows.h"

#include <algorithm>
#include <cmath>

namespace skylapse::image {
namespace {

constexpr double kZenithDeg = 60, kHorizonDeg = 5, kAureoleDeg = 15, kAntisolarDeg = 30;
constexpr double kRimPixels = 1.5;
/// Pixels whose directions are found together, an odd number, and how far their line may bend (as
/// an angle): a parabola through three is then within half a pixel of the others, which is where
/// the pixel still is (tested; the most at the edges of a cube's faces).
constexpr int kStretch = 9;
constexpr double kBend = 5e-3;

constexpr uint8_t bit(SkyRegion region) { return uint8_t(1U << unsigned(region)); }

/// Thresholds as cosines and sines, so that a pixel costs two dot products.
struct RegionTests {
  glm::dvec3 sun{0}, antisolar{0};
  bool has_sun = false;
  double sin_zenith, sin_horizon, cos_aureole, cos_antisolar;

  explicit RegionTests(const SkyView& view)
      : sin_zenith(sin(kZenithDeg * deg)),
        sin_horizon(sin(kHorizonDeg * deg)),
        cos_aureole(cos(kAureoleDeg * deg)),
        cos_antisolar(cos(kAntisolarDeg * deg)) {
    if (!view.sun) return;
    has_sun = true;
    sun = view.sun->vec();
    antisolar = {-sun.x, -sun.y, sun.z};
  }

  [[nodiscard]] uint8_t at(double east, double north, double up, double cos_disc) const {
    uint8_t bits = bit(up >= 0 ? SkyRegion::sky : SkyRegion::ground);
    if (up >= sin_zenith) bits |= bit(SkyRegion::zenith);
    if (std::fabs(up) <= sin_horizon) bits |= bit(SkyRegion::horizon);
    if (!has_sun) return bits;
    const double to_sun = east * sun.x + north * sun.y + up * sun.z;
    if (to_sun >= cos_disc)
      bits |= bit(SkyRegion::disc);
    else if (to_sun >= cos_aureole)
      bits |= bit(SkyRegion::aureole);
    const double across = east * antisolar.x + north * antisolar.y + up * antisolar.z;
    if (across >= cos_antisolar && up >= 0) bits |= bit(SkyRegion::antisolar);
    return bits;
  }
};

/// Cosine of the radius of the disc with its rim.
double disc_cosine(const SkyView& view, Angle pixel) {
  return cos(std::min(view.sun_radius + kRimPixels * pixel, 90 * deg));
}

}  // namespace

std::string_view name_of(SkyRegion region) {
  constexpr std::array<std::string_view, kSkyRegions> kNames{
      "sky", "ground", "zenith", "horizon", "disc", "aureole", "antisolar"};
  return kNames[size_t(region)];
}

std::string_view title_of(SkyRegion region) {
  constexpr std::array<std::string_view, kSkyRegions> kTitles{
      "sky", "ground", "zenith", "horizon ring", "sun's disc", "aureole", "anti-solar sky"};
  return kTitles[size_t(region)];
}

uint8_t regions_at(const glm::dvec3& direction, const SkyView& view, Angle pixel) {
  return RegionTests(view).at(direction.x, direction.y, direction.z, disc_cosine(view, pixel));
}

std::optional<SkyRegion> chief_region(uint8_t regions) {
  using enum SkyRegion;
  for (const SkyRegion region : {disc, aureole, horizon, zenith, antisolar, ground, sky})
    if (regions & bit(region)) return region;
  return {};
}

SkyRows::SkyRows(const SkyView& view) : view_(view) {
  const Camera& camera = *view_.camera;
  if (camera.projection != Projection::lat_long) {
    find_unit();
    return;
  }
  for (int x = 0; x < camera.width; ++x) {
    const auto level = *direction_at(camera, {x + 0.5, 0.5 * camera.height});
    const double length = std::hypot(level.x(), level.y());
    sin_azimuth_.push_back(float(level.x() / length));
    cos_azimuth_.push_back(float(level.y() / length));
  }
}

/// From the pixel nearest to the middle of the picture that is wholly inside it.
void SkyRows::find_unit() {
  const Camera& camera = *view_.camera;
  for (const double share : {0.5, 0.25, 0.375, 0.0}) {
    const int x = std::min(camera.width - 1, int(share * camera.width));
    const int y = std::min(camera.height - 1, int(share * camera.height));
    const auto d = direction_at(camera, {x + 0.5, y + 0.5});
    if (!d) continue;
    unit_ = pixel_solid_angle(camera, x, y).in(sr) / density(d->vec());
    if (unit_ > 0) return;
  }
}

/// Solid angle that a pixel covers at a direction, up to a factor that is the same for all.
double SkyRows::density(const glm::dvec3& enu) const {
  const glm::dvec3 d = glm::transpose(view_.camera->camera_to_enu) * enu;
  switch (view_.camera->projection) {
    case Projection::perspective:
      return d.z * d.z * d.z;
    case Projection::cube: {
      const double forward = std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)});
      return forward * forward * forward;
    }
    case Projection::fisheye_equidistant: {
      const double s = std::hypot(d.x, d.y), theta = std::atan2(s, d.z);
      return theta > 0 ? s / theta : 1;
    }
    case Projection::fisheye_stereographic:
      return 0.25 * (1 + d.z) * (1 + d.z);
    case Projection::lat_long:
    case Projection::fisheye_equisolid:
    case Projection::octahedral:
    case Projection::mirror_ball:
      break;
  }
  return 1;  // equal areas
}

void SkyRows::fill(int y, SkyRow& row) const {
  const Camera& camera = *view_.camera;
  const auto n = size_t(camera.width);
  for (auto* values : {&row.east, &row.north, &row.up, &row.solid_angle}) values->assign(n, 0);
  row.regions.assign(n, 0);
  if (camera.projection == Projection::lat_long) {
    fill_lat_long(y, row);
  } else {
    for (int x = 0; x < camera.width; x += kStretch)
      fill_stretch(y, x, std::min(x + kStretch, camera.width), row);
  }
  set_regions(row);
}

void SkyRows::set_pixel(size_t x, const glm::dvec3& d, SkyRow& row) const {
  row.east[x] = float(d.x), row.north[x] = float(d.y), row.up[x] = float(d.z);
  row.solid_angle[x] = float(unit_ * density(d));
}

/// Columns [begin, end): by a parabola through three of them where the picture is smooth, else (at
/// the edges of a cube's faces and of circles) one by one.
void SkyRows::fill_stretch(int y, int begin, int end, SkyRow& row) const {
  const Camera& camera = *view_.camera;
  const auto at = [&](int x) { return direction_at(camera, {x + 0.5, y + 0.5}); };
  const int last = end - 1, middle = (begin + last) / 2;
  const auto first = at(begin), centre = at(middle), final = at(last);
  const double half = middle - begin;
  const bool even = last - middle == middle - begin && half > 0;
  if (even && first && centre && final) {
    const glm::dvec3 slope = 0.5 * (final->vec() - first->vec());
    const glm::dvec3 bend = 0.5 * (final->vec() + first->vec()) - centre->vec();
    if (glm::dot(bend, bend) < kBend * kBend) {
      for (int x = begin; x < end; ++x) {
        const double s = (x - middle) / half;
        set_pixel(size_t(x), centre->vec() + s * (slope + s * bend), row);
      }
      return;
    }
  }
  for (int x = begin; x < end; ++x)
    if (const auto d = at(x)) set_pixel(size_t(x), d->vec(), row);
}

void SkyRows::fill_lat_long(int y, SkyRow& row) const {
  const Camera& camera = *view_.camera;
  const auto middle = *direction_at(camera, {0.5, y + 0.5});
  const auto level = float(std::hypot(middle.x(), middle.y())), up = float(middle.z());
  const auto omega = float(pixel_solid_angle(camera, 0, y).in(sr));
  for (size_t x = 0; x < sin_azimuth_.size(); ++x) {
    row.east[x] = level * sin_azimuth_[x], row.north[x] = level * cos_azimuth_[x];
    row.up[x] = up, row.solid_angle[x] = omega;
  }
}

void SkyRows::set_regions(SkyRow& row) const {
  const RegionTests tests(view_);
  float last = -1;
  double cos_disc = 1;
  for (size_t x = 0; x < row.regions.size(); ++x) {
    const float omega = row.solid_angle[x];
    if (omega <= 0) continue;
    if (omega != last) {
      last = omega;
      cos_disc = disc_cosine(view_, std::sqrt(double(omega)) * rad);
    }
    row.regions[x] = tests.at(row.east[x], row.north[x], row.up[x], cos_disc);
  }
}

}  // namespace skylapse::image
