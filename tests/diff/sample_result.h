#pragma once
// Results of comparisons that never ran, for the tests of what reports say of them.
#include "diff/diff_result.h"

namespace skylapse::diff {

inline MeasuredValue measured(const std::string& name, const std::string& unit, double value,
                              double warn, double fail,
                              const std::optional<Place>& place = std::nullopt) {
  MeasuredValue m{name, unit, value, warn, fail, false, Verdict::same, place};
  if (!(value <= warn)) m.verdict = Verdict::warning;
  if (!(value <= fail)) m.verdict = Verdict::different;
  if (std::isnan(warn) && std::isnan(fail)) m.verdict = Verdict::same;
  return m;
}

inline Place place_at(int x, int y, double azimuth, double elevation, const std::string& region) {
  Place place{x, y, "", azimuth, elevation, std::nullopt, region};
  return place;
}

/// A pair that agrees to a hundredth of its limits.
inline PairResult sample_pair(const std::string& name) {
  PairResult pair;
  pair.name = name;
  pair.a = {"golden/" + name, "openexr", "float",        256, 128,
            {"R", "G", "B"},  "",        "hosek-wilkie", ""};
  pair.b = pair.a;
  pair.b.path = "out/" + name;
  pair.profile = "cross-renderer";
  pair.measures = {measured("relative.max", "%", 1e-4, 0.005, 0.01,
                            place_at(180, 40, 182.4, 40.1, "sun's disc")),
                   measured("relative.rms", "%", 1e-5, 0.001, 0.002),
                   measured("sun.shift_deg", "deg", 0, 0.02, 0.05),
                   measured("flip.mean", "", 1e-4, kNone, kNone)};
  return pair;
}

inline MeasuredValue& measure_of(PairResult& pair, const std::string& name) {
  for (MeasuredValue& m : pair.measures)
    if (m.name == name) return m;
  pair.measures.push_back({name, "", 0, kNone, kNone, false, Verdict::same, std::nullopt});
  return pair.measures.back();
}

/// Lets a measure of the pair fail, as the judge would.
inline void fail_measure(PairResult& pair, const std::string& name, double value,
                         const std::optional<Place>& place = std::nullopt) {
  MeasuredValue& m = measure_of(pair, name);
  m.value = value, m.verdict = Verdict::different, m.place = place;
  pair.verdict = Verdict::different;
  pair.findings.push_back({Verdict::different, name, name + " is beyond its limit", place});
}

inline PairResult unreadable_pair(const std::string& name) {
  PairResult pair = sample_pair(name);
  pair.measures.clear();
  pair.verdict = Verdict::different;
  pair.error = Error{
      ErrorCode::missing_input, "out/" + name + ": the file is cut short", {}, "render it again"};
  return pair;
}

}  // namespace skylapse::diff
