#include "diff/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diff/wording.h"
#include "image/diff/sky_rows.h"

namespace skylapse::diff {
namespace {

std::string samples(uint64_t count) {
  return count == 1 ? "one sample" : fmt::format("{} samples", count);
}

void add_finding(PairResult& pair, const std::string& check, std::string message,
                 const std::optional<image::PixelPlace>& at = {}) {
  Finding finding{Verdict::different, check, std::move(message), {}};
  if (at) finding.place = place_of(*at, pair.a.channels, pair.view);
  if (finding.place) finding.message += " " + place_text(*finding.place);
  pair.findings.push_back(std::move(finding));
}

/// A number of samples in A and B as words: "12 samples in B and none in A".
std::string counts_text(uint64_t a, uint64_t b) {
  const auto in = [](uint64_t n, const char* where) {
    return n == 0 ? fmt::format("none in {}", where) : fmt::format("{} in {}", samples(n), where);
  };
  return in(b, "B") + ", " + in(a, "A");
}

bool beyond(double value, double limit, bool below) {
  if (std::isnan(limit)) return false;
  return below ? value < limit : !(value <= limit);
}

}  // namespace

Place place_of(const image::PixelPlace& pixel, const std::vector<std::string>& channels,
               const image::SkyView& view) {
  Place place{.x = pixel.x,
              .y = pixel.y,
              .channel = {},
              .azimuth_deg = {},
              .elevation_deg = {},
              .from_sun_deg = {},
              .region = {}};
  if (pixel.channel >= 0 && size_t(pixel.channel) < channels.size())
    place.channel = channels[size_t(pixel.channel)];
  if (!view.camera || pixel.x < 0) return place;
  const auto direction = direction_at(*view.camera, {pixel.x + 0.5, pixel.y + 0.5});
  if (!direction) return place;
  place.azimuth_deg = azimuth(*direction).in(deg);
  place.elevation_deg = elevation(*direction).in(deg);
  if (view.sun) place.from_sun_deg = separation(*direction, *view.sun).in(deg);
  const double omega = pixel_solid_angle(*view.camera, pixel.x, pixel.y).in(sr);
  const auto regions = image::regions_at(direction->vec(), view, std::sqrt(omega) * rad);
  if (const auto region = image::chief_region(regions)) place.region = title_of(*region);
  return place;
}

MeasuredValue judged(const image::Measure& measure, const Limits& limits) {
  const MeasureKind* kind = kind_of(measure.name);
  const Limit limit = limit_of(limits, measure.name);
  MeasuredValue value{.name = measure.name,
                      .unit = std::string(kind != nullptr ? kind->unit : ""),
                      .value = measure.value,
                      .warn_above = limit.warn,
                      .fail_above = limit.fail,
                      .below = measure.name == "psnr",
                      .verdict = Verdict::same,
                      .place = {}};
  if (beyond(value.value, value.fail_above, value.below))
    value.verdict = Verdict::different;
  else if (beyond(value.value, value.warn_above, value.below))
    value.verdict = Verdict::warning;
  return value;
}

void judge_odd_samples(const image::OddSamples& odd, PairResult& pair) {
  if (odd.nan_only_one > 0)
    add_finding(pair, "nan",
                fmt::format("{} NaN: {}; the first", odd.nan_b > odd.nan_a ? "B has" : "A has",
                            counts_text(odd.nan_a, odd.nan_b)),
                odd.first_nan);
  if (odd.infinite_only_one > 0)
    add_finding(pair, "inf",
                fmt::format("infinite samples differ: {}; the first",
                            counts_text(odd.infinite_a, odd.infinite_b)),
                odd.first_infinite);
  if (odd.new_negative > 0)
    add_finding(pair, "negative",
                fmt::format("{} negative in B and not in A; the first", samples(odd.new_negative)),
                odd.first_negative);
  const uint64_t both_nan = odd.nan_a - std::min(odd.nan_a, odd.nan_only_one);
  const uint64_t both_inf = odd.infinite_a - std::min(odd.infinite_a, odd.infinite_only_one);
  if (both_nan > 0)
    add_finding(pair, "odd-reference", fmt::format("{} NaN in both pictures", samples(both_nan)));
  if (both_inf > 0)
    add_finding(pair, "odd-reference",
                fmt::format("{} infinite in both pictures", samples(both_inf)));
}

void judge_measures(const std::vector<image::Measure>& measures, const Limits& limits,
                    PairResult& pair) {
  for (const image::Measure& measure : measures) {
    MeasuredValue value = judged(measure, limits);
    if (measure.place) {
      value.place = place_of(*measure.place, pair.a.channels, pair.view);
      // A mean has a channel and no pixel.
      if (measure.place->x < 0) value.place.reset();
    }
    if (value.verdict != Verdict::same) {
      const double limit =
          value.verdict == Verdict::different ? value.fail_above : value.warn_above;
      std::string text =
          fmt::format("{} is {} ({}: {})", value.name, value_text(value.value, value.unit),
                      value.below ? "at least" : "allowed", value_text(limit, value.unit));
      if (measure.place && measure.place->x < 0 && measure.place->channel >= 0)
        text += ", channel " + pair.a.channels[size_t(measure.place->channel)];
      if (value.place) text += " " + place_text(*value.place);
      pair.findings.push_back({value.verdict, value.name, std::move(text), value.place});
    }
    pair.measures.push_back(std::move(value));
  }
}

std::vector<image::Measure> flip_measures(const image::FlipResult& flip) {
  return {{"flip.mean", flip.mean, {}},
          {"flip.weighted_median", flip.weighted_median, {}},
          {"flip.max", flip.maximum, image::PixelPlace{flip.max_x, flip.max_y, -1}}};
}

Verdict settle(const Limits& limits, std::vector<Finding>& findings) {
  std::erase_if(findings, [&](Finding& finding) {
    if (kind_of(finding.check) != nullptr) return false;  // a measure: already judged
    switch (severity_of(limits, finding.check)) {
      case Severity::ignore:
        return true;
      case Severity::warn:
        finding.severity = Verdict::warning;
        return false;
      case Severity::fail:
        finding.severity = Verdict::different;
        return false;
    }
    return false;
  });
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
  return findings.empty() ? Verdict::same : findings.front().severity;
}

void conclude(const Limits& limits, PairResult& pair) {
  pair.verdict = settle(limits, pair.findings);
  for (const MeasuredValue& value : pair.measures)
    pair.verdict = std::max(pair.verdict, value.verdict);
}

}  // namespace skylapse::diff
