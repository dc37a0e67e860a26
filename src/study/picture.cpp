#include "study/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "color/exposure.h"
#include "color/false_color.h"
#include "color/rgb_space.h"
#include "core/base64.h"
#include "core/constants.h"
#include "core/parallel.h"

namespace skylapse::study {
namespace {

constexpr int kSize = kThumbnailSize;
constexpr uint8_t kOutside = 128;

/// The direction of a pixel: equidistant from the zenith, its corners outside the sky.
std::optional<Direction<Enu>> direction_at(const SceneResult& scene, int x, int y) {
  const double dx = (x + 0.5) / kSize * 2 - 1, dy = 1 - (y + 0.5) / kSize * 2;
  const double radius = std::hypot(dx, dy);
  if (radius > 1) return {};
  const Angle zenith = radius * (90 * deg - scene.scene.geometry.horizon);
  // Looking up with the sun's azimuth at the top, clockwise azimuths run to the left.
  const Angle bearing = azimuth(scene.scene.geometry.sun) - atan2_angle(dx, dy);
  return enu_direction(bearing, 90 * deg - zenith);
}

/// Between the four nearest pixels of the study's map; not below the last row above the horizon.
glm::dvec3 lookup(const image::FrameBuffer& map, const image::Camera& camera,
                  const Direction<Enu>& toward, double last_row) {
  const auto at = *image::position_of(camera, toward);
  const double x = at.x - 0.5, y = std::clamp(at.y - 0.5, 0.0, last_row);
  const int x0 = int(std::floor(x)), y0 = int(y), w = map.width();
  const double fx = x - x0, fy = y - y0;
  const auto pixel = [&](int i, int j) {
    const float* p = map.pixel((i % w + w) % w, std::min(j, int(last_row)));
    return glm::dvec3(p[0], p[1], p[2]);
  };
  return (1 - fy) * ((1 - fx) * pixel(x0, y0) + fx * pixel(x0 + 1, y0)) +
         fy * ((1 - fx) * pixel(x0, y0 + 1) + fx * pixel(x0 + 1, y0 + 1));
}

glm::dmat3 to_xyz_of(const SceneResult&) { return color::rgb_to_xyz(color::RgbSpace::rec709); }

/// The most accurate rung with a large picture.
const Measurement* best_of(const SceneResult& scene) {
  const Measurement* best = nullptr;
  for (const Measurement& m : scene.rungs)
    if (m.skipped.empty() && m.picture.width() > 0 &&
        (best == nullptr || m.errors.sky().raw_rms < best->errors.sky().raw_rms))
      best = &m;
  return best;
}

/// Truth over rung at the study's directions, interpolated.
class Ratio {
 public:
  Ratio(const SceneResult& scene, const Measurement& rung) {
    const auto& points = scene.scene.points;
    const auto xyz = pixels_of(points, rung.picture, MapSize::large, to_xyz_of(scene));
    const auto directions = directions_of(points, scene.scene.geometry, MapSize::large);
    for (size_t i = 0; i < directions.size(); ++i) {
      const glm::dvec3 ratio = scene.scene.truth.radiance[i / 2].xyz / xyz[i];
      if (std::isfinite(ratio.x + ratio.y + ratio.z))
        nodes_.push_back({directions[i].toward.vec(), ratio});
    }
  }
  [[nodiscard]] glm::dvec3 at(const Direction<Enu>& toward) const {
    constexpr size_t kNearest = 6;
    std::array<std::pair<double, size_t>, kNearest> nearest;
    nearest.fill({HUGE_VAL, 0});
    for (size_t i = 0; i < nodes_.size(); ++i) {
      const glm::dvec3 d = nodes_[i].first - toward.vec();
      const double square = glm::dot(d, d);
      if (square >= nearest.back().first) continue;
      nearest.back() = {square, i};
      std::sort(nearest.begin(), nearest.end());
    }
    glm::dvec3 sum(0);
    double weights = 0;
    for (const auto& [square, i] : nearest) {
      if (!std::isfinite(square)) continue;
      const double w = 1 / (square + 1e-6);
      sum += w * nodes_[i].second, weights += w;
    }
    return weights > 0 ? sum / weights : glm::dvec3(1);
  }

