#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/study_result.h"

namespace skylapse::study {
namespace {

/// RFC 4180.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

/// A column: its name, and its text for a rung that was measured.
struct Column {
  const char* name;
  std::string (*text)(const SceneResult&, const Measurement&);
};

std::string number(double value) { return fmt::format("{:.6g}", value); }
std::string number(const std::optional<double>& value) { return value ? number(*value) : ""; }

template <SkyRegion region, double ErrorMeasure::*member>
std::string of_region(const SceneResult&, const Measurement& m) {
  const ErrorMeasure& measure = m.errors[region];
  return measure.directions > 0 ? number(measure.*member) : "";
}

template <SkyRegion region>
void add_region(std::vector<Column>& columns, const std::array<const char*, 3>& names) {
  columns.push_back({names[0], of_region<region, &ErrorMeasure::rms>});
  columns.push_back({names[1], of_region<region, &ErrorMeasure::p95>});
  columns.push_back({names[2], of_region<region, &ErrorMeasure::max>});
}

std::vector<Column> columns_of_errors() {
  using S = const SceneResult&;
  using M = const Measurement&;
  std::vector<Column> c;
  add_region<SkyRegion::sky>(c, {"rms", "p95", "max"});
  c.push_back({"raw_rms", of_region<SkyRegion::sky, &ErrorMeasure::raw_rms>});
  c.push_back({"truth_noise", of_region<SkyRegion::sky, &ErrorMeasure::noise>});
  c.push_back({"rms_uncertainty", of_region<SkyRegion::sky, &ErrorMeasure::rms_uncertainty>});
  c.push_back({"directions", [](S, M m) { return std::to_string(m.errors.sky().directions); }});
  add_region<SkyRegion::zenith>(c, {"zenith_rms", "zenith_p95", "zenith_max"});
  add_region<SkyRegion::horizon>(c, {"horizon_rms", "horizon_p95", "horizon_max"});
  add_region<SkyRegion::aureole>(c, {"aureole_rms", "aureole_p95", "aureole_max"});
  add_region<SkyRegion::anti_solar>(c, {"anti_solar_rms", "anti_solar_p95", "anti_solar_max"});
  c.push_back({"disc", [](S, M m) { return number(m.disc); }});
  c.push_back({"sky_irradiance", [](S, M m) { return number(m.irradiance); }});
  c.push_back({"duv_rms", [](S, M m) { return number(m.errors.chromaticity.rms); }});
  c.push_back({"duv_max", [](S, M m) { return number(m.errors.chromaticity.max); }});
  c.push_back({"delta_e_mean", [](S, M m) { return number(m.delta_e.mean); }});
  c.push_back({"delta_e_p95", [](S, M m) { return number(m.delta_e.p95); }});
  c.push_back({"delta_e_max", [](S, M m) { return number(m.delta_e.max); }});
  c.push_back({"sun_arcsec", [](S, M m) { return number(m.sun_arcsec); }});
  return c;
}

std::vector<Column> columns_of_costs() {
  using S = const SceneResult&;
  using M = const Measurement&;
  return {
      {"core_ms", [](S, M m) { return number(m.timing.core().median); }},
      {"core_ms_q1", [](S, M m) { return number(m.timing.core().lower); }},
      {"core_ms_q3", [](S, M m) { return number(m.timing.core().upper); }},
      {"first_core_ms", [](S, M m) { return number(m.timing.first_core_ms); }},
      {"frame_ms", [](S, M m) { return number(m.timing.frame().median); }},
      {"frame_ms_q1", [](S, M m) { return number(m.timing.frame().lower); }},
      {"frame_ms_q3", [](S, M m) { return number(m.timing.frame().upper); }},
      {"frames", [](S, M m) { return std::to_string(m.timing.frame().count); }},
      {"once_ms", [](S, M m) { return number(spread_of(m.timing.once_ms).median); }},
      {"pixels_ms", [](S, M m) { return number(spread_of(m.timing.pixels_ms).median); }},
      {"first_frame_ms", [](S, M m) { return number(m.timing.first_ms); }},
      {"tables_ms", [](S, M m) { return number(m.timing.tables_ms); }},
      {"table_bytes", [](S, M m) { return std::to_string(m.memory.table_bytes); }},
      {"peak_rise_bytes",
       [](S, M m) { return m.memory.peak_rise ? std::to_string(*m.memory.peak_rise) : ""; }},
      {"time_scaled", [](S, M m) { return std::string(m.rung.small_picture ? "yes" : "no"); }},
  };
}

}  // namespace

CostPoint cost_of(const Measurement& measured) {
  const ErrorMeasure& sky = measured.errors.sky();
  return {measured.timing.core().median, std::max(sky.rms, sky.rms_uncertainty)};
}

std::vector<size_t> pareto_front(const std::vector<Measurement>& rungs) {
  std::vector<size_t> order;
  for (size_t i = 0; i < rungs.size(); ++i)
    if (rungs[i].skipped.empty() && std::isfinite(cost_of(rungs[i]).error)) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    const CostPoint x = cost_of(rungs[a]), y = cost_of(rungs[b]);
    return x.ms != y.ms ? x.ms < y.ms : x.error < y.error;
  });
  std::vector<size_t> front;
  for (const size_t i : order)
    if (front.empty() || cost_of(rungs[i]).error < cost_of(rungs[front.back()]).error)
      front.push_back(i);
  return front;
}

int cheapest_within(const std::vector<Measurement>& rungs, double error) {
  for (const size_t i : pareto_front(rungs))
    if (cost_of(rungs[i]).error <= error) return int(i);
  return -1;
}

std::string study_csv(const StudyResult& study) {
  std::vector<Column> columns = columns_of_errors();
  for (const Column& column : columns_of_costs()) columns.push_back(column);
  std::string text = "scene,sun_elevation_deg,height_m,group,rung,label,setting,pareto";
  for (const Column& column : columns) text += fmt::format(",{}", column.name);
  text += ",skipped\n";
  for (const SceneResult& scene : study.scenes) {
    const auto front = pareto_front(scene.rungs);
    for (size_t i = 0; i < scene.rungs.size(); ++i) {
      const Measurement& m = scene.rungs[i];
      const bool on_front = std::find(front.begin(), front.end(), i) != front.end();
      text += fmt::format("{},{:.4f},{:.0f},{},{},{},{},{}", quoted(scene.scene.id),
                          scene.scene.sun_elevation.in(deg), scene.scene.height.in(metre),
                          m.rung.group, m.rung.id, quoted(m.rung.label), quoted(m.rung.setting),
                          on_front ? "yes" : "no");
      for (const Column& column : columns)
        text += "," + (m.skipped.empty() ? column.text(scene, m) : std::string());
      text += "," + quoted(m.skipped) + "\n";
    }
  }
  return text;
}

}  // namespace skylapse::study
