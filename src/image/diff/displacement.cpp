#include "image/diff/displacement.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/parallel.h"

namespace skylapse::image {
namespace {

/// Steeper than that per pixel (as a share of the light) a straight line is no picture of an edge.
constexpr float kSteepest = 0.2F;
constexpr int kParts = 64;
/// Pixels that are enough: of larger pictures every n-th row is taken.
constexpr int64_t kEnoughPixels = int64_t{1} << 17;

float light_of(const Picture& p, int x, int y) {
  const float* v = p.pixel(x, y);
  return p.colour_count() == 3 ? (v[0] + v[1] + v[2]) / 3 : v[0];
}

/// Sums of products of the unknowns' columns (d light / dx, d light / dy, 1) and the difference.
struct Normal {
  double xx = 0, xy = 0, yy = 0, x1 = 0, y1 = 0, n = 0, xd = 0, yd = 0, d1 = 0, dd = 0;

  void add(double gx, double gy, double d) {
    xx += gx * gx, xy += gx * gy, yy += gy * gy, x1 += gx, y1 += gy, n += 1;
    xd += gx * d, yd += gy * d, d1 += d, dd += d * d;
  }
  void add(const Normal& o) {
    xx += o.xx, xy += o.xy, yy += o.yy, x1 += o.x1, y1 += o.y1, n += o.n;
    xd += o.xd, yd += o.yd, d1 += o.d1, dd += o.dd;
  }
};

class Gradients {
 public:
  Gradients(const Picture& a, const Picture& b, bool wraps) : a_(a), b_(b), wraps_(wraps) {}

  void add_row(int y, Normal& sums) const {
    const int first = wraps_ ? 0 : 1, last = wraps_ ? a_.width : a_.width - 1;
    for (int x = first; x < last; ++x) {
      const int left = x > 0 ? x - 1 : a_.width - 1, right = x + 1 < a_.width ? x + 1 : 0;
      const float light = light_of(a_, x, y);
      if (!(light > 0)) continue;
      // Of both pictures' mean, so that a move and its opposite come out alike.
      const float gx = 0.25F *
                       (light_of(a_, right, y) - light_of(a_, left, y) + light_of(b_, right, y) -
                        light_of(b_, left, y)) /
                       light;
      const float gy = 0.25F *
                       (light_of(a_, x, y + 1) - light_of(a_, x, y - 1) + light_of(b_, x, y + 1) -
                        light_of(b_, x, y - 1)) /
                       light;
      const float d = (light_of(b_, x, y) - light) / light;
      // Comparisons that NaN fails.
      if (!(std::fabs(gx) < kSteepest && std::fabs(gy) < kSteepest && std::fabs(d) < 2 * kSteepest))
        continue;
      sums.add(double(gx), double(gy), double(d));
    }
  }

 private:
  const Picture& a_;
  const Picture& b_;
  bool wraps_;
};

Normal normal_of(const Picture& a, const Picture& b, bool wraps) {
  const Gradients gradients(a, b, wraps);
  const int64_t step = std::max<int64_t>(1, int64_t(a.pixel_count()) / kEnoughPixels);
  const int rows = int((a.height - 2 + step - 1) / step), parts = std::min(rows, kParts);
  std::vector<Normal> sums(static_cast<size_t>(parts));
  parallel_for_ranges(sums.size(), 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const auto row = [&](size_t part) { return int(int64_t(rows) * int64_t(part) / parts); };
      for (int j = row(i); j < row(i + 1); ++j) gradients.add_row(1 + int(j * step), sums[i]);
    }
  });
  Normal all;
  for (const Normal& part : sums) all.add(part);
  return all;
}

}  // namespace

