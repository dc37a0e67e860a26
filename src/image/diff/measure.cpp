#include "image/diff/measure.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/parallel.h"
#include "image/diff/displacement.h"
#include "image/diff/error_sums.h"
#include "image/irradiance.h"

namespace skylapse::image {
namespace {

/// A fitted move counts as one if it explains most of the difference, and changes the light by more
/// than rounding to halves may.
constexpr double kExplained = 0.5, kEffect = 1e-4;
/// Six stops: beyond, light has come or gone.
constexpr double kMostOfTheLight = 1 - 1.0 / 64;
/// Farther than a straight line for the light between pixels can tell.
constexpr double kFarthest = 3;

class MeasureList {
 public:
  MeasureList(std::vector<Measure>& list, bool display)
      : list_(list), prefix_(display ? "display." : "relative.") {}
  void scaled(const std::string& name, double value, std::optional<PixelPlace> place = {}) {
    plain(prefix_ + name, value, place);
  }
  void plain(const std::string& name, double value, std::optional<PixelPlace> place = {}) {
    if (std::isfinite(value)) list_.push_back({name, value, place});
  }

 private:
  std::vector<Measure>& list_;
  std::string prefix_;
};

struct Bias {
  double value = 0;
  int channel = 0;
};

/// What rounding alone may make of the mean is taken off: that of n samples, each evenly spread
/// over +-r, has a standard deviation of r / sqrt(3 n). Three of them, but never more than r.
Bias bias_of(const PixelSums& sums, int colours) {
  Bias worst;
  for (int c = 0; c < colours; ++c) {
    const double rounding = std::sqrt(sums.rounding_squares[size_t(c)] / sums.count) *
                            std::min(1.0, std::sqrt(3 / sums.count));
    const double mean = std::fabs(sums.signed_sum[size_t(c)] / sums.count) - rounding;
    if (mean > worst.value) worst = {mean, c};
  }
  return worst;
}

void add_error_measures(const ErrorSums& sums, int colours, MeasureList& list) {
  if (sums.all.count == 0) return;
  list.scaled("max", sums.all.worst, sums.all.worst_at);
  list.scaled("p50", std::min(sums.histogram.percentile(0.5), sums.all.worst));
  list.scaled("p95", std::min(sums.histogram.percentile(0.95), sums.all.worst));
  list.scaled("p99", std::min(sums.histogram.percentile(0.99), sums.all.worst));
  list.scaled("p999", std::min(sums.histogram.percentile(0.999), sums.all.worst));
  list.scaled("rms", std::sqrt(sums.all.squares / sums.all.count));
  const Bias bias = bias_of(sums.all, colours);
  list.scaled("bias", bias.value, PixelPlace{-1, -1, bias.channel});
  list.scaled("block_rms", std::sqrt(sums.block.mean_square), sums.block.at);
  list.scaled("row_rms", std::sqrt(sums.row.mean_square), sums.row.at);
  list.scaled("column_rms", std::sqrt(sums.column.mean_square), sums.column.at);
  if (sums.solid_angle > 0)
    list.scaled("weighted_rms", std::sqrt(sums.weighted_squares / sums.solid_angle));
}

/// A gain of all channels, where most of the difference is one.
void add_exposure(const ErrorSums& sums, int colours, MeasureList& list) {
  double mean = 0, least = HUGE_VAL;
  for (int c = 0; c < colours; ++c) {
    const double of_channel = sums.all.signed_sum[size_t(c)] / sums.all.count;
    mean += of_channel / colours, least = std::min(least, std::fabs(of_channel));
  }
  const double square = sums.all.squares / sums.all.count;
  if (std::fabs(mean) < kEffect || std::fabs(mean) > kMostOfTheLight ||
      least < 0.5 * std::fabs(mean) || mean * mean < 0.5 * square)
    return;
  // An error is a share of the larger of the two.
  list.plain("exposure.shift_ev", mean > 0 ? -std::log2(1 - mean) : std::log2(1 + mean));
}

void add_absolute_measures(const ErrorSums& sums, double unit, MeasureList& list) {
  if (sums.samples == 0) return;
  const auto n = double(sums.samples);
  list.plain("absolute.max", unit * std::max(0.0, sums.absolute_max),
             sums.absolute_max > 0 ? std::optional(sums.absolute_at) : std::nullopt);
  list.plain("absolute.mean", unit * sums.absolute_sum / n);
  list.plain("absolute.rms", unit * std::sqrt(sums.absolute_squares / n));
}

void add_region_measures(const ErrorSums& sums, int colours, MeasureList& list) {
  for (int r = 0; r < kSkyRegions; ++r) {
    const PixelSums& region = sums.regions[size_t(r)];
    if (region.count == 0) continue;
    const std::string name = "region." + std::string(name_of(SkyRegion(r)));
    const Bias bias = bias_of(region, colours);
    PixelPlace place = region.worst_at;
    list.scaled(name + ".rms", std::sqrt(region.squares / region.count), place);
    place.channel = bias.channel;
    list.scaled(name + ".bias", bias.value, place);
  }
}

/// `floor`: light that is none (ErrorScale), from every direction.
void add_light_measures(const ErrorSums& sums, const SkyView& view, int colours, double floor,
                        MeasureList& list) {
  constexpr double kPi = std::numbers::pi;
  const SkyLight &light = sums.light, &change = sums.change;
  if (sees_upper_hemisphere(*view.camera)) {
    double worst = 0;
    for (size_t c = 0; c < size_t(colours); ++c) {
      const double a = light.horizontal[c], b = a + change.horizontal[c];
      const double larger = std::max({std::fabs(a), std::fabs(b), kPi * floor});
      if (larger > 0) worst = std::max(worst, std::fabs(change.horizontal[c]) / larger);
    }
    list.plain("irradiance", worst);
  }
  if (!sees_whole_sphere(view.camera->projection)) return;
  double difference = 0, size = 4 * kPi * floor * floor;
  for (size_t i = 0; i < light.harmonics.size(); ++i) {
    const double a = light.harmonics[i], b = a + change.harmonics[i];
    difference += change.harmonics[i] * change.harmonics[i], size += std::max(a * a, b * b);
  }
  list.plain("harmonics", size > 0 ? std::sqrt(difference / size) : 0);
}

/// CIE 1976 u', v' of mean light; nothing without light.
std::optional<glm::dvec2> chromaticity_of(const std::array<double, 3>& rgb,
                                          const glm::dmat3& to_xyz) {
  const glm::dvec3 xyz = to_xyz * glm::dvec3(rgb[0], rgb[1], rgb[2]);
  const double sum = xyz.x + 15 * xyz.y + 3 * xyz.z;
  if (!(xyz.y > 0) || !(sum > 0) || !std::isfinite(sum)) return {};
  return glm::dvec2(4 * xyz.x / sum, 9 * xyz.y / sum);
}

void add_chromaticity(const ErrorSums& sums, const glm::dmat3& to_xyz, MeasureList& list) {
  double worst = -1;
  PixelPlace place{-1, -1, -1};
  const auto offer = [&](const PixelSums& s, std::optional<PixelPlace> at) {
    const auto a = chromaticity_of(s.colour_a, to_xyz), b = chromaticity_of(s.colour_b, to_xyz);
    if (!a || !b || glm::distance(*a, *b) <= worst) return;
    worst = glm::distance(*a, *b);
    if (at) place = *at;
  };
  offer(sums.all, {});
  for (const PixelSums& region : sums.regions)
    if (region.count > 0) offer(region, region.worst_at);
  if (worst >= 0)
    list.plain("chromaticity", worst, place.x >= 0 ? std::optional(place) : std::nullopt);
}

/// What a thousandth of the samples exceed: the sun's disc does not set the range.
double bright_light(const Picture& a) {
  const size_t step = std::max<size_t>(1, a.pixel_count() >> 16) | 1;
  std::vector<float> light;
  for (size_t i = 0; i < a.pixel_count(); i += step)
    for (int c = 0; c < a.colour_count(); ++c)
      if (const float v = a.samples[i * a.channels.size() + size_t(c)]; std::isfinite(v))
        light.push_back(v);
  if (light.empty()) return 0;
  const auto at = light.begin() + std::ptrdiff_t(double(light.size() - 1) * 0.999);
  std::nth_element(light.begin(), at, light.end());
  return std::max(0.0F, *at);
}

void add_displacement(const Picture& a, const Picture& b, const SkyView& view, MeasureList& list) {
  const bool wraps = view.camera && view.camera->projection == Projection::lat_long;
  const auto move = fit_displacement(a, b, wraps);
  if (!move || move->explained < kExplained || move->effect < kEffect) return;
  const double size = std::hypot(move->x, move->y);
  if (size > kFarthest) return;
  list.plain("position.shift_px", size);
  list.plain("position.right_px", move->x);
  list.plain("position.down_px", move->y);
  if (!view.camera) return;
  const double middle_x = 0.5 * a.width, middle_y = 0.5 * a.height;
  const auto from = direction_at(*view.camera, {middle_x, middle_y});
  const auto to = direction_at(*view.camera, {middle_x + move->x, middle_y + move->y});
  if (from && to) list.plain("position.shift_deg", separation(*from, *to).in(deg));
}

/// Where the picture shows the sun.
struct SpotSearch {
  double x = 0, y = 0, reach = 0;
};

std::optional<SpotSearch> spot_search(const Picture& a, const SkyView& view,
                                      const ErrorSums& sums) {
  if (!view.camera || !view.sun) return {};
  const auto at = position_of(*view.camera, *view.sun);
  if (!at || sums.regions[size_t(SkyRegion::disc)].count == 0) return {};
  const int x = std::clamp(int(at->x), 0, a.width - 1), y = std::clamp(int(at->y), 0, a.height - 1);
  const double pixel = std::sqrt(pixel_solid_angle(*view.camera, x, y).in(sr));
  const double radius = pixel > 0 ? view.sun_radius.in(rad) / pixel : 1;
  return SpotSearch{at->x, at->y, 2 * radius + 8};
}

void add_spot(const Picture& a, const Picture& b, const SkyView& view, const ErrorSums& sums,
              MeasureList& list) {
  const auto search = spot_search(a, view, sums);
  if (!search) return;
  const bool wraps = view.camera->projection == Projection::lat_long;
  const auto sa = find_spot(a, search->x, search->y, search->reach, wraps);
  if (!sa) return;
  const PixelPlace place{(int(std::floor(sa->x)) + a.width) % a.width, int(sa->y), -1};
  const auto sb = find_spot(b, search->x, search->y, search->reach, wraps);
  if (!sb) return list.plain("sun.flux", 1, place);
  list.plain("sun.flux", std::fabs(sb->light - sa->light) / std::max(sa->light, sb->light), place);
  list.plain("sun.shift_px", std::hypot(sb->x - sa->x, sb->y - sa->y), place);
  const auto seen = [&](const Spot& spot) {
    const double turns = wraps ? std::floor(spot.x / a.width) : 0;
    return direction_at(*view.camera, {spot.x - turns * a.width, spot.y});
  };
  const auto from = seen(*sa), to = seen(*sb);
  if (from && to) list.plain("sun.shift_deg", separation(*from, *to).in(deg), place);
}

std::vector<float> thumbnail_of(const Picture& p) {
  constexpr int kColumns = kThumbnailColumns, kRows = kThumbnailRows;
  std::vector<float> cells(size_t(kColumns) * kRows, 0);
  parallel_for_ranges(kRows, 1, [&](size_t begin, size_t end) {
    for (size_t j = begin; j < end; ++j) {
      const auto edge = [](int size, int parts, size_t i) {
        return int(int64_t(size) * int64_t(i) / parts);
      };
      std::array<double, kColumns> sum{}, count{};
      for (int y = edge(p.height, kRows, j); y < edge(p.height, kRows, j + 1); ++y)
        for (size_t i = 0; i < kColumns; ++i)
          for (int x = edge(p.width, kColumns, i); x < edge(p.width, kColumns, i + 1); ++x) {
            const float* v = p.pixel(x, y);
            const double light = p.colour_count() == 3
                                     ? (double(v[0]) + double(v[1]) + double(v[2])) / 3
                                     : double(v[0]);
            if (std::isfinite(light)) sum[i] += light, count[i] += 1;
          }
      for (size_t i = 0; i < kColumns; ++i)
        if (count[i] > 0) cells[j * kColumns + i] = float(sum[i] / count[i]);
    }
  });
  return cells;
}

/// Of the bits of all samples, four lanes at a time so that it runs at the speed of memory.
uint64_t hash_of(const Picture& p) {
  std::array<uint64_t, 4> lanes{1, 2, 3, 4};
  const auto mixed = [](uint64_t h, uint32_t bits) {
    return std::rotl((h ^ bits) * 0x9E3779B97F4A7C15ULL, 29);
  };
  const size_t n = p.samples.size();
  for (size_t i = 0; i < n; ++i)
    lanes[i & 3] = mixed(lanes[i & 3], std::bit_cast<uint32_t>(p.samples[i] + 0.0F));  // -0 is 0
  uint64_t all = n;
  for (const uint64_t lane : lanes) all = mixed(mixed(all, uint32_t(lane)), uint32_t(lane >> 32U));
  return all;
}

void add_regions(const ErrorSums& sums, int colours, Comparison& result) {
  const auto offer = [&](const std::string& name, const PixelSums& s) {
    if (s.light_weight <= 0) return;
    Comparison::RegionLight light{name, 0, 0};
    for (size_t c = 0; c < size_t(colours); ++c) {
      light.a += s.colour_a[c] / (s.light_weight * colours);
      light.b += s.colour_b[c] / (s.light_weight * colours);
    }
    result.regions.push_back(light);
  };
  offer("all", sums.all);
  for (int r = 0; r < kSkyRegions; ++r)
    offer(std::string(name_of(SkyRegion(r))), sums.regions[size_t(r)]);
}

}  // namespace

Comparison compare(const Picture& a, const Picture& b, const SkyView& view,
                   const CompareOptions& options) {
  assert(a.width == b.width && a.height == b.height && a.channels == b.channels);
  assert(!view.camera || (view.camera->width == a.width && view.camera->height == a.height));
  Comparison result;
  const int colours = a.colour_count();
  ErrorScale scale = error_scale(a, b);
  const double peak = options.psnr_peak    ? *options.psnr_peak
                      : a.display_referred ? 1
                                           : bright_light(a);
  scale.peak = float(peak);
  if (!options.forgive_rounding) scale.absolute_step = scale.half_step = scale.rgbe_step = 0;
  const ErrorSums sums = sum_errors(a, b, scale, view, result.error);
  result.odd = sums.odd, result.identical = sums.identical;
  result.hash_a = hash_of(a);
  result.hash_b = result.identical ? result.hash_a : hash_of(b);
  result.thumbnail_a = thumbnail_of(a);
  result.thumbnail_b = result.identical ? result.thumbnail_a : thumbnail_of(b);
  add_regions(sums, colours, result);
  MeasureList list(result.measures, a.display_referred);
  add_error_measures(sums, colours, list);
  if (sums.other_max >= 0) list.scaled("other_channels", sums.other_max, sums.other_at);
  add_absolute_measures(sums, a.display_referred ? 255 : 1, list);
  list.plain("negative.share", a.samples.empty() ? 0
                                                 : std::fabs(double(sums.odd.negative_b) -
                                                             double(sums.odd.negative_a)) /
                                                       double(a.samples.size()));
  if (view.camera) {
    add_region_measures(sums, colours, list);
    add_light_measures(sums, view, colours, double(scale.floor), list);
  }
  if (colours == 3 && !a.display_referred && options.rgb_to_xyz)
    add_chromaticity(sums, *options.rgb_to_xyz, list);
  if (result.identical) return result;
  if (!a.display_referred && sums.all.count > 0) add_exposure(sums, colours, list);
  if (peak > 0 && sums.samples > 0) {
    list.plain("psnr", 10 * std::log10(peak * peak * double(sums.samples) / sums.limited_squares));
    list.plain("psnr.peak", peak);
  }
  add_displacement(a, b, view, list);
  add_spot(a, b, view, sums, list);
  return result;
}

}  // namespace skylapse::image
