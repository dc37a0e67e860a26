#include "sky/monte_carlo/reference_image.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <mutex>
#include <numbers>

#include "core/parallel.h"
#include "sky/bruneton/slice_image.h"
#include "sky/monte_carlo/view_ray.h"

namespace skylapse::sky::monte_carlo {
namespace {

/// Paths before the first look at the error of a pixel; each look doubles them.
constexpr long kFirstRound = 256;

/// Sums of XYZ and of their products over paths.
struct ColourMoments {
  glm::dvec3 sum{0};
  glm::dmat3 products{0};
  long paths = 0;

  void add(const glm::dvec3& xyz) {
    sum += xyz;
    products += glm::outerProduct(xyz, xyz);
    ++paths;
  }
  void add_to(ColourEstimate& estimate, double weight) const {
    const double n = double(paths);
    const glm::dvec3 mean = sum / n;
    estimate.xyz += weight * mean;
    estimate.paths += paths;
    if (paths > 1)
      estimate.covariance +=
          weight * weight / (n - 1) * (products / n - glm::outerProduct(mean, mean));
  }
};

/// The paths of one direction of a pixel.
struct Bundle {
  ViewRay ray;
  double weight;
  ColourMoments moments;
};

std::vector<WeightedDirection> directions_of(const image::Camera& camera, int x, int y,
                                             const Direction<Enu>& centre, Angle horizon) {
  const Angle up = elevation(centre);
  const bool map = camera.projection == image::Projection::lat_long;
  const double over = (up - horizon).in(rad);
  const double side = map ? std::numbers::pi / camera.height
                          : std::sqrt(image::pixel_solid_angle(camera, x, y).in(sr));
  if (!(std::abs(over) < bruneton::kMeanPixels * side)) return {{centre, 1}};
  std::vector<WeightedDirection> directions;
  const double share = image::horizon_coverage(up, side * side * sr, horizon);
  const auto add = [&](double low, double high, double weight, int rows) {
    for (int i = 0; i < rows; ++i) {
      const Angle at = horizon + std::lerp(low, high, (i + 0.5) / rows) * rad;
      directions.push_back(
          {enu_direction(azimuth(centre), std::clamp(at, -90 * deg, 90 * deg)), weight / rows});
    }
  };
  const int rows = share > 0 && share < 1 ? kRowsOfPixel / 2 : kRowsOfPixel;
  if (share > 0) add(std::max(0.0, over - side / 2), over + side / 2, share, rows);
  if (share < 1) add(over - side / 2, std::min(0.0, over + side / 2), 1 - share, rows);
  return directions;
}

/// Asks and tells the outside, one thread at a time.
class Watch {
 public:
  Watch(const std::function<bool(double)>& progress, long total)
      : progress_(progress), total_(total) {}
  [[nodiscard]] bool stopped() const { return stopped_; }
  void add(long done) {
    const long so_far = done_ += done;
    if (!progress_) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock && !progress_(double(so_far) / double(total_))) stopped_ = true;
  }

 private:
  const std::function<bool(double)>& progress_;
  long total_;
  std::atomic<long> done_ = 0;
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;
};

/// What the record needs of one pixel.
struct PixelNote {
  long paths = 0;
  double error = 0;
  bool lit = false, reached = true;
};

PixelNote write_pixel(const ColourEstimate& estimate, const ReferenceImageInputs& inputs,
                      float* rgb, float* error) {
  const glm::dvec3 colour = inputs.xyz_to_rgb * estimate.xyz * inputs.scale;
  const glm::dmat3 covariance =
      inputs.xyz_to_rgb * estimate.covariance * glm::transpose(inputs.xyz_to_rgb);
  for (int c = 0; c < 3; ++c) {
    rgb[c] = float(std::max(0.0, colour[c]));
    error[c] = float(inputs.scale * std::sqrt(std::max(0.0, covariance[c][c])));
  }
  PixelNote note{.paths = estimate.paths, .lit = estimate.xyz.y > 0};
  if (note.lit) note.error = std::sqrt(std::max(0.0, estimate.covariance[1][1])) / estimate.xyz.y;
  const auto wanted = inputs.scene->options().relative_error;
  note.reached = !wanted || estimate.relative_error() <= *wanted;
  return note;
}

ReferenceImageRecord record_of(const std::vector<PixelNote>& notes) {
  ReferenceImageRecord record;
  long lit = 0, reached = 0;
  for (const PixelNote& note : notes) {
    record.paths += note.paths;
    if (!note.lit) continue;
    ++lit;
    reached += note.reached;
    record.mean_relative_error += note.error;
    record.max_relative_error = std::max(record.max_relative_error, note.error);
  }
  if (lit > 0) record.mean_relative_error /= double(lit);
  if (lit > 0) record.share_reached = double(reached) / double(lit);
  return record;
}

}  // namespace

