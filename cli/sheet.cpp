#include <fmt/format.h>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "pipeline/contact_sheet.h"

namespace skylapse::cli {
namespace {

const std::vector<std::string> kPictures{"png", "jpg", "jpeg", "tif", "tiff"};
const std::vector<std::string> kLinear{"exr", "hdr"};

/// Display-referred pictures if there are any, else scene-linear ones.
Result<std::vector<pipeline::ExistingFrame>> frames_in(const std::string& folder) {
  auto pictures = pipeline::existing_frames(folder, kPictures);
  if (pictures) return pictures;
  auto linear = pipeline::existing_frames(folder, kLinear);
  return linear ? std::move(linear) : std::move(pictures);
}

struct SheetArguments {
  std::string folder, output;
  pipeline::SheetSettings settings;
};

ExitCode run_sheet(const SheetArguments& arguments, const ConsoleOptions& console) {
  const auto& settings = arguments.settings;
  if (settings.columns < 0 || settings.columns > 200 || settings.thumbnail_width < 16 ||
      settings.thumbnail_width > 2048 || settings.max_frames < 2 || settings.max_frames > 2000)
    return report(option_error("sheet", "a number is out of range",
                               "allowed: --columns 0-200, --width 16-2048, --max 2-2000"));
  const auto frames = frames_in(arguments.folder);
  if (!frames) return report(frames.error());
  const std::filesystem::path file =
      arguments.output.empty() ? std::filesystem::path(arguments.folder) / "contact-sheet.jpg"
                               : std::filesystem::path(arguments.output);
  const Status made = pipeline::make_contact_sheet(*frames, file, settings);
  if (!made) return report(made.error());
  note(console, fmt::format("{} frames: {}", frames->size(), file.string()));
  return ExitCode::done;
}

struct MovieArguments {
  std::string folder, output;
  pipeline::MovieOfFrames settings;
};

ExitCode run_movie(const MovieArguments& arguments, const ConsoleOptions& console) {
  const auto frames = pipeline::existing_frames(arguments.folder, kPictures);
  if (!frames) return report(frames.error());
  const std::filesystem::path file = arguments.output.empty()
                                         ? std::filesystem::path(arguments.folder) / "movie.mp4"
                                         : std::filesystem::path(arguments.output);
  const Status made = pipeline::make_movie_of_frames(*frames, file, arguments.settings);
  if (!made) return report(made.error());
  note(console, fmt::format("{} frames: {}", frames->size(), file.string()));
  return ExitCode::done;
}

}  // namespace

void add_sheet_command(CLI::App& app, Session& session) {
  auto* command = add_command(app, session, "sheet", "Contact sheet of the frames in a folder",
                              "skylapse sheet out --columns 8");
  auto arguments = std::make_shared<SheetArguments>();
  command->add_option("folder", arguments->folder, "Folder with frames")->required();
  command->add_option("-o,--output", arguments->output,
                      "File (.png or .jpg; default: contact-sheet.jpg in the folder)");
  command->add_option("--columns", arguments->settings.columns, "Columns (default: about square)");
  command->add_option("--width", arguments->settings.thumbnail_width, "Width of a picture (240)");
  command->add_option("--max", arguments->settings.max_frames,
                      "Most pictures, evenly chosen (120)");
  command->callback([&session, arguments] {
    session.action = [&session, arguments] { return run_sheet(*arguments, session.console); };
  });
}

void add_movie_command(CLI::App& app, Session& session) {
  auto* command = add_command(app, session, "movie", "Movie of the frames in a folder",
                              "skylapse movie out --fps 24 --output day.mp4");
  auto arguments = std::make_shared<MovieArguments>();
  command->add_option("folder", arguments->folder, "Folder with frames")->required();
  command->add_option("-o,--output", arguments->output,
                      "File (.mp4, .mov, .mkv, .webm; default: movie.mp4 in the folder)");
  command->add_option("--fps", arguments->settings.frames_per_second, "Frames per second (30)");
  command->add_option("--crf", arguments->settings.crf, "Quality: 0 best, 51 worst (18)");
  command->callback([&session, arguments] {
    session.action = [&session, arguments] { return run_movie(*arguments, session.console); };
  });
}

}  // namespace skylapse::cli