std::optional<Displacement> fit_displacement(const Picture& a, const Picture& b, bool wraps) {
  if (a.height < 3 || a.width < 3) return {};
  const Normal s = normal_of(a, b, wraps);
  if (s.n < 16) return {};
  // The gain is fitted first: what is left has no mean.
  const double mx = s.x1 / s.n, my = s.y1 / s.n, md = s.d1 / s.n;
  const double steepness = s.xx / s.n - mx * mx + s.yy / s.n - my * my;
  // A picture that changes in one direction alone says nothing of moves across: none is taken.
  const double ridge = 1e-4 * steepness;
  const double xx = s.xx / s.n - mx * mx + ridge, yy = s.yy / s.n - my * my + ridge;
  const double xy = s.xy / s.n - mx * my;
  const double xd = s.xd / s.n - mx * md, yd = s.yd / s.n - my * md, dd = s.dd / s.n - md * md;
  const double determinant = xx * yy - xy * xy;
  if (!(steepness > 0) || !(dd > 0)) return {};
  Displacement move;
  move.x = -(yy * xd - xy * yd) / determinant, move.y = -(xx * yd - xy * xd) / determinant;
  move.gain = md + mx * move.x + my * move.y;
  const double explained = -(move.x * xd + move.y * yd);
  move.explained = std::clamp(explained / dd, 0.0, 1.0);
  move.effect = std::sqrt(
      std::max(0.0, xx * move.x * move.x + 2 * xy * move.x * move.y + yy * move.y * move.y));
  return move;
}

namespace {

struct Window {
  int x0, y0, x1, y1;  // half open
  bool wraps;
};

Window window_of(const Picture& p, double x, double y, double reach, bool wraps) {
  const auto low = [](double v) { return int(std::clamp(std::floor(v), -1e9, 1e9)); };
  Window w{low(x - reach), low(y - reach), low(x + reach) + 1, low(y + reach) + 1, wraps};
  w.y0 = std::max(w.y0, 0), w.y1 = std::min(w.y1, p.height);
  if (!wraps)
    w.x0 = std::max(w.x0, 0), w.x1 = std::min(w.x1, p.width);
  else if (w.x1 - w.x0 > p.width)
    w.x0 = 0, w.x1 = p.width;
  return w;
}

float light_in(const Picture& p, int x, int y) {
  const int column = x % p.width;
  return light_of(p, column < 0 ? column + p.width : column, y);
}

/// Median light of the window's outermost pixels.
float rim_light(const Picture& p, const Window& w) {
  std::vector<float> rim;
  for (int y = w.y0; y < w.y1; ++y)
    for (int x = w.x0; x < w.x1; ++x)
      if (x == w.x0 || x == w.x1 - 1 || y == w.y0 || y == w.y1 - 1)
        rim.push_back(light_in(p, x, y));
  const auto middle = rim.begin() + std::ptrdiff_t(rim.size() / 2);
  std::nth_element(rim.begin(), middle, rim.end());
  return *middle;
}

/// A disc outshines its surroundings by that much even through haze.
constexpr float kOutshines = 10;

}  // namespace

std::optional<Spot> find_spot(const Picture& picture, double x, double y, double reach,
                              bool wraps) {
  const Window w = window_of(picture, x, y, reach, wraps);
  if (w.x0 >= w.x1 || w.y0 >= w.y1) return {};
  float brightest = 0;
  for (int j = w.y0; j < w.y1; ++j)
    for (int i = w.x0; i < w.x1; ++i) {
      const float light = light_in(picture, i, j);
      if (!std::isfinite(light)) return {};
      brightest = std::max(brightest, light);
    }
  const float rim = rim_light(picture, w);
  if (!(brightest > kOutshines * rim)) return {};
  Spot spot;
  for (int j = w.y0; j < w.y1; ++j)
    for (int i = w.x0; i < w.x1; ++i) {
      const float light = light_in(picture, i, j);
      // A tenth of the peak cuts the aureole off, whose slope would pull the centroid.
      if (light < rim + 0.1F * (brightest - rim)) continue;
      const double above = double(light) - double(rim);
      spot.light += above, spot.x += above * (i + 0.5), spot.y += above * (j + 0.5);
    }
  spot.x /= spot.light, spot.y /= spot.light;
  return spot;
}

}  // namespace skylapse::image