double ColourEstimate::relative_error() const {
  double largest = 0;
  for (int c = 0; c < 3; ++c)
    if (xyz[c] > 0)
      largest = std::max(largest, std::sqrt(std::max(0.0, covariance[c][c])) / xyz[c]);
  return largest;
}

ReferenceScene::ReferenceScene(const atmosphere::Medium& medium, Length height,
                               const Direction<Enu>& sun, const ReferenceOptions& options)
    : options_(options),
      optics_(medium, options.aerosol),
      height_(height.in(km)),
      to_sun_(sun.vec()) {
  assert(height_ >= 0 && std::isfinite(height_));
  for (const atmosphere::SpectralBand& band : medium.bands) xyz_weights_.push_back(band.xyz_weight);
}

ColourEstimate ReferenceScene::radiance(const std::vector<WeightedDirection>& directions,
                                        uint32_t stream) const {
  std::vector<Bundle> bundles;
  for (const WeightedDirection& d : directions)
    if (const auto start = entry(optics_.shells, height_, d.direction.vec())) {
      ViewRay ray(optics_, *start, d.direction.vec(), to_sun_, options_);
      if (!ray.dark()) bundles.push_back({std::move(ray), d.weight, {}});
    }
  ColourEstimate estimate;
  if (bundles.empty()) return estimate;
  Path path(optics_, rules_of(options_));
  PathRadiance found;
  const auto count = long(bundles.size());
  const long wanted = std::max(count, options_.samples);
  long end = options_.relative_error ? std::min(wanted, kFirstRound) : wanted;
  for (long n = 0;; end = std::min(wanted, 2 * end)) {
    for (; n < end; ++n) {
      Bundle& bundle = bundles[size_t(n % count)];
      PathRandom random(options_.seed, uint64_t(n), stream);
      bundle.ray(path, n / count, random, found);
      glm::dvec3 xyz{0};
      for (size_t b = 0; b < xyz_weights_.size(); ++b) xyz += found.all[b] * xyz_weights_[b];
      bundle.moments.add(xyz);
    }
    estimate = {};
    for (const Bundle& bundle : bundles) bundle.moments.add_to(estimate, bundle.weight);
    if (end == wanted || estimate.relative_error() <= *options_.relative_error) return estimate;
  }
}

std::vector<double> ReferenceScene::transmittance(Angle zenith) const {
  const glm::dvec3 direction = direction_of(zenith, 0 * rad);
  std::vector<double> result(size_t(optics_.bands), 1.0);
  const auto start = entry(optics_.shells, height_, direction);
  if (!start) return result;
  Trace trace;
  optics_.shells.follow(start->height, glm::dot(start->up, direction), trace);
  PerBand through;
  optics_.transmittances(trace.total, through);
  for (size_t b = 0; b < result.size(); ++b) result[b] = trace.hits_ground ? 0 : through[b];
  return result;
}

Result<ReferenceImageRecord> render_reference(const image::Camera& camera,
                                              const ReferenceImageInputs& inputs,
                                              image::FrameBuffer& out,
                                              image::FrameBuffer& standard_error) {
  assert(out.height() == camera.height);
  return render_reference_rows(camera, inputs, 0, out, standard_error);
}

Result<ReferenceImageRecord> render_reference_rows(const image::Camera& camera,
                                                   const ReferenceImageInputs& inputs,
                                                   int first_row, image::FrameBuffer& out,
                                                   image::FrameBuffer& standard_error) {
  assert(inputs.scene != nullptr && out.width() == camera.width);
  assert(first_row >= 0 && first_row + out.height() <= camera.height);
  assert(standard_error.width() == out.width() && standard_error.height() == out.height());
  const size_t pixels = out.pixel_count(), first = size_t(first_row) * size_t(camera.width);
  std::vector<PixelNote> notes(pixels);
  Watch watch(inputs.progress, long(pixels));
  parallel_for_ranges(pixels, 4, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end && !watch.stopped(); ++i) {
      const int x = int(i % size_t(camera.width)), row = int(i / size_t(camera.width));
      const int y = first_row + row;
      const auto centre = image::direction_at(camera, {x + 0.5, y + 0.5});
      if (centre)
        notes[i] =
            write_pixel(inputs.scene->radiance(directions_of(camera, x, y, *centre, inputs.horizon),
                                               uint32_t(first) + uint32_t(i)),
                        inputs, out.pixel(x, row), standard_error.pixel(x, row));
      watch.add(1);
    }
  });
  if (watch.stopped())
    return Error{ErrorCode::interrupted, "interrupted: finished frames are kept"};
  return record_of(notes);
}

}  // namespace skylapse::sky::monte_carlo
