#include "image/diff/error_sums.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>

#include "core/parallel.h"
#include "image/lighting/harmonics.h"

namespace skylapse::image {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
/// Values below this share of the pixel's strongest channel are dark, not negative.
constexpr float kNegativeShare = 1e-3F;
/// Parts of the picture that are summed on their own: as many for any number of threads.
constexpr int kParts = 64;

/// Everything about one pixel pair that the sums need.
struct PixelError {
  std::array<float, 3> colour{};    // signed
  std::array<float, 3> rounding{};  // of RGBE, in the same unit
  float size = 0;                   // largest of all channels, rounding taken off; +Inf: no number
  int channel = 0;                  // of the largest
};

float last_place(float strongest) {
  // Eight bits for the strongest channel: 2^e / 256 of [2^(e-1), 2^e).
  return strongest > 0 ? std::ldexp(1.0F, std::ilogb(strongest) + 1 - 8) : 0;
}

class RowPass {
 public:
  RowPass(int channels, const ErrorScale& scale, ErrorSums& sums)
      : scale_(scale), channels_(channels), sums_(sums) {}

  PixelError measure(const float* a, const float* b, PixelPlace at) {
    PixelError e;
    if (scale_.colours == 3)
      colours<3>(a, b, at, e);
    else
      colours<1>(a, b, at, e);
    for (int c = scale_.colours; c < channels_; ++c) other(a[c], b[c], c, at, e);
    return e;
  }

 private:
  const ErrorScale& scale_;
  int channels_;
  ErrorSums& sums_;

  /// False if there is nothing to subtract: one of them is NaN or infinite.
  bool comparable(float a, float b, int c, PixelPlace at, PixelError& e) {
    if (std::isfinite(a) && std::isfinite(b)) return true;
    OddSamples& odd = sums_.odd;
    const PixelPlace place{at.x, at.y, c};
    const bool nan_a = std::isnan(a), nan_b = std::isnan(b);
    odd.nan_a += nan_a, odd.nan_b += nan_b;
    odd.infinite_a += std::isinf(a), odd.infinite_b += std::isinf(b);
    if (nan_a != nan_b) {
      ++odd.nan_only_one;
      if (!odd.first_nan) odd.first_nan = place;
    }
    const bool infinite = std::isinf(a) || std::isinf(b);
    if (infinite && !(a == b)) {
      ++odd.infinite_only_one;
      if (!odd.first_infinite) odd.first_infinite = place;
    }
    if (!((nan_a && nan_b) || a == b)) {
      sums_.identical = false;
      e.size = kInf, e.channel = c;
    }
    return false;
  }

  template <int kColours>
  void colours(const float* a, const float* b, PixelPlace at, PixelError& e) {
    float strongest = 0;
    bool same = true, finite = true;
    for (int c = 0; c < kColours; ++c) {
      strongest = std::max({strongest, std::fabs(a[c]), std::fabs(b[c])});
      same = same && a[c] == b[c];
      finite = finite && std::isfinite(a[c]) && std::isfinite(b[c]);
    }
    if (!finite) return odd_colours<kColours>(a, b, at, e);
    signs<kColours>(a, b, strongest, at);
    sums_.samples += kColours;
    if (same) return;
    sums_.identical = false;
    const float rounding = rounding_of(strongest);
    for (int c = 0; c < kColours; ++c) colour(a[c], b[c], c, strongest, rounding, at, e);
  }

  void colour(float a, float b, int c, float strongest, float rounding, PixelPlace at,
              PixelError& e) {
    // Halves first: the difference of two large numbers of other sign may be too large for a float.
    const float half = 0.5F * b - 0.5F * a, larger = std::max(std::fabs(a), std::fabs(b));
    const double difference = 2.0 * double(half);
    const double size = std::fabs(difference);
    sums_.absolute_sum += size, sums_.absolute_squares += size * size;
    const float limited = std::clamp(b, 0.0F, scale_.peak) - std::clamp(a, 0.0F, scale_.peak);
    sums_.limited_squares += double(limited) * double(limited);
    if (size > sums_.absolute_max) sums_.absolute_max = size, sums_.absolute_at = {at.x, at.y, c};
    const float reference = scale_.display
                                ? 1.0F / 255.0F
                                : std::max({std::fabs(a), std::fabs(b),
                                            float(kWeakChannelShare) * strongest, scale_.floor});
    e.colour[size_t(c)] = 2 * (half / reference);
    if (scale_.rgbe_step > 0) e.rounding[size_t(c)] = rounding / reference;
    const float beyond = std::max(
        0.0F, 2 * ((std::fabs(half) - 0.5F * (rounding + scale_.half_step * larger)) / reference));
    if (beyond > e.size) e.size = beyond, e.channel = c;
  }

