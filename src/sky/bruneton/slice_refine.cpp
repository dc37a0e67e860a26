#include "sky/bruneton/slice_refine.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/parallel.h"

namespace skylapse::sky::bruneton {
namespace {

/// Largest step of the logarithm that is taken for a smooth fall and not for an edge.
constexpr float kLargestLogStep = 4;
/// Slope in the logarithm that is allowed even at an extremum: the curve may leave the range of its
/// nodes by a quarter of this, a few percent, without which every crest would be cut flat.
constexpr float kFreeSlope = 0.15f;

/// What the ends of an axis do: a level slope by symmetry, or a parabola through three nodes.
enum class End { level, free };

/// Slope of a curve at a node from the steps before and after it.
float limited(float before, float after, float free_slope) {
  const float least = before * after > 0 ? std::min(std::abs(before), std::abs(after)) : 0;
  const float cap = 3 * least + free_slope;
  return std::clamp(0.5f * (before + after), -cap, cap);
}

/// Slopes at the n nodes of a line.
void slopes_of(const float* f, int n, End end, float free_slope, float* slope) {
  for (int i = 1; i + 1 < n; ++i) slope[i] = limited(f[i] - f[i - 1], f[i + 1] - f[i], free_slope);
  slope[0] = slope[n - 1] = 0;
  if (end == End::level) return;
  const auto at_end = [&](float step, float inner) {
    const float cap = 3 * std::abs(step);
    return std::clamp(1.5f * step - 0.5f * inner, -cap, cap);
  };
  if (n < 3) {
    slope[0] = slope[n - 1] = f[n - 1] - f[0];
    return;
  }
  slope[0] = at_end(f[1] - f[0], f[2] - f[1]);
  slope[n - 1] = at_end(f[n - 1] - f[n - 2], f[n - 2] - f[n - 3]);
}

float hermite(const float* f, const float* slope, int i, float t) {
  const float step = f[i + 1] - f[i];
  const float a = slope[i] - step, b = step - slope[i + 1];
  return f[i] + t * step + t * (1 - t) * ((1 - t) * a + t * b);
}

/// One component along one line, `by` nodes per interval; scratch for lines of up to n nodes.
class Line {
 public:
  explicit Line(int n) : value(n), log_(n), slope_(n), log_slope_(n) {}

  void refine(int by, End end, float* out, int stride) {
    const int n = int(value.size());
    bool any_log = false;
    for (int i = 0; i < n; ++i) {
      log_[i] = value[i] > 0 ? std::log(value[i]) : 0;
      any_log = any_log || value[i] > 0;
    }
    slopes_of(value.data(), n, end, 0, slope_.data());
    if (any_log) slopes_of(log_.data(), n, end, kFreeSlope, log_slope_.data());
    for (int i = 0; i + 1 < n; ++i) {
      const bool log = smooth_fall(i);
      out[size_t(i) * by * stride] = value[i];
      for (int k = 1; k < by; ++k) {
        const float t = float(k) / float(by);
        out[size_t(i * by + k) * stride] =
            log ? std::exp(hermite(log_.data(), log_slope_.data(), i, t))
                : hermite(value.data(), slope_.data(), i, t);
      }
    }
    out[size_t(n - 1) * by * stride] = value[n - 1];
  }

  std::vector<float> value;

 private:
  [[nodiscard]] bool smooth_fall(int i) const {
    const int first = std::max(i - 1, 0), last = std::min(i + 2, int(value.size()) - 1);
    for (int j = first; j <= last; ++j)
      if (!(value[j] > 0)) return false;
    return std::abs(log_[i + 1] - log_[i]) < kLargestLogStep;
  }

  std::vector<float> log_, slope_, log_slope_;
};

/// `lines` lines of `nodes` nodes each: node i of line l is texel l * line_step + i * node_step.
struct Layout {
  int lines, nodes;
  size_t line_step, node_step;
};

/// Nodes of an axis between which the curves are right: those with a computed neighbour on both
/// sides, and the ends of the axis.
NodeRange smooth_part(const NodeRange& computed, int nodes) {
  if (computed.empty()) return {};
  return {computed.begin == 0 ? 0 : computed.begin + 1,
          computed.end == nodes ? nodes : computed.end - 1};
}

/// The same nodes on the finer axis.
NodeRange finer(const NodeRange& nodes, int by) {
  if (nodes.empty()) return {};
  return {nodes.begin * by, (nodes.end - 1) * by + 1};
}

void refine_lines(const glm::vec4* from, const Layout& source, const NodeRange& lines,
                  glm::vec4* to, const Layout& target, int by, End end) {
  if (lines.empty()) return;
  parallel_for_ranges(size_t(lines.end - lines.begin), 4, [&](size_t begin, size_t stop) {
    Line line(source.nodes);
    for (size_t l = lines.begin + begin; l < lines.begin + stop; ++l)
      for (int c = 0; c < 3; ++c) {
        for (int i = 0; i < source.nodes; ++i)
          line.value[i] = from[l * source.line_step + i * source.node_step][c];
        line.refine(by, end, &to[l * target.line_step][c], 4 * int(target.node_step));
      }
  });
}

std::vector<glm::vec4> refined(const std::vector<glm::vec4>& texels, const SliceGrid& coarse,
                               const SliceWindow& window, const SliceGrid& fine, Refinement by) {
  const int n = coarse.azimuths, m = fine.azimuths;
  const int half = coarse.zeniths / 2, fine_half = fine.zeniths / 2;
  const NodeRange columns = finer(smooth_part(window.azimuths, n), by.azimuths);
  std::vector<glm::vec4> rows(size_t(m) * coarse.zeniths), all(size_t(m) * fine.zeniths);
  for (const int side : {0, 1}) {
    const NodeRange& wanted = side == 0 ? window.sky : window.ground;
    const size_t first = size_t(side) * half, first_fine = size_t(side) * fine_half;
    if (wanted.empty()) continue;
    refine_lines(texels.data() + first * n, {half, n, size_t(n), 1}, wanted,
                 rows.data() + first * m, {half, m, size_t(m), 1}, by.azimuths, End::level);
    refine_lines(rows.data() + first * m, {m, half, 1, size_t(m)}, columns,
                 all.data() + first_fine * m, {m, fine_half, 1, size_t(m)}, by.zeniths, End::free);
  }
  return all;
}

}  // namespace

SkySlice refined(const SkySlice& slice, Refinement by) {
  assert(by.azimuths >= 1 && by.zeniths >= 1);
  const SliceGrid& coarse = slice.grid;
  const SliceWindow window = slice.window.value_or(whole_window(coarse));
  SkySlice fine = slice;
  fine.grid.azimuths = (coarse.azimuths - 1) * by.azimuths + 1;
  fine.grid.zeniths = 2 * ((coarse.zeniths / 2 - 1) * by.zeniths + 1);
  fine.smooth = refined(slice.smooth, coarse, window, fine.grid, by);
  fine.aerosol = refined(slice.aerosol, coarse, window, fine.grid, by);
  if (slice.window) {
    const int half = coarse.zeniths / 2;
    fine.window = SliceWindow{finer(smooth_part(window.sky, half), by.zeniths),
                              finer(smooth_part(window.ground, half), by.zeniths),
                              finer(smooth_part(window.azimuths, coarse.azimuths), by.azimuths)};
  }
  return fine;
}

}  // namespace skylapse::sky::bruneton
