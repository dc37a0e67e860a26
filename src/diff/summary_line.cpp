#include <fmt/format.h>

#include <cmath>

#include "diff/wording.h"

namespace skylapse::diff {
namespace {

/// "sun's disc 0.31 deg off (az 182.4, el 40.1)".
std::string displacement_text(const std::vector<const MeasuredValue*>& moved) {
  const MeasuredValue& first = *moved.front();
  std::string text = first.name == "sun.shift_deg" ? "sun's disc " : "picture ";
  text += value_text(first.value, first.unit);
  if (moved.size() > 1 && moved[1]->name == "position.shift_px")
    text += fmt::format(" ({})", value_text(moved[1]->value, moved[1]->unit));
  text += " off";
  if (first.place && first.place->azimuth_deg && first.place->elevation_deg)
    text += fmt::format(" (az {:.1f}, el {:.1f})", *first.place->azimuth_deg,
                        *first.place->elevation_deg);
  else if (first.place)
    text += " " + place_text(*first.place);
  return text;
}

/// Where the pair is worst, for measures of the whole picture, which are nowhere.
std::string worst_place_text(const PairResult& pair) {
  const MeasuredValue* worst = nullptr;
  for (const MeasuredValue& m : pair.measures)
    if (m.place && m.verdict != Verdict::same &&
        (worst == nullptr || limit_ratio(m) > limit_ratio(*worst)))
      worst = &m;
  return worst != nullptr ? ", worst " + place_text(*worst->place) : "";
}

/// "relative.max 94 % (limit 1 %) at (180, 40)".
std::string measure_text(const MeasuredValue& m) {
  const double limit =
      m.verdict == Verdict::warning || std::isnan(m.fail_above) ? m.warn_above : m.fail_above;
  std::string text = one_line(m.name) + " " + value_text(m.value, m.unit);
  if (!std::isnan(limit)) text += fmt::format(" (limit {})", value_text(limit, m.unit));
  if (m.place && m.value != 0) text += " " + place_text(*m.place);
  return text;
}

std::string structural_text(const std::vector<const Finding*>& findings) {
  const Finding& first = *findings.front();
  std::string text = one_line(first.check) + ": " + one_line(first.message);
  if (findings.size() > 1) text += fmt::format(" (+{} more)", findings.size() - 1);
  return text;
}

}  // namespace

std::string summary_text(const PairResult& pair) {
  if (pair.error) return one_line(pair.error->message);
  const auto structural = structural_findings(pair);
  const auto moved = displacements(pair);
  const MeasuredValue* measure = worst_measure(pair.measures);
  std::vector<std::string> parts;
  if (!structural.empty()) parts.push_back(structural_text(structural));
  if (!moved.empty()) parts.push_back(displacement_text(moved));
  for (const MeasuredValue& m : pair.measures)
    if (m.name == "exposure.shift_ev" && pair.verdict != Verdict::same)
      parts.push_back(value_text(std::fabs(m.value), m.unit) +
                      (m.value > 0 ? " brighter" : " darker"));
  const bool told = !moved.empty() && measure && measure->name == moved.front()->name;
  if (measure && measure->verdict != Verdict::same && !told)
    parts.push_back(measure_text(*measure) + (measure->place ? "" : worst_place_text(pair)));
  if (pair.verdict == Verdict::same && parts.empty()) {
    bool zero = !pair.measures.empty();
    for (const MeasuredValue& m : pair.measures) zero = zero && (m.value == 0 || m.below);
    if (zero) return "no difference";
    return measure ? "nearest to its limit: " + measure_text(*measure) : "";
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string summary_line(const PairResult& pair) {
  const std::string text = summary_text(pair);
  std::string line = fmt::format("{:<10} {}", pair.error ? "unreadable" : name_of(pair.verdict),
                                 one_line(pair.name));
  if (!text.empty()) line += "  " + text;
  if (!pair.golden.empty() && !pair.error && pair.verdict != Verdict::same)
    line += fmt::format(" [golden of {}]", one_line(pair.golden));
  return line;
}

}  // namespace skylapse::diff