  template <int kColours>
  void odd_colours(const float* a, const float* b, PixelPlace at, PixelError& e) {
    // The channels beside the odd one are compared as ever.
    float strongest = 0;
    for (int c = 0; c < kColours; ++c)
      for (const float v : {a[c], b[c]})
        if (std::isfinite(v)) strongest = std::max(strongest, std::fabs(v));
    for (int c = 0; c < kColours; ++c) {
      if (!comparable(a[c], b[c], c, at, e)) continue;
      ++sums_.samples;
      if (a[c] == b[c]) continue;
      sums_.identical = false;
      colour(a[c], b[c], c, strongest, rounding_of(strongest), at, e);
    }
  }

  [[nodiscard]] float rounding_of(float strongest) const {
    return scale_.absolute_step +
           (scale_.rgbe_step > 0 ? scale_.rgbe_step * last_place(strongest) : 0);
  }

  template <int kColours>
  void signs(const float* a, const float* b, float strongest, PixelPlace at) {
    OddSamples& odd = sums_.odd;
    for (int c = 0; c < kColours; ++c) {
      if (a[c] >= 0 && b[c] >= 0) continue;
      const float limit = -std::max(kNegativeShare * strongest, scale_.floor);
      odd.negative_a += a[c] < limit, odd.negative_b += b[c] < limit;
      // What was dark may round to either side; what has become negative by more is new.
      if (b[c] < limit && a[c] >= 0) {
        ++odd.new_negative;
        if (!odd.first_negative) odd.first_negative = PixelPlace{at.x, at.y, c};
      }
    }
  }

  void other(float a, float b, int c, PixelPlace at, PixelError& e) {
    if (!comparable(a, b, c, at, e) || a == b) return;
    sums_.identical = false;
    const float floor = scale_.others[size_t(c - scale_.colours)];
    const float reference =
        scale_.display ? 1.0F / 255.0F : std::max({std::fabs(a), std::fabs(b), floor});
    const float rounding =
        scale_.absolute_step + scale_.half_step * std::max(std::fabs(a), std::fabs(b));
    const float half = std::fabs(0.5F * b - 0.5F * a);
    const float size = std::max(0.0F, 2 * ((half - 0.5F * rounding) / reference));
    if (double(size) > sums_.other_max) sums_.other_max = size, sums_.other_at = {at.x, at.y, c};
    if (size > e.size) e.size = size, e.channel = c;
  }
};

void add_light(SkyLight& light, const std::array<double, 3>& colour, int colours, double omega,
               double up, const std::array<double, kHarmonics>& basis) {
  double mean = 0;
  for (size_t c = 0; c < size_t(colours); ++c) {
    mean += colour[c] / colours;
    if (up > 0) light.horizontal[c] += omega * up * colour[c];
  }
  for (size_t i = 0; i < kHarmonics; ++i) light.harmonics[i] += omega * mean * basis[i];
}

void add_light(SkyLight& light, const SkyLight& other) {
  for (size_t c = 0; c < 3; ++c) light.horizontal[c] += other.horizontal[c];
  for (size_t i = 0; i < kHarmonics; ++i) light.harmonics[i] += other.harmonics[i];
}

void add_pixel(PixelSums& sums, const PixelError& e, const float* a, const float* b, int colours,
               double weight, PixelPlace at) {
  if (e.size == kInf) return;
  sums.count += 1;
  sums.squares += double(e.size) * double(e.size);
  if (double(e.size) > sums.worst) sums.worst = e.size, sums.worst_at = at;
  for (int c = 0; c < colours; ++c) {
    const double rounding = e.rounding[size_t(c)];
    sums.signed_sum[size_t(c)] += double(e.colour[size_t(c)]);
    sums.rounding_squares[size_t(c)] += rounding * rounding;
  }
  for (int c = 0; c < colours; ++c) {
    if (!std::isfinite(a[c])) return;  // the same in both
  }
  sums.light_weight += weight;
  for (int c = 0; c < colours; ++c) {
    sums.colour_a[size_t(c)] += weight * double(a[c]);
    sums.colour_b[size_t(c)] += weight * double(b[c]);
  }
}

/// The rows [begin, end) of the picture; begin is a multiple of kErrorBlock.
class PartPass {
 public:
  PartPass(const Picture& a, const Picture& b, const ErrorScale& scale, const SkyRows* sky,
           std::vector<float>& error, ErrorSums& sums)
      : a_(a),
        b_(b),
        sky_(sky),
        error_(error),
        sums_(sums),
        pixels_(a.channel_count(), scale, sums) {
    sums_.column_squares.assign(size_t(a.width), 0);
    blocks_.resize((size_t(a.width) + kErrorBlock - 1) / kErrorBlock);
  }

