#include "cli/plan_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "cli/table.h"
#include "core/parallel.h"
#include "plan/cost_model.h"
#include "plan/effect_planner.h"

namespace skylapse::cli {
namespace {

using nlohmann::ordered_json;

std::string marks_of(const config::JobConfig& job, const plan::Frame& frame) {
  std::string marks;
  for (const auto& decision : plan::decide_effects(job, frame))
    if (decision.on) marks += (marks.empty() ? "" : " ") + name_of(decision.effect);
  return marks + (frame.sun.extrapolated ? " (extrapolated)" : "");
}

Table frame_table(const PlannedWork& work) {
  Table table{
      {"frame", "site", "local", "sun_az", "sun_el", "EV", "model", "effects", "first file"}, {}};
  for (const long number : work.frames) {
    const plan::Frame& frame = work.plan.frames[number - 1];
    table.rows.push_back({{fmt::format("{}", number), true},
                          text_cell(work.plan.job.sites[frame.site].name),
                          text_cell(format_local(frame.local)),
                          number_cell(azimuth(frame.sky.sun_apparent).in(deg), 2),
                          number_cell(elevation(frame.sky.sun_apparent).in(deg), 3),
                          number_cell(frame.ev, 2),
                          text_cell("hosek-wilkie"),
                          text_cell(marks_of(work.plan.job, frame)),
                          text_cell(plan::files_of(work.plan, frame, 0).front())});
  }
  return table;
}

/// Each effect with the frames it is on and off for, and one reason for each kind of decision
/// (reasons that differ in their numbers alone count as one kind).
std::string effect_summary(const PlannedWork& work) {
  struct Kind {
    long frames = 0;
    std::string first_reason;
  };
  std::map<std::tuple<plan::Effect, bool, std::string>, Kind> kinds;
  for (const long number : work.frames)
    for (const auto& d : plan::decide_effects(work.plan.job, work.plan.frames[number - 1])) {
      std::string wording;
      for (const char c : d.reason)
        if (std::string_view("0123456789.-+e").find(c) == std::string_view::npos) wording += c;
      Kind& kind = kinds[{d.effect, !d.on, wording}];
      if (kind.frames++ == 0) kind.first_reason = d.reason;
    }
  std::string text;
  for (const auto& [key, kind] : kinds)
    text += fmt::format("  {:<22} {:<3} in {:>4} frames: {}{}\n", name_of(std::get<0>(key)),
                        std::get<1>(key) ? "off" : "on", kind.frames, kind.first_reason,
                        std::get<1>(key) ? "; error bound 0" : "");
  return text;
}

ordered_json direction_json(const Direction<Enu>& d) {
  return {{"azimuth_deg", azimuth(d).in(deg)}, {"elevation_deg", elevation(d).in(deg)}};
}

}  // namespace

std::string bytes_text(double bytes) {
  const char* units[] = {"B", "kB", "MB", "GB", "TB"};
  int unit = 0;
  while (bytes >= 1000 && unit < 4) bytes /= 1000, ++unit;
  return unit == 0 ? fmt::format("{:.0f} B", bytes) : fmt::format("{:.3g} {}", bytes, units[unit]);
}

std::string duration_text(double seconds) {
  if (seconds < 60) return fmt::format("{:.1f} s", seconds);
  const long whole = long(seconds + 0.5);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::string plan_text(const PlannedWork& work) {
  const plan::Plan& plan = work.plan;
  const plan::Cost cost = plan::estimate_cost(plan, work.frames);
  const long extrapolated = std::count_if(work.frames.begin(), work.frames.end(), [&](long n) {
    return plan.frames[n - 1].sun.extrapolated;
  });
  std::string text = format_table(frame_table(work), TableFormat::table) + "\n";
  text += fmt::format("{}: {} frames of {} (sites {}, air {} x {}, cameras {})\n", plan.job.file,
                      work.frames.size(), plan.frames.size(), plan.job.sites.size(),
                      plan.job.air.turbidity.size(), plan.job.air.ground_albedo.size(),
                      plan.job.cameras.size());
  text += fmt::format("model: {}\n", plan.model_reason);
  text += fmt::format("extrapolated: {} frames with the sun below the horizon\n", extrapolated);
  text += "effects:\n" + effect_summary(work);
  for (const std::string& note : plan.notes) text += "note: " + note + "\n";
  text += fmt::format("estimate: {} on {} cores, {} written\n",
                      duration_text(cost.core_seconds / available_cores()), available_cores(),
                      bytes_text(cost.bytes));
  return text;
}

ordered_json plan_json(const PlannedWork& work) {
  const plan::Plan& plan = work.plan;
  const plan::Cost cost = plan::estimate_cost(plan, work.frames);
  auto frames = ordered_json::array();
  for (const long number : work.frames) {
    const plan::Frame& frame = plan.frames[number - 1];
    auto effects = ordered_json::array();
    for (const auto& d : plan::decide_effects(plan.job, frame)) {
      ordered_json effect{{"effect", name_of(d.effect)}, {"on", d.on}, {"reason", d.reason}};
      if (!d.on) effect["error_bound"] = 0;
      effects.push_back(effect);
    }
    auto files = ordered_json::array();
    for (size_t o = 0; o < plan.job.outputs.size(); ++o)
      for (const auto& file : plan::files_of(plan, frame, o)) files.push_back(file);
    frames.push_back({{"frame", number},
                      {"site", plan.job.sites[frame.site].name},
                      {"utc", format_utc(frame.instant, 3)},
                      {"local", format_local(frame.local)},
                      {"sun", direction_json(frame.sky.sun_apparent)},
                      {"sun_true", direction_json(frame.sky.sun_true)},
                      {"exposure_ev100", frame.ev},
                      {"turbidity", plan.job.air.turbidity[frame.turbidity].value},
                      {"ground_albedo", plan.job.air.ground_albedo[frame.albedo].value.name},
                      {"camera", plan.job.cameras[frame.camera].name},
                      {"model", "hosek-wilkie"},
                      {"extrapolated", frame.sun.extrapolated},
                      {"effects", effects},
                      {"files", files}});
  }
  return {{"config", plan.job.file},
          {"model_reason", plan.model_reason},
          {"notes", plan.notes},
          {"estimate", {{"core_seconds", cost.core_seconds}, {"bytes", cost.bytes}}},
          {"frames", frames}};
}

}  // namespace skylapse::cli
