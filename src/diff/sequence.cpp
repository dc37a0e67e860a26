#include "diff/sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diff/judge.h"
#include "diff/wording.h"

namespace skylapse::diff {
namespace {

/// Small pictures nearer than this are the same: halves, averaged over a cell, differ by less.
constexpr double kNothing = 2e-5;
/// A frame shows another frame if it is nearer to that than to its own by this factor.
constexpr double kNearer = 0.2;
/// How far away in time another frame is looked for; in short sequences everywhere.
constexpr size_t kWindow = 16, kShort = 256;

/// Whether B stands still from `before` to `now` although A does not.
bool repeats(const PairTrace& before, const PairTrace& now) {
  // A sky that stands still but for its lowest bits does not go on.
  const double moved = thumbnail_distance(before.thumbnail_a, now.thumbnail_a, now.display);
  if (now.hash_a == before.hash_a || moved < kNothing) return false;
  if (now.hash_b == before.hash_b) return true;
  const double moved_b = thumbnail_distance(before.thumbnail_b, now.thumbnail_b, now.display);
  return moved > kNothing / kNearer && moved_b < kNothing;
}

/// The frame of A that frame `i` of B shows in place of its own; `i` if there is none.
size_t shown_frame(const std::vector<TracedFrame>& frames, size_t i) {
  const PairTrace& own = frames[i].trace;
  if (own.identical) return i;
  const double to_own = thumbnail_distance(own.thumbnail_b, own.thumbnail_a, own.display);
  size_t nearest = i;
  double least = kNearer * to_own;
  const bool all = frames.size() <= kShort;
  const size_t begin = all || i < kWindow ? 0 : i - kWindow;
  const size_t end = all ? frames.size() : std::min(frames.size(), i + kWindow + 1);
  for (size_t j = begin; j < end; ++j) {
    const PairTrace& other = frames[j].trace;
    if (j == i || !other.valid || other.hash_a == own.hash_a) continue;
    if (thumbnail_distance(own.thumbnail_a, other.thumbnail_a, own.display) < kNothing) continue;
    const double distance =
        own.hash_b == other.hash_a
            ? -1
            : thumbnail_distance(own.thumbnail_b, other.thumbnail_a, own.display);
    if (distance < least) least = distance, nearest = j;
  }
  // Within the rounding of the files both frames may look the same.
  return to_own > kNothing || least < 0 ? nearest : i;
}

/// Error of a region's light: ln(b / a), or b - a in code values. NaN without light.
double region_error(const PairTrace& trace, const std::string& region) {
  for (const auto& light : trace.regions) {
    if (light.region != region) continue;
    if (trace.display) return 255 * (light.b - light.a);
    return light.a > 0 && light.b > 0 ? std::log(light.b / light.a) : kNone;
  }
  return kNone;
}

struct Flicker {
  double size = 0;
  std::string region;
};

/// Largest distance of a region's error in the middle frame from the mean of its neighbours'.
Flicker flicker_of(const PairTrace& before, const PairTrace& now, const PairTrace& after) {
  Flicker worst;
  for (const auto& light : now.regions) {
    const double mean =
        0.5 * (region_error(before, light.region) + region_error(after, light.region));
    const double size = region_error(now, light.region) - mean;
    if (std::fabs(size) > std::fabs(worst.size)) worst = {size, light.region};
  }
  return worst;
}

void add_flicker(const TracedFrame& frame, const Flicker& flicker, const Limits& limits,
                 std::vector<Finding>& findings) {
  const std::string name = frame.trace.display ? "sequence.flicker_codes" : "sequence.flicker";
  const MeasuredValue value = judged({name, std::fabs(flicker.size), {}}, limits);
  if (value.verdict == Verdict::same) return;
  const double limit = value.verdict == Verdict::different ? value.fail_above : value.warn_above;
  findings.push_back(
      {value.verdict,
       name,
       fmt::format("{} flickers: against A, {} is {} {} than in the frames beside it (allowed: {})",
                   one_line(frame.name),
                   flicker.region == "all" ? "the picture" : "the region " + flicker.region,
                   value_text(value.value, value.unit), flicker.size > 0 ? "brighter" : "darker",
                   value_text(limit, value.unit)),
       {}});
}

}  // namespace

double thumbnail_distance(const std::vector<float>& a, const std::vector<float>& b, bool display) {
  if (a.empty() || a.size() != b.size()) return HUGE_VAL;
  double squares = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const double va = double(a[i]), vb = double(b[i]);
    const double mean = 0.5 * (std::fabs(va) + std::fabs(vb));
    const double error = display ? vb - va : mean > 0 ? (vb - va) / mean : 0;
    squares += error * error;
  }
  return std::sqrt(squares / double(a.size()));
}

namespace {

/// Flicker of every frame but the first and last, told of those that stand out: a frame that is off
/// makes its neighbours look off by half as much.
void judge_flicker(const std::vector<TracedFrame>& frames, const std::vector<bool>& out_of_place,
                   const Limits& limits, std::vector<Finding>& findings) {
  std::vector<Flicker> flicker(frames.size());
  for (size_t i = 1; i + 1 < frames.size(); ++i)
    flicker[i] = flicker_of(frames[i - 1].trace, frames[i].trace, frames[i + 1].trace);
  for (size_t i = 1; i + 1 < frames.size(); ++i) {
    if (out_of_place[i - 1] || out_of_place[i] || out_of_place[i + 1]) continue;
    const double beside = std::max(std::fabs(flicker[i - 1].size), std::fabs(flicker[i + 1].size));
    if (std::fabs(flicker[i].size) >= 0.75 * beside)
      add_flicker(frames[i], flicker[i], limits, findings);
  }
}

}  // namespace

std::vector<Finding> judge_sequence(const std::vector<TracedFrame>& all, const Limits& limits) {
  std::vector<TracedFrame> frames;
  for (const TracedFrame& frame : all)
    if (frame.trace.valid) frames.push_back(frame);
  std::vector<Finding> findings;
  std::vector<bool> out_of_place(frames.size(), false);
  const auto add = [&](size_t frame, const std::string& check, const std::string& message) {
    out_of_place[frame] = true;
    findings.push_back({Verdict::different, check, message, {}});
  };
  for (size_t i = 0; i < frames.size(); ++i) {
    const std::string name = one_line(frames[i].name);
    if (const size_t shown = shown_frame(frames, i); shown != i)
      add(i, "sequence.order",
          fmt::format("{} of B shows what {} of A shows", name, one_line(frames[shown].name)));
    if (i > 0 && repeats(frames[i - 1].trace, frames[i].trace))
      add(i, "sequence.repeated",
          fmt::format("{} of B repeats {}, where A goes on", name, one_line(frames[i - 1].name)));
  }
  judge_flicker(frames, out_of_place, limits, findings);
  return findings;
}

}  // namespace skylapse::diff
