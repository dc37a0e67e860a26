// Keys are documented in docs/ci.md; they are added to, never renamed.
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/version.h"
#include "diff/reports.h"
#include "diff/wording.h"

namespace skylapse::diff {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no word for numbers that are not finite.
Json number(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value < 0 ? "-Infinity" : "Infinity";
  return value;
}
Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }
Json limit(double value) { return std::isnan(value) ? Json(nullptr) : number(value); }

Json place_json(const std::optional<Place>& place) {
  if (!place) return nullptr;
  return {{"x", place->x},
          {"y", place->y},
          {"channel", one_line(place->channel)},
          {"azimuth_deg", number(place->azimuth_deg)},
          {"elevation_deg", number(place->elevation_deg)},
          {"from_sun_deg", number(place->from_sun_deg)},
          {"region", one_line(place->region)}};
}

Json findings_json(const std::vector<Finding>& findings) {
  Json list = Json::array();
  for (const Finding& f : findings)
    list.push_back({{"severity", name_of(f.severity)},
                    {"check", one_line(f.check)},
                    {"message", one_line(f.message)},
                    {"place", place_json(f.place)}});
  return list;
}

Json measure_json(const MeasuredValue& m) {
  return {{"name", one_line(m.name)},
          {"unit", m.unit},
          {"value", number(m.value)},
          {"verdict", name_of(m.verdict)},
          {"bad_side", m.below ? "below" : "above"},
          {"warn_limit", limit(m.warn_above)},
          {"fail_limit", limit(m.fail_above)},
          {"limit_ratio", number(limit_ratio(m))},
          {"place", place_json(m.place)}};
}

Json file_json(const FileFacts& f) {
  Json channels = Json::array();
  for (const std::string& c : f.channels) channels.push_back(one_line(c));
  return {{"path", one_line(f.path)},
          {"format", one_line(f.format)},
          {"sample_type", one_line(f.sample_type)},
          {"width", f.width},
          {"height", f.height},
          {"channels", channels},
          {"utc", one_line(f.utc)},
          {"model", one_line(f.model)},
          {"renderer", one_line(f.renderer)}};
}

Json sun_json(const image::SkyView& view) {
  if (!view.sun) return nullptr;
  return {{"azimuth_deg", azimuth(*view.sun).in(deg)},
          {"elevation_deg", elevation(*view.sun).in(deg)}};
}

Json pair_json(const PairResult& pair) {
  Json j{{"name", one_line(pair.name)},     {"verdict", name_of(pair.verdict)},
         {"summary", summary_line(pair)},   {"profile", one_line(pair.profile)},
         {"golden", one_line(pair.golden)}, {"a", file_json(pair.a)},
         {"b", file_json(pair.b)}};
  j["error"] = nullptr;
  if (pair.error)
    j["error"] = {{"message", one_line(pair.error->message)}, {"hint", one_line(pair.error->hint)}};
  j["findings"] = findings_json(pair.findings);
  j["measures"] = Json::array();
  for (const MeasuredValue& m : pair.measures) j["measures"].push_back(measure_json(m));
  j["sun"] = sun_json(pair.view);
  j["milliseconds"] = {{"read", number(pair.read_ms)},
                       {"measure", number(pair.measure_ms)},
                       {"flip", number(pair.flip_ms)}};
  return j;
}

}  // namespace

std::string json_report(const DiffResult& result) {
  const Counts counts = counts_of(result);
  Json j{{"format", "skylapse-diff"},
         {"format_version", 1},
         {"program", std::string("skylapse ") + kVersion},
         {"a", one_line(result.a)},
         {"b", one_line(result.b)},
         {"verdict", name_of(result.verdict)},
         {"unreadable", result.unreadable},
         {"exit_code", exit_code_of(result)},
         {"seconds", number(result.seconds)},
         {"contrasts", result.contrasts},
         {"counts",
          {{"same", counts.same},
           {"warning", counts.warning},
           {"different", counts.different},
           {"unreadable", counts.unreadable}}},
         {"findings", findings_json(result.findings)}};
  j["pairs"] = Json::array();
  for (const PairResult& pair : result.pairs) j["pairs"].push_back(pair_json(pair));
  return j.dump(1) + "\n";
}

}  // namespace skylapse::diff
