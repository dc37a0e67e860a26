#include "pipeline/movie_pass.h"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <map>

#include "core/parallel.h"
#include "core/pipeline.h"
#include "core/sha256.h"
#include "output/atomic_file.h"
#include "output/movie_writer.h"
#include "pipeline/fingerprint.h"

namespace skylapse::pipeline {
namespace {

const config::MovieOutput& settings_of(const plan::Plan& plan, const Movie& movie) {
  return std::get<config::MovieOutput>(plan.job.outputs[movie.output]);
}

/// The picture a movie shows, described as the 8-bit image output that would hold it.
config::ImageOutput picture_of(const config::MovieOutput& movie) {
  config::ImageOutput picture;
  picture.format = "png";
  picture.sample_type = output::SampleType::u8;
  picture.display = movie.display;
  picture.view = movie.view ? movie.view : std::optional<std::string>("");
  return picture;
}

/// An image output whose files hold exactly the movie's pictures.
std::optional<size_t> lossless_source(const plan::Plan& plan, const config::MovieOutput& movie) {
  for (size_t o = 0; o < plan.job.outputs.size(); ++o) {
    const auto* image = std::get_if<config::ImageOutput>(&plan.job.outputs[o]);
    if (image == nullptr || (image->format != "png" && image->format != "tif")) continue;
    if (image->own_view || image->content != config::ImageContent::radiance) continue;
    const bool displayed = image->display || image->view;
    if (displayed && image->sample_type == output::SampleType::u8 &&
        image->display.value_or("") == movie.display.value_or("") &&
        image->view.value_or("") == movie.view.value_or(""))
      return o;
  }
  return {};
}

/// One frame of a movie between the stages.
struct Picture {
  std::vector<uint8_t> rgb;
  std::optional<Error> error;
};

Picture read_picture(const JobContext& job, const plan::Frame& frame, size_t source) {
  auto image = job.io.decode(job.options.output / plan::files_of(job.plan, frame, source).front());
  if (!image) return {{}, image.error()};
  Picture picture;
  picture.rgb.resize(image->pixels.data().size());
  std::transform(image->pixels.data().begin(), image->pixels.data().end(), picture.rgb.begin(),
                 [](float v) { return uint8_t(v * 255.0f + 0.5f); });
  return picture;
}

Picture make_picture(const JobContext& job, const Movie& movie, const plan::Frame& frame,
                     const std::optional<size_t>& source) {
  const bool faces_apart = job.plan.job.cameras[frame.camera].cube_faces_apart;
  if (source && !faces_apart) return read_picture(job, frame, *source);
  StageTimes times;
  const auto rendered =
      render_frame(job.plan, frame, job.atmospheres, false, times, job.report_paths());
  if (!rendered) return {{}, rendered.error()};
  return {display_picture(frame, *rendered, *job.displays.of(movie.output), times), {}};
}

struct FrameOfMovie {
  long number = 0;
  Picture picture;
};

Status encode_movie(const JobContext& job, const Movie& movie, RunSummary& summary) {
  const config::MovieOutput& settings = settings_of(job.plan, movie);
  const image::Camera& camera = job.plan.job.cameras[job.frame(movie.frames.front()).camera].camera;
  auto writer = output::MovieWriter::open(
      job.options.output / movie.path,
      {camera.width, camera.height, settings.frames_per_second, settings.crf});
  if (!writer) return writer.error();
  const auto source = lossless_source(job.plan, settings);
  std::optional<Error> error;
  std::atomic<bool> failed = false;
  size_t next = 0;
  long written = 0;
  const auto start = std::chrono::steady_clock::now();
  const auto feed = [&]() -> std::optional<FrameOfMovie> {
    if (next == movie.frames.size() || failed || job.stopped()) return {};
    return FrameOfMovie{movie.frames[next++], {}};
  };
  const auto add = [&](FrameOfMovie& frame) {
    if (failed) return;
    const Picture& picture = frame.picture;
    const Status added = picture.error ? Status(*picture.error) : writer->add_frame(picture.rgb);
    if (!added) error = added.error(), failed = true;
    if (job.options.on_progress)
      job.options.on_progress(
          {++written, long(movie.frames.size()), 0,
           std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
           movie.path});
  };
  run_pipeline<FrameOfMovie>(
      size_t(frames_in_flight(job.plan, available_cores())), feed,
      [&](FrameOfMovie& frame) {
        frame.picture = make_picture(job, movie, job.frame(frame.number), source);
      },
      add, FinishOrder::as_made);
  if (error) return *error;
  if (job.stopped()) return interrupted();
  const Status finished = writer->finish();
  if (!finished) return finished;
  const auto bytes = output::read_file(job.options.output / movie.path);
  if (!bytes) return bytes.error();
  summary.bytes_written += bytes->size();
  return job.ledger.record(
      {movie.path, fingerprint_of(job, movie), sha256_hex(*bytes), bytes->size(), {}, {}, {}});
}

bool frames_ready(const JobContext& job, const Movie& movie) {
  const auto source = lossless_source(job.plan, settings_of(job.plan, movie));
  if (!source) return true;
  return std::all_of(movie.frames.begin(), movie.frames.end(),
                     [&](long n) { return job.recorded(job.frame(n), *source); });
}

}  // namespace

std::vector<Movie> movies_of(const plan::Plan& plan) {
  std::vector<Movie> movies;
  for (size_t o = 0; o < plan.job.outputs.size(); ++o) {
    if (!std::holds_alternative<config::MovieOutput>(plan.job.outputs[o])) continue;
    std::map<std::string, size_t> known;
    for (const plan::Frame& frame : plan.frames) {
      const auto [entry, fresh] = known.try_emplace(frame.paths[o], movies.size());
      if (fresh) movies.push_back({o, frame.paths[o], {}});
      movies[entry->second].frames.push_back(frame.index);
    }
  }
  return movies;
}

std::string fingerprint_of(const JobContext& job, const Movie& movie) {
  const config::MovieOutput& settings = settings_of(job.plan, movie);
  std::vector<std::string> prints;
  for (const long number : movie.frames)
    prints.push_back(
        image_fingerprint(job.plan, job.frame(number), picture_of(settings), job.color_config));
  return movie_fingerprint(settings, prints);
}

Status check_movies_possible(const plan::Plan& plan) {
  const auto movies = movies_of(plan);
  if (movies.empty()) return Done{};
  const auto ffmpeg = output::find_ffmpeg();
  if (!ffmpeg) {
    Error error = ffmpeg.error();
    error.span = settings_of(plan, movies.front()).path.span;
    return error;
  }
  for (const Movie& movie : movies) {
    const auto& first = plan.job.cameras[plan.frames[movie.frames.front() - 1].camera].camera;
    for (const long number : movie.frames) {
      const auto& camera = plan.job.cameras[plan.frames[number - 1].camera].camera;
      if (camera.width != first.width || camera.height != first.height)
        return Error{ErrorCode::invalid_input,
                     fmt::format("the movie '{}' would mix frames of different sizes", movie.path),
                     settings_of(plan, movie).path.span, "add {camera} to its name"};
    }
  }
  return Done{};
}

Status make_movies(const JobContext& job, RunSummary& summary) {
  const bool whole_job =
      job.options.shard.parts > 1 || job.options.frames.size() == job.plan.frames.size();
  for (const Movie& movie : movies_of(job.plan)) {
    if (!job.options.overwrite && job.ledger.finished(movie.path, fingerprint_of(job, movie)))
      continue;
    if (!whole_job || !frames_ready(job, movie)) {
      summary.notes.push_back(fmt::format(
          "{} is left out: not all of its {} frames are there; render the whole job to make it",
          movie.path, movie.frames.size()));
      continue;
    }
    const auto lock = FolderLock::take(job.options.output);
    if (!lock) return lock.error();
    const Status refreshed = job.ledger.refresh();
    if (!refreshed) return refreshed;
    if (!job.options.overwrite && job.ledger.finished(movie.path, fingerprint_of(job, movie)))
      continue;  // another shard was quicker
    const Status made = encode_movie(job, movie, summary);
    if (!made) return made;
  }
  return Done{};
}

}  // namespace skylapse::pipeline