 private:
  std::vector<std::pair<glm::dvec3, glm::dvec3>> nodes_;
};

template <class Value>
std::vector<glm::dvec3> each_pixel(const SceneResult& scene, const Value& value) {
  std::vector<glm::dvec3> xyz(size_t(kSize) * kSize, glm::dvec3(0));
  parallel_for_ranges(kSize, 4, [&](size_t begin, size_t end) {
    for (size_t y = begin; y < end; ++y)
      for (int x = 0; x < kSize; ++x)
        if (const auto toward = direction_at(scene, x, int(y))) xyz[y * kSize + x] = value(*toward);
  });
  return xyz;
}

/// The last row of the map that holds nothing but sky.
double last_sky_row(const SceneResult& scene) {
  const double rows = (90 * deg - scene.scene.geometry.horizon).in(deg) / 180 * kStudyHeight;
  return std::floor(rows + 1e-9) - 1;
}

}  // namespace

std::vector<glm::dvec3> rung_thumbnail(const SceneResult& scene, const Measurement& measured) {
  const image::Camera camera = study_camera(scene.scene.geometry.sun);
  const glm::dmat3 to_xyz = to_xyz_of(scene);
  const double last = last_sky_row(scene);
  return each_pixel(scene, [&](const Direction<Enu>& toward) {
    return to_xyz * lookup(measured.picture, camera, toward, last);
  });
}

std::vector<glm::dvec3> true_thumbnail(const SceneResult& scene) {
  const Measurement* best = best_of(scene);
  if (best == nullptr) return {};
  const Ratio ratio(scene, *best);
  const image::Camera camera = study_camera(scene.scene.geometry.sun);
  const glm::dmat3 to_xyz = to_xyz_of(scene);
  const double last = last_sky_row(scene);
  return each_pixel(scene, [&](const Direction<Enu>& toward) {
    return ratio.at(toward) * (to_xyz * lookup(best->picture, camera, toward, last));
  });
}

std::vector<uint8_t> shown(const std::vector<glm::dvec3>& xyz, double ev,
                           const output::DisplayTransform& display) {
  const double scale = color::exposure_scale_per_cd_m2(ev) * kLuminousEfficacy;
  const glm::dmat3& to_rgb = color::xyz_to_rgb(color::RgbSpace::rec709);
  std::vector<float> values;
  for (const glm::dvec3& v : xyz) {
    const glm::dvec3 rgb = to_rgb * v * scale;
    for (int c = 0; c < 3; ++c) values.push_back(float(rgb[c]));
  }
  display.apply(values.data(), xyz.size());
  std::vector<uint8_t> rgb;
  for (size_t i = 0; i < values.size(); ++i) {
    const bool outside = xyz[i / 3] == glm::dvec3(0);
    rgb.push_back(outside ? kOutside
                          : uint8_t(std::lround(255 * std::clamp(values[i], 0.0f, 1.0f))));
  }
  return rgb;
}

std::vector<uint8_t> error_map(const std::vector<glm::dvec3>& xyz,
                               const std::vector<glm::dvec3>& truth) {
  std::vector<uint8_t> rgb;
  for (size_t i = 0; i < xyz.size(); ++i) {
    if (truth[i] == glm::dvec3(0)) {
      rgb.insert(rgb.end(), 3, kOutside);
      continue;
    }
    // Three decades: 0.1 % to 100 %.
    const double error = std::max(relative_error(xyz[i], truth[i]), 1e-9);
    const glm::dvec3 c = color::inferno((std::log10(error) + 3) / 3);
    for (int j = 0; j < 3; ++j) rgb.push_back(uint8_t(std::lround(c[j])));
  }
  return rgb;
}

Result<std::string> png_url(const output::ImageIo& io, const std::vector<uint8_t>& rgb, int width,
                            int height) {
  output::EncodeRequest request{.format = "png",
                                .width = width,
                                .height = height,
                                .type = output::SampleType::u8,
                                .pixels = rgb.data(),
                                .attributes = {}};
  const auto bytes = io.encode(request);
  if (!bytes) return bytes.error();
  return "data:image/png;base64," + base64(*bytes);
}

}  // namespace skylapse::study
