#include "diff/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/printable.h"

namespace skylapse::diff {
namespace {

std::string number_text(double value) {
  if (std::isnan(value)) return "not a number";
  if (std::isinf(value)) return value < 0 ? "minus infinite" : "infinite";
  const double size = std::abs(value);
  if (size >= 1e6) return fmt::format("{:.2e}", value);
  return fmt::format("{:.{}f}", value,
                     size == 0       ? 0
                     : size >= 99.95 ? 0
                     : size < 1e-6   ? 9
                                     : 2 - int(std::floor(std::log10(size))));
}

/// Without the zeros at the end of a fraction: "0.310" is "0.31".
std::string trimmed(std::string text) {
  if (text.find('.') == std::string::npos || text.find('e') != std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

bool is_measure(const PairResult& pair, const std::string& check) {
  return std::ranges::any_of(pair.measures, [&](const auto& m) { return m.name == check; });
}

}  // namespace

std::string value_text(double value, const std::string& unit) {
  const std::string number = trimmed(number_text(unit == "%" ? 100 * value : value));
  return unit.empty() || !std::isfinite(value) ? number : number + " " + unit;
}

std::string place_text(const Place& place) {
  std::string text = fmt::format("at ({}, {})", place.x, place.y);
  if (!place.region.empty()) text += ", " + one_line(place.region);
  if (place.azimuth_deg) text += fmt::format(", az {:.1f}", *place.azimuth_deg);
  if (place.elevation_deg) text += fmt::format(", el {:.1f}", *place.elevation_deg);
  if (!place.channel.empty()) text += ", channel " + one_line(place.channel);
  return text;
}

std::string one_line(const std::string& text) {
  std::string line = printable(text);
  for (char& c : line)
    if (c == '\n' || c == '\t') c = ' ';
  return line;
}

double limit_ratio(const MeasuredValue& m) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const double limit = std::isnan(m.fail_above) ? m.warn_above : m.fail_above;
  if (std::isnan(limit)) return 0;
  if (std::isnan(m.value)) return kInfinite;
  const double over = m.below ? limit : m.value, under = m.below ? m.value : limit;
  if (std::isinf(under)) return std::isinf(over) ? 1 : 0;
  if (over <= 0) return 0;
  return under > 0 ? over / under : kInfinite;
}

const MeasuredValue* worst_measure(const std::vector<MeasuredValue>& measures) {
  const MeasuredValue* worst = nullptr;
  const auto rank = [](const MeasuredValue& m) {
    return std::tuple(m.verdict, limit_ratio(m), std::isfinite(m.value) ? m.value : 0.0);
  };
  for (const MeasuredValue& m : measures) {
    if (limit_ratio(m) == 0 && m.verdict == Verdict::same) continue;
    if (!worst || rank(m) > rank(*worst)) worst = &m;
  }
  return worst;
}

std::vector<const Finding*> structural_findings(const PairResult& pair) {
  std::vector<const Finding*> found;
  for (const Finding& f : pair.findings)
    if (!is_measure(pair, f.check)) found.push_back(&f);
  std::ranges::stable_sort(found, std::greater{}, [](const Finding* f) { return f->severity; });
  return found;
}

std::vector<const MeasuredValue*> displacements(const PairResult& pair) {
  std::vector<const MeasuredValue*> found;
  for (const char* name : {"position.shift_deg", "position.shift_px", "sun.shift_deg"})
    for (const MeasuredValue& m : pair.measures)
      if (m.name == name && m.verdict != Verdict::same) found.push_back(&m);
  return found;
}

Headline headline_of(const PairResult& pair) {
  if (pair.error) return {"unreadable", 0, std::nullopt};
  const auto structural = structural_findings(pair);
  const auto moved = displacements(pair);
  const MeasuredValue* measure = moved.empty() ? worst_measure(pair.measures) : moved.front();
  const bool measure_fails = measure && measure->verdict == Verdict::different;
  if (!structural.empty() && (structural[0]->severity == Verdict::different || !measure_fails))
    return {structural[0]->check, 0, structural[0]->place};
  if (!measure) return {};
  return {measure->name, limit_ratio(*measure), measure->place};
}

std::vector<size_t> worst_first(const std::vector<PairResult>& pairs) {
  using Rank = std::tuple<bool, Verdict, bool, bool, double>;
  std::vector<Rank> ranks;
  for (const PairResult& pair : pairs) {
    const auto structural = structural_findings(pair);
    const MeasuredValue* measure = worst_measure(pair.measures);
    ranks.emplace_back(pair.error.has_value(), pair.verdict,
                       !structural.empty() && structural[0]->severity == Verdict::different,
                       !displacements(pair).empty(), measure ? limit_ratio(*measure) : 0);
  }
  std::vector<size_t> order(pairs.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, [&](size_t i, size_t j) { return ranks[i] > ranks[j]; });
  return order;
}

Counts counts_of(const DiffResult& result) {
  Counts counts;
  for (const PairResult& pair : result.pairs) {
    if (pair.error)
      ++counts.unreadable;
    else if (pair.verdict == Verdict::same)
      ++counts.same;
    else if (pair.verdict == Verdict::warning)
      ++counts.warning;
    else
      ++counts.different;
  }
  return counts;
}

int exit_code_of(const DiffResult& result) { return result.unreadable ? 4 : int(result.verdict); }

}  // namespace skylapse::diff