  void run(int begin, int end) {
    for (int y = begin; y < end; ++y) {
      if (y % kErrorBlock == 0) std::fill(blocks_.begin(), blocks_.end(), Block{});
      row(y);
      if (y % kErrorBlock == kErrorBlock - 1 || y == end - 1)
        for (const Block& block : blocks_)
          if (block.count > 0) sums_.block.offer(block.squares / block.count, block.worst_at);
    }
  }

 private:
  struct Block {
    double squares = 0, count = 0;
    float worst = -1;
    PixelPlace worst_at;
  };
  const Picture& a_;
  const Picture& b_;
  const SkyRows* sky_;
  std::vector<float>& error_;
  ErrorSums& sums_;
  RowPass pixels_;
  SkyRow looks_;
  std::vector<Block> blocks_;
  PixelSums run_;
  uint8_t run_regions_ = 0;

  void row(int y) {
    if (sky_ != nullptr) sky_->fill(y, looks_);
    double squares = 0, count = 0;
    float worst = -1;
    PixelPlace worst_at{0, y, -1};
    for (int x = 0; x < a_.width; ++x) {
      const float *a = a_.pixel(x, y), *b = b_.pixel(x, y);
      const PixelError e = pixels_.measure(a, b, {x, y});
      error_[size_t(y) * size_t(a_.width) + size_t(x)] = e.size;
      const PixelPlace at{x, y, e.channel};
      add(x, e, a, b, at);
      if (e.size == kInf) continue;
      const double square = double(e.size) * double(e.size);
      squares += square, count += 1;
      if (e.size > worst) worst = e.size, worst_at = at;
      sums_.column_squares[size_t(x)] += square;
      Block& block = blocks_[size_t(x / kErrorBlock)];
      block.squares += square, block.count += 1;
      if (e.size > block.worst) block.worst = e.size, block.worst_at = at;
    }
    end_run();
    if (count > 0) sums_.row.offer(squares / count, worst_at);
  }

  void add(int x, const PixelError& e, const float* a, const float* b, PixelPlace at) {
    double weight = 1;
    if (sky_ != nullptr) {
      const auto i = size_t(x);
      weight = looks_.solid_angle[i];
      if (looks_.regions[i] != run_regions_) end_run();
      run_regions_ = looks_.regions[i];
      if (weight > 0) add_sky(i, e, a, b, weight);
    }
    add_pixel(run_, e, a, b, a_.colour_count(), weight, at);
    if (e.size != kInf) sums_.histogram.add(e.size);
  }

  /// Neighbours of the same regions are summed once, not once a region.
  void end_run() {
    sums_.all.add(run_);
    for (unsigned bits = run_regions_; bits != 0; bits &= bits - 1)
      sums_.regions[size_t(std::countr_zero(bits))].add(run_);
    run_ = {};
  }

