#include "pipeline/library/sheet.h"

#include <fmt/format.h>

#include "pipeline/contact_sheet.h"

namespace skylapse::pipeline {
namespace {

/// "2026-06-21T04:30:00+02:00" as "2026-06-21 04:30".
std::string minute_text(const astro::LocalTime& local) {
  std::string text = format_local(local);
  text[10] = ' ';
  return text.substr(0, 16);
}

size_t output_named(const config::JobConfig& job, const std::string& path) {
  for (size_t o = 0; o < job.outputs.size(); ++o)
    if (std::holds_alternative<config::ImageOutput>(job.outputs[o]) &&
        config::path_of(job.outputs[o]).value == path)
      return o;
  return job.outputs.size();  // not reached: the config has checked the name
}

}  // namespace

std::vector<std::string> choices_of(const config::JobConfig& job, const plan::Frame& frame) {
  std::vector<std::string> choices;
  if (job.air.turbidity.size() > 1)
    choices.push_back(fmt::format("T {:.3g}", job.air.turbidity[frame.turbidity].value));
  const config::Albedo& ground = job.air.ground_albedo[frame.albedo].value;
  if (job.air.ground_albedo.size() > 1)
    choices.push_back((ground.spectral ? "" : "albedo ") + ground.name);
  if (job.cameras.size() > 1) choices.push_back(job.cameras[frame.camera].name);
  return choices;
}

ExistingFrame labelled_frame(const plan::Plan& plan, const plan::Frame& frame,
                             const std::filesystem::path& picture) {
  const config::JobConfig& job = plan.job;
  const std::string site = job.sites[frame.site].name, time = minute_text(frame.local);
  std::string choice;
  for (const std::string& text : choices_of(job, frame)) choice += "  " + text;
  const Angle up = frame.asked_sun ? frame.asked_sun->elevation : elevation(frame.sky.sun_apparent);
  const std::string sun = fmt::format("sun {:.1f}", up.in(deg));
  ExistingFrame labelled{picture, fmt::format("{}  {}  {}{}", site, time, sun, choice), {}};
  // Without the year; without the day; without the site.
  labelled.shorter = {fmt::format("{}  {}  {}{}", site, time.substr(5), sun, choice),
                      fmt::format("{}  {}  {}{}", site, time.substr(11), sun, choice),
                      fmt::format("{}  {}{}", time.substr(5), sun, choice),
                      fmt::format("{}{}", sun, choice)};
  return labelled;
}

Result<std::vector<std::byte>> make_sheet(const JobContext& job,
                                          const config::LibraryOutput& output,
                                          RunSummary& summary) {
  const size_t pictures = output_named(job.plan.job, output.image_path.value);
  std::vector<ExistingFrame> frames;
  for (const plan::Frame& frame : job.plan.frames)
    frames.push_back(labelled_frame(
        job.plan, frame, job.options.output / plan::files_of(job.plan, frame, pictures).front()));
  if (frames.size() > size_t(kMostOnSheet))
    summary.notes.push_back(fmt::format("{} shows {} of {} frames, evenly chosen",
                                        output.path.value, kMostOnSheet, frames.size()));
  SheetSettings settings;
  settings.columns = output.columns;
  settings.max_frames = kMostOnSheet;
  return contact_sheet(job.io, frames, output.format, settings);
}

}  // namespace skylapse::pipeline
