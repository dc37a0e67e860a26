#include "config/output_section.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/path_template.h"

namespace skylapse::config {
namespace {

bool day_has_several_times(const Sampling& sampling) {
  if (const auto* list = std::get_if<ExplicitTimes>(&sampling)) return list->times.size() > 1;
  if (const auto* count = std::get_if<FrameCount>(&sampling)) return count->count > 1;
  if (const auto* sun = std::get_if<SunElevations>(&sampling))
    return sun->elevations.size() > 1 || sun->half == SunElevations::Half::both;
  return true;
}

bool job_has_several_days(const TimePlan& time) {
  const auto& dates = time.dates;
  return dates.size() > 1 || (dates.size() == 1 && dates[0].first != dates[0].last);
}

}  // namespace

OutputItem::OutputItem(const Section& item, const JobConfig& whole, const ReadContext& reading)
    : section(item), path_key(item.spec->keys[0].name), job(whole), context(reading) {
  path = normalised_path(section.get<std::string>(path_key).value_or(""));
  tokens = tokens_in(path);
}

bool OutputItem::has_token(std::string_view name) const {
  return std::find(tokens.begin(), tokens.end(), name) != tokens.end();
}

Spanned<std::string> OutputItem::spanned_path() const {
  return {path, context.sources.span(section.place_of(path_key))};
}

SourceSpan OutputItem::span_of_first(std::initializer_list<std::string_view> keys) const {
  for (const std::string_view key : keys)
    if (section.has(key)) return context.sources.span(section.place_of(key));
  return context.sources.span(section.place_of(path_key));
}

void OutputItem::refuse_path(std::string message, std::string hint) const {
  context.errors.add(section.place_of(path_key),
                     fmt::format("{}: {}", section.path_of(path_key), message), std::move(hint));
}

void OutputItem::no_meaning(std::string_view key, std::string hint) const {
  context.errors.add(section.field(key)->key_place,
                     fmt::format("{} has no meaning here", section.path_of(key)), std::move(hint));
}

bool OutputItem::allowed_place() const {
  if (is_reserved_path(path)) {
    refuse_path("this name belongs to the program's own records",
                "manifest.json and .skylapse are kept at the top of the output folder");
    return false;
  }
  if (job.allow_outside_paths || !leaves_folder(path)) return true;
  refuse_path("this leaves the output folder",
              "use a name inside it, or add \"allow_outside_paths: on\" at the top level");
  return false;
}

std::optional<std::string> OutputItem::format_of(const Endings& endings, std::string_view what,
                                                 std::string hint) const {
  const std::string ending = extension_of(path);
  std::string allowed;
  for (const auto& [known, format] : endings) {
    if (known == ending) return std::string(format);
    allowed += fmt::format("{}.{}", allowed.empty() ? "" : ", ", known);
  }
  refuse_path(ending.empty() ? "the name has no ending"
                             : fmt::format("no {} format ends in .{}", what, ending),
              hint.empty() ? "allowed: " + allowed : std::move(hint));
  return std::nullopt;
}

void OutputItem::check_names_of_frames() const {
  if (has_token("#")) return;
  const auto* sun = std::get_if<SunElevations>(&job.time.sampling);
  const bool told_by_sun = sun != nullptr &&
                           (sun->elevations.size() == 1 || has_token("sun_elevation")) &&
                           (sun->half != SunElevations::Half::both || has_token("half"));
  if (day_has_several_times(job.time.sampling) && !has_token("time") && !told_by_sun)
    refuse_path("all frames of a day would be written to one file",
                sun != nullptr && sun->half == SunElevations::Half::both
                    ? "add {time}, or {sun_elevation} and {half}, to the name"
                : sun != nullptr ? "add {time} or {sun_elevation} to the name"
                                 : "add #### (the frame number) or {time} to the name");
  else if (job_has_several_days(job.time) && !has_token("date"))
    refuse_path("the frames of all days would be written to one file",
                "add #### (the frame number) or {date} to the name");
  if (sun == nullptr)
    refuse_tokens({"half"}, "has no meaning here", "it belongs to time.sun_elevations");
}

void OutputItem::refuse_tokens(std::initializer_list<std::string_view> names, std::string_view why,
                               std::string_view hint) const {
  for (const std::string_view token : names)
    if (has_token(token)) refuse_path(fmt::format("{{{}}} {}", token, why), std::string(hint));
}

}  // namespace skylapse::config
