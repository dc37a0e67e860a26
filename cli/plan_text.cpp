#include "cli/plan_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <tuple>

#include "cli/table.h"
#include "config/words.h"
#include "core/parallel.h"
#include "pipeline/promise_json.h"
#include "pipeline/run_job.h"
#include "plan/cost_model.h"
#include "plan/effect_planner.h"

namespace skylapse::cli {
namespace {

using nlohmann::ordered_json;

/// The effects that are on in every frame: said once, not in each line.
sky::EffectSet common_effects(const PlannedWork& work) {
  sky::EffectSet common;
  for (const auto& [name, effect] : sky::kEffectNames) common.set(effect);
  for (const long number : work.frames) {
    const auto of_frame = plan::effects_of(work.plan, work.plan.frames[number - 1]);
    for (const auto& [name, effect] : sky::kEffectNames)
      common.set(effect, common.has(effect) && of_frame.has(effect));
  }
  return common;
}

std::string names_of(sky::EffectSet set) {
  std::string names;
  for (const auto& [name, effect] : sky::kEffectNames)
    if (set.has(effect)) names += (names.empty() ? "" : " ") + std::string(name);
  return names;
}

/// What a frame has beside the common effects.
std::string marks_of(const plan::Plan& plan, const plan::Frame& frame, sky::EffectSet common) {
  sky::EffectSet own = plan::effects_of(plan, frame);
  for (const auto& [name, effect] : sky::kEffectNames)
    own.set(effect, own.has(effect) && !common.has(effect));
  return names_of(own) + (frame.sun.extrapolated ? " (extrapolated)" : "");
}

Table frame_table(const PlannedWork& work, sky::EffectSet common) {
  Table table{
      {"frame", "site", "local", "sun_az", "sun_el", "EV", "model", "own effects", "first file"},
      {}};
  for (const long number : work.frames) {
    const plan::Frame& frame = work.plan.frames[number - 1];
    table.rows.push_back({{fmt::format("{}", number), true},
                          text_cell(work.plan.job.sites[frame.site].name),
                          text_cell(format_local(frame.local)),
                          number_cell(azimuth(frame.sky.sun_apparent).in(deg), 2),
                          number_cell(elevation(frame.sky.sun_apparent).in(deg), 3),
                          number_cell(frame.ev, 2),
                          text_cell(plan::name_of(work.plan.model)),
                          text_cell(marks_of(work.plan, frame, common)),
                          text_cell(plan::files_of(work.plan, frame, 0).front())});
  }
  return table;
}

/// More decimals than a reason has: such numbers are written with three digits.
constexpr int kSignificant = 9;

std::string number_text(double number, int decimals) {
  if (decimals > 3) return fmt::format("{:.3g}", number);
  return fmt::format("{:.{}f}", number, decimals);
}

/// A reason split at its first number, so that reasons that differ in it alone count as one.
struct Wording {
  std::string before, after;
  double number = 0;
  int decimals = -1;  // -1: there is no number
};

Wording wording_of(const std::string& reason) {
  const size_t begin = reason.find_first_of("0123456789");
  if (begin == std::string::npos) return {reason, "", 0, -1};
  const size_t from = begin > 0 && reason[begin - 1] == '-' ? begin - 1 : begin;
  char* end = nullptr;
  const double number = std::strtod(reason.c_str() + from, &end);
  const std::string text(reason.c_str() + from, static_cast<const char*>(end));
  const size_t point = text.find('.');
  const bool exponent = text.find('e') != std::string::npos;
  return {reason.substr(0, from), end, number,
          exponent                     ? kSignificant
          : point == std::string::npos ? 0
                                       : int(text.size() - point - 1)};
}

std::string bound_text(const std::optional<double>& bound) {
  if (!bound) return "; error not bounded";
  return *bound > 1e3 ? "; it would show" : fmt::format("; error bound {:.2g}", *bound);
}

/// What an effect spends, or what is saved without it at which error.
std::string cost_text(bool off, double core_seconds, const std::optional<double>& bound) {
  const std::string cost =
      core_seconds > 0 ? fmt::format("; {} {:.2g} core s", off ? "saves" : "costs", core_seconds)
                       : "";
  return off ? bound_text(bound) + cost : cost;
}

/// The tables of a computed atmosphere, or nothing.
std::string atmosphere_text(const plan::Plan& plan, const plan::Cost& cost) {
  if (plan::is_fitted(plan.model)) return "";
  const config::Sky& sky = plan.job.sky;
  std::string text = fmt::format("atmosphere: {} wavelengths", sky.wavelengths);
  if (plan.model == config::SkyModel::bruneton)
    text += fmt::format(
        ", level {}, {} set{} of tables ({} of memory, {} to compute unless cached)",
        sky::bruneton::name_of(sky.level), cost.table_sets, cost.table_sets == 1 ? "" : "s",
        bytes_text(cost.table_bytes), duration_text(cost.table_core_seconds / available_cores()));
  return text + "\n";
}

/// Projection and size of what an output shows; empty for a file without pixels.
std::string shown_size(const plan::Plan& plan, const plan::Frame& frame, size_t output) {
  const auto* product = std::get_if<config::ProductOutput>(&plan.job.outputs[output]);
  if (product != nullptr && !product->view) return "";
  const auto& view = plan::view_of(plan, frame, output).camera;
  const std::string levels =
      product != nullptr && product->levels > 0 ? fmt::format(", {} levels", product->levels) : "";
  return fmt::format("{} {}{}", config::word_of(config::kProjectionWords, view.projection),
                     plan::size_label(view), levels);
}

/// Each effect with the frames it is on and off for, and the reasons, numbers as a range.
std::string effect_summary(const PlannedWork& work) {
  struct Kind {
    long frames = 0;
    double low = 0, high = 0;
    int decimals = -1;
    std::optional<double> bound;  // the greatest
    double core_seconds = 0;      // of all frames
  };
  // Effect, off, reason before and after its number, whether the error is bounded.
  using Key = std::tuple<plan::Effect, bool, std::string, std::string, bool>;
  std::map<Key, Kind> kinds;
  for (const long number : work.frames)
    for (const auto& d : plan::decide_effects(work.plan, work.plan.frames[number - 1])) {
      const Wording wording = wording_of(d.reason);
      Kind& kind = kinds[{d.effect, !d.on, wording.before, wording.after,
                          d.on || d.error_bound.has_value()}];
      if (d.error_bound) kind.bound = std::max(kind.bound.value_or(0), *d.error_bound);
      kind.core_seconds += d.core_seconds;
      kind.low = kind.frames == 0 ? wording.number : std::min(kind.low, wording.number);
      kind.high = kind.frames == 0 ? wording.number : std::max(kind.high, wording.number);
      kind.decimals = std::max(kind.decimals, wording.decimals);
      ++kind.frames;
    }
  std::string text;
  for (const auto& [key, kind] : kinds) {
    std::string range;
    if (kind.decimals >= 0) {
      range = number_text(kind.low, kind.decimals);
      if (kind.high > kind.low) range += " to " + number_text(kind.high, kind.decimals);
    }
    text +=
        fmt::format("  {:<22} {:<3} in {:>4} frames: {}{}{}{}\n", name_of(std::get<0>(key)),
                    std::get<1>(key) ? "off" : "on", kind.frames, std::get<2>(key), range,
                    std::get<3>(key), cost_text(std::get<1>(key), kind.core_seconds, kind.bound));
  }
  return text;
}

/// What is written: each output with its files, time and bytes; the sky itself apart.
Table output_table(const PlannedWork& work, const plan::Cost& cost) {
  const plan::Plan& plan = work.plan;
  Table table{{"output", "files", "core s", "bytes", "size"}, {}};
  for (size_t o = 0; o < plan.job.outputs.size(); ++o) {
    const config::Output& output = plan.job.outputs[o];
    size_t files = config::is_per_frame(output) ? 0 : 1;
    std::string size;
    if (config::is_per_frame(output))
      for (const long number : work.frames) {
        const plan::Frame& frame = plan.frames[number - 1];
        files += plan::files_of(plan, frame, o).size();
        size = shown_size(plan, frame, o);
      }
    table.rows.push_back({text_cell(config::path_of(output).value),
                          {fmt::format("{}", files), true},
                          number_cell(cost.outputs[o].core_seconds, 2),
                          {bytes_text(cost.outputs[o].bytes), true},
                          text_cell(size)});
  }
  return table;
}

ordered_json outputs_json(const PlannedWork& work, const plan::Cost& cost) {
  auto outputs = ordered_json::array();
  for (size_t o = 0; o < cost.outputs.size(); ++o)
    outputs.push_back({{"output", config::path_of(work.plan.job.outputs[o]).value},
                       {"core_seconds", cost.outputs[o].core_seconds},
                       {"bytes", cost.outputs[o].bytes}});
  return outputs;
}

ordered_json atmosphere_json(const plan::Plan& plan, const plan::Cost& cost) {
  if (plan::is_fitted(plan.model)) return nullptr;
  return {{"level", sky::bruneton::name_of(plan.job.sky.level)},
          {"wavelengths", plan.job.sky.wavelengths},
          {"table_sets", cost.table_sets},
          {"table_core_seconds", cost.table_core_seconds},
          {"table_bytes", cost.table_bytes}};
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
  const sky::EffectSet common = common_effects(work);
  std::string text = format_table(frame_table(work, common), TableFormat::table) + "\n";
  text += fmt::format("{}: {} frames of {} (sites {}, air {} x {}, cameras {})\n", plan.job.file,
                      work.frames.size(), plan.frames.size(), plan.job.sites.size(),
                      plan.job.air.turbidity.size(), plan.job.air.ground_albedo.size(),
                      plan.job.cameras.size());
  text += fmt::format("model: {}\n", plan.model_reason);
  if (plan.promise) text += promise_text(*plan.promise);
  text += atmosphere_text(plan, cost);
  if (extrapolated > 0)
    text += fmt::format("extrapolated: {} frames with the sun below the horizon\n", extrapolated);
  text += "in every frame: " + names_of(common) + "\neffects:\n" + effect_summary(work);
  for (const std::string& note : plan.notes) text += "note: " + note + "\n";
  text += "\n" + format_table(output_table(work, cost), TableFormat::table) + "\n";
  text += fmt::format("estimate: {} on {} cores, {} written, {} of memory for pictures\n",
                      duration_text(cost.core_seconds / available_cores()), available_cores(),
                      bytes_text(cost.bytes),
                      bytes_text(pipeline::picture_memory(plan, available_cores())));
  return text;
}

ordered_json plan_json(const PlannedWork& work) {
  const plan::Plan& plan = work.plan;
  const plan::Cost cost = plan::estimate_cost(plan, work.frames);
  auto frames = ordered_json::array();
  for (const long number : work.frames) {
    const plan::Frame& frame = plan.frames[number - 1];
    auto effects = ordered_json::array();
    for (const auto& d : plan::decide_effects(plan, frame)) {
      ordered_json effect{{"effect", name_of(d.effect)},
                          {"on", d.on},
                          {"reason", d.reason},
                          {"core_seconds", d.core_seconds}};
      if (!d.on) effect["error_bound"] = d.error_bound ? ordered_json(*d.error_bound) : nullptr;
      effects.push_back(effect);
    }
    auto files = ordered_json::array();
    for (size_t o = 0; o < plan.job.outputs.size(); ++o)
      if (!std::holds_alternative<config::LibraryOutput>(plan.job.outputs[o]))
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
                      {"model", plan::name_of(plan.model)},
                      {"extrapolated", frame.sun.extrapolated},
                      {"effects", effects},
                      {"files", files}});
  }
  return {{"config", plan.job.file},
          {"model", plan::name_of(plan.model)},
          {"model_reason", plan.model_reason},
          {"promise", pipeline::promise_json(plan)},
          {"atmosphere", atmosphere_json(plan, cost)},
          {"notes", plan.notes},
          {"estimate",
           {{"core_seconds", cost.core_seconds},
            {"bytes", cost.bytes},
            {"picture_memory_bytes", pipeline::picture_memory(plan, available_cores())},
            {"outputs", outputs_json(work, cost)}}},
          {"frames", frames}};
}

}  // namespace skylapse::cli