  void add_sky(size_t i, const PixelError& e, const float* a, const float* b, double omega) {
    const int colours = a_.colour_count();
    std::array<double, 3> light{}, change{};
    bool changed = false;
    for (int c = 0; c < colours; ++c) {
      if (!std::isfinite(a[c]) || !std::isfinite(b[c])) return;
      light[size_t(c)] = double(a[c]), change[size_t(c)] = double(b[c]) - double(a[c]);
      changed = changed || a[c] != b[c];
    }
    const glm::dvec3 d(looks_.east[i], looks_.north[i], looks_.up[i]);
    const auto basis = harmonics_at(d);
    add_light(sums_.light, light, colours, omega, d.z, basis);
    if (changed) add_light(sums_.change, change, colours, omega, d.z, basis);
    sums_.solid_angle += omega;
    sums_.weighted_squares += omega * double(e.size) * double(e.size);
  }
};

template <class T>
void keep_first(std::optional<T>& mine, const std::optional<T>& next) {
  if (!mine) mine = next;
}

void add_odd(OddSamples& all, const OddSamples& part) {
  all.nan_a += part.nan_a, all.nan_b += part.nan_b, all.nan_only_one += part.nan_only_one;
  all.infinite_a += part.infinite_a, all.infinite_b += part.infinite_b;
  all.infinite_only_one += part.infinite_only_one;
  all.negative_a += part.negative_a, all.negative_b += part.negative_b;
  all.new_negative += part.new_negative;
  keep_first(all.first_nan, part.first_nan);
  keep_first(all.first_infinite, part.first_infinite);
  keep_first(all.first_negative, part.first_negative);
}

void add_part(ErrorSums& all, const ErrorSums& part) {
  add_odd(all.odd, part.odd);
  all.identical = all.identical && part.identical;
  all.all.add(part.all);
  for (size_t r = 0; r < all.regions.size(); ++r) all.regions[r].add(part.regions[r]);
  all.histogram.add(part.histogram);
  all.block.offer(part.block.mean_square, part.block.at);
  all.row.offer(part.row.mean_square, part.row.at);
  all.solid_angle += part.solid_angle, all.weighted_squares += part.weighted_squares;
  all.absolute_sum += part.absolute_sum, all.absolute_squares += part.absolute_squares;
  if (part.absolute_max > all.absolute_max)
    all.absolute_max = part.absolute_max, all.absolute_at = part.absolute_at;
  all.samples += part.samples;
  if (part.other_max > all.other_max) all.other_max = part.other_max, all.other_at = part.other_at;
  add_light(all.light, part.light), add_light(all.change, part.change);
  all.limited_squares += part.limited_squares;
  for (size_t x = 0; x < part.column_squares.size(); ++x)
    all.column_squares[x] += part.column_squares[x];
}

/// The column with the largest sum, and its worst pixel.
void find_worst_column(ErrorSums& sums, const Picture& a, const std::vector<float>& error) {
  const auto worst = std::max_element(sums.column_squares.begin(), sums.column_squares.end());
  const int x = int(worst - sums.column_squares.begin());
  PixelPlace at{x, 0, -1};
  float largest = -1;
  double count = 0;
  for (int y = 0; y < a.height; ++y) {
    const float e = error[size_t(y) * size_t(a.width) + size_t(x)];
    if (e == kInf) continue;
    count += 1;
    if (e > largest) largest = e, at.y = y;
  }
  if (count > 0) sums.column.offer(*worst / count, at);
}

}  // namespace

void PixelSums::add(const PixelSums& other) {
  count += other.count, squares += other.squares, light_weight += other.light_weight;
  for (size_t c = 0; c < 3; ++c) {
    signed_sum[c] += other.signed_sum[c];
    rounding_squares[c] += other.rounding_squares[c];
    colour_a[c] += other.colour_a[c], colour_b[c] += other.colour_b[c];
  }
  if (other.worst > worst) worst = other.worst, worst_at = other.worst_at;
}

ErrorSums sum_errors(const Picture& a, const Picture& b, const ErrorScale& scale,
                     const SkyView& view, std::vector<float>& error) {
  error.assign(a.pixel_count(), 0);
  std::unique_ptr<const SkyRows> sky;
  if (view.camera) sky = std::make_unique<SkyRows>(view);
  const int blocks = (a.height + kErrorBlock - 1) / kErrorBlock;
  const int parts = std::min(kParts, blocks);
  std::vector<ErrorSums> sums(static_cast<size_t>(parts));
  parallel_for_ranges(sums.size(), 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const auto row = [&](size_t part) {
        return std::min(a.height, int(int64_t(blocks) * int64_t(part) / parts) * kErrorBlock);
      };
      PartPass(a, b, scale, sky.get(), error, sums[i]).run(row(i), row(i + 1));
    }
  });
  ErrorSums all = std::move(sums.front());
  for (size_t i = 1; i < sums.size(); ++i) add_part(all, sums[i]);
  find_worst_column(all, a, error);
  return all;
}

}  // namespace skylapse::image
