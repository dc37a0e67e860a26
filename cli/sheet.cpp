#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "pipeline/contact_sheet.h"

namespace skylapse::cli {
namespace {

const std::vector<std::string> kPictures{"png", "jpg", "jpeg", "tif", "tiff"};
const std::vector<std::string> kLinear{"exr", "hdr"};

const std::vector<std::string> kSheets{"png", "jpg", "jpeg"};
const std::vector<std::string> kMovies{"mp4", "mov", "mkv", "webm"};

/// The file to write, refused before any frame is read if its extension is none of `known`.
Result<std::filesystem::path> target(const std::string& output, const std::filesystem::path& absent,
                                     const std::vector<std::string>& known) {
  if (output.empty()) return absent;
  const std::filesystem::path file = output;
  if (pipeline::has_extension(file, known)) return file;
  return option_error("--output", fmt::format("'{}' is no file of a known kind", output),
                      fmt::format("allowed: .{}", fmt::join(known, ", .")));
}

/// One JSON document, or a note for people.
void print_made(const ConsoleOptions& console, const std::filesystem::path& file, size_t frames) {
  if (console.json)
    print(json_text(nlohmann::ordered_json{{"file", file.string()}, {"frames", frames}}));
  else
    note(console, fmt::format("{} frames: {}", frames, file.string()));
}

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
  const auto file = target(arguments.output,
                           std::filesystem::path(arguments.folder) / "contact-sheet.jpg", kSheets);
  if (!file) return report(file.error());
  const auto frames = frames_in(arguments.folder);
  if (!frames) return report(frames.error());
  const Status made = pipeline::make_contact_sheet(*frames, *file, settings);
  if (!made) return report(made.error());
  print_made(console, *file, std::min(frames->size(), size_t(settings.max_frames)));
  return ExitCode::done;
}

struct MovieArguments {
  std::string folder, output;
  pipeline::MovieOfFrames settings;
};

ExitCode run_movie(const MovieArguments& arguments, const ConsoleOptions& console) {
  const auto file =
      target(arguments.output, std::filesystem::path(arguments.folder) / "movie.mp4", kMovies);
  if (!file) return report(file.error());
  const auto frames = pipeline::existing_frames(arguments.folder, kPictures);
  if (!frames) return report(frames.error());
  const Status made = pipeline::make_movie_of_frames(*frames, *file, arguments.settings);
  if (!made) return report(made.error());
  print_made(console, *file, frames->size());
  return ExitCode::done;
}

}  // namespace

void add_sheet_command(CLI::App& app, Session& session) {
  auto* command = add_command(app, session, "sheet", "Contact sheet of the frames in a folder",
                              "skylapse sheet out --columns 8");
  auto arguments = std::make_shared<SheetArguments>();
  command->add_option("folder", arguments->folder, "Folder with frames")->required();
  add_output_option(*command, arguments->output,
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
  add_output_option(*command, arguments->output,
                    "File (.mp4, .mov, .mkv, .webm; default: movie.mp4 in the folder)");
  command->add_option("--fps", arguments->settings.frames_per_second, "Frames per second (30)");
  command->add_option("--crf", arguments->settings.crf, "Quality: 0 best, 51 worst (18)");
  command->callback([&session, arguments] {
    session.action = [&session, arguments] { return run_movie(*arguments, session.console); };
  });
}

}  // namespace skylapse::cli
