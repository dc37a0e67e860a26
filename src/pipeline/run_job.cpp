#include "pipeline/run_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <set>

#include "core/parallel.h"
#include "core/pipeline.h"
#include "output/atomic_file.h"
#include "pipeline/fingerprint.h"
#include "pipeline/job_context.h"
#include "pipeline/library/library_pass.h"
#include "pipeline/manifest.h"
#include "pipeline/movie_pass.h"

namespace skylapse::pipeline {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Files that hold other light than they should.
struct WrongLight {
  long files = 0;
  double percent = 0;  // the most that one of them is off
  std::string path;    // that one

  void merge(const WrongLight& other) {
    files += other.files;
    if (other.files > 0 && (path.empty() || other.percent > percent))
      percent = other.percent, path = other.path;
  }
};

/// Nine harmonics, and levels that roughness has blurred over the horizon, are off in any encoding.
bool by_theory(const LedgerEntry& entry) {
  const auto roughness = entry.encoding.find("roughness");
  return entry.encoding.contains("terms") ||
         (roughness != entry.encoding.end() && roughness->second > 0);
}

/// Why files hold other light: the sun policy `clip`, half floats, few pixels.
struct EncodingLosses {
  WrongLight clipped, halves, coarse;

  void take(const LedgerEntry& entry) {
    constexpr double kPromisedPercent = 0.5;
    const auto find = [&](const char* key) -> std::optional<double> {
      const auto found = entry.encoding.find(key);
      return found == entry.encoding.end() ? std::nullopt : std::optional(found->second);
    };
    const auto share = find("clipped_fraction"), error = find("error_percent");
    const double percent = std::fabs(error ? *error : 100 * share.value_or(0));
    if (share)
      clipped.merge({1, percent, entry.path});
    else if (percent > kPromisedPercent && !by_theory(entry))
      (find("stored_bits") == 16.0 ? halves : coarse).merge({1, percent, entry.path});
  }
  void merge(const EncodingLosses& other) {
    clipped.merge(other.clipped);
    halves.merge(other.halves);
    coarse.merge(other.coarse);
  }
  [[nodiscard]] std::vector<std::string> notes() const {
    std::vector<std::string> all;
    const auto text = [](const WrongLight& wrong) {
      return fmt::format("{} file{}, at most {:.3g} % ({})", wrong.files,
                         wrong.files == 1 ? "" : "s", wrong.percent, wrong.path);
    };
    if (clipped.files > 0)
      all.push_back("sun: clip cut light off in " + text(clipped) +
                    "; sun: float, split or scale keep it");
    if (halves.files > 0)
      all.push_back("half floats put the light on level ground off in " + text(halves) +
                    "; type: float or sun: scale keep it");
    if (coarse.files > 0)
      all.push_back("too few pixels put the light on level ground off in " + text(coarse));
    return all;
  }
};

/// One frame on its way: which of its outputs are missing, and what came of it.
struct Task {
  long number = 0;
  std::vector<size_t> missing;
  StageTimes times;
  uintmax_t bytes = 0;
  EncodingLosses losses;
  std::optional<Error> error;
};

/// The first error of any thread, and the running totals.
class Collector {
 public:
  Collector(const JobContext& job, RunSummary& summary, Clock::time_point start)
      : job_(job), summary_(summary), start_(start) {}

  [[nodiscard]] bool failed() const { return failed_.load(); }
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }
  [[nodiscard]] const EncodingLosses& losses() const { return losses_; }

  void take(const Task& task) {
    if (task.error) {
      if (!error_) error_ = task.error;
      failed_ = true;
      return;
    }
    task.missing.empty() ? ++summary_.kept : ++summary_.rendered;
    summary_.times += task.times;
    summary_.bytes_written += task.bytes;
    losses_.merge(task.losses);
    if (job_.options.on_progress)
      job_.options.on_progress({summary_.kept + summary_.rendered, long(job_.options.frames.size()),
                                summary_.kept, seconds_since(start_), "frames"});
  }

 private:
  const JobContext& job_;
  RunSummary& summary_;
  Clock::time_point start_;
  std::atomic<bool> failed_ = false;
  std::optional<Error> error_;
  EncodingLosses losses_;
};

void find_missing(const JobContext& job, Task& task) {
  const plan::Frame& frame = job.frame(task.number);
  for (size_t o = 0; o < job.plan.job.outputs.size(); ++o)
    if (is_per_frame(job.plan.job.outputs[o]) && (job.options.overwrite || !job.finished(frame, o)))
      task.missing.push_back(o);
}

/// Whether a product looks at the whole sky.
bool gathers_light(const config::Output& output) {
  const auto* product = std::get_if<config::ProductOutput>(&output);
  return product != nullptr && (product->kind == config::ProductKind::specular ||
                                product->kind == config::ProductKind::irradiance ||
                                product->kind == config::ProductKind::harmonics);
}

void run_task(const JobContext& job, Task& task) {
  find_missing(job, task);
  if (task.missing.empty()) return;
  const plan::Frame& frame = job.frame(task.number);
  const auto groups = group_by_view(job.plan, frame, task.missing);
  const auto drawn_apart = std::ranges::count_if(task.missing, [&](size_t o) {
    return is_texture(job.plan.job.outputs[o]) || gathers_light(job.plan.job.outputs[o]);
  });
  const auto light =
      light_of_frame(job.plan, frame, job.atmospheres, task.times,
                     job.report_paths(std::max(1, int(groups.size()) + int(drawn_apart))));
  if (!light) {
    task.error = light.error();
    return;
  }
  const FrameSource source{
      job.io, job.plan, frame, *light, job.displays, job.options.output, [&job] {
        return job.stopped();
      }};
  const StageTimes of_frame = task.times;
  const auto fingerprint_of = [&](size_t output) { return job.fingerprint(frame, output); };
  const auto record = [&](const LedgerEntry& entry) {
    task.bytes += entry.bytes;
    task.losses.take(entry);
    return job.ledger.record(entry);
  };
  const auto keep_error = [&](const Status& status) {
    if (!status) task.error = status.error();
    return status.ok();
  };
  for (const ViewGroup& group : groups)
    if (!keep_error(write_view(source, group, fingerprint_of, of_frame, record, task.times)))
      return;
  for (const size_t o : task.missing) {
    const bool texture = is_texture(job.plan.job.outputs[o]);
    if (!texture && !std::holds_alternative<config::ProductOutput>(job.plan.job.outputs[o]))
      continue;
    if (job.stopped()) {
      task.error = interrupted();
      return;
    }
    const auto& write = texture ? write_texture : write_product;
    if (!keep_error(write(source, o, fingerprint_of(o), of_frame, record, task.times))) return;
  }
}

/// Frames overlap: the pipeline admits a bounded number, each thread carries one through.
std::optional<Error> render_all(const JobContext& job, RunSummary& summary,
                                Clock::time_point start) {
  Collector collector(job, summary, start);
  const auto& frames = job.options.frames;
  size_t next = 0;
  const auto feed = [&]() -> std::optional<Task> {
    if (next == frames.size() || job.stopped() || collector.failed()) return {};
    Task task;
    task.number = frames[next++];
    return task;
  };
  const int threads = job.options.jobs > 0 ? job.options.jobs : available_cores();
  run_pipeline<Task>(
      size_t(frames_in_flight(job.plan, threads)), feed, [&](Task& task) { run_task(job, task); },
      [&](Task& task) { collector.take(task); }, FinishOrder::as_done);
  for (const std::string& note : collector.losses().notes()) summary.notes.push_back(note);
  if (collector.error()) return collector.error();
  if (job.stopped()) return interrupted();
  return {};
}

/// Temporaries that killed processes left beside the outputs.
void remove_leftovers(const JobContext& job) {
  std::set<std::filesystem::path> folders{job.options.output};
  for (const plan::Frame& frame : job.plan.frames)
    for (const auto& path : frame.paths) folders.insert((job.options.output / path).parent_path());
  for (const auto& folder : folders) output::remove_stale_temporaries(folder);
}

std::string writer_name(const plan::Shard& shard) {
  return shard.parts == 1
             ? "all"
             : "shard-" + std::to_string(shard.part) + "-of-" + std::to_string(shard.parts);
}

bool all_recorded(const JobContext& job) {
  for (const plan::Frame& frame : job.plan.frames)
    for (size_t o = 0; o < job.plan.job.outputs.size(); ++o)
      if (is_per_frame(job.plan.job.outputs[o]) && !job.recorded(frame, o)) return false;
  return true;
}

}  // namespace

std::string JobContext::fingerprint(const plan::Frame& frame, size_t output) const {
  const config::Output& o = plan.job.outputs[output];
  if (const auto* product = std::get_if<config::ProductOutput>(&o))
    return product_fingerprint(plan, frame, *product);
  return image_fingerprint(plan, frame, std::get<config::ImageOutput>(o), color_config);
}

std::function<bool(double)> JobContext::report_paths(int pictures) const {
  return [this, pictures, before = 0.0, earlier = 0, counted = 0.0](double share) mutable {
    if (share < before) ++earlier;  // the next picture has begun
    before = share;
    const double of_frame = std::min(1.0, (earlier + share) / pictures);
    const double more = of_frame - counted;
    counted = of_frame;
    const double done = frames_by_paths->fetch_add(more) + more;
    if (options.on_progress)
      options.on_progress({long(100 * done / double(options.frames.size())), 100, 0,
                           seconds_since(start), "paths %"});
    return !stopped();
  };
}

bool JobContext::finished(const plan::Frame& frame, size_t output) const {
  const auto files = plan::files_of(plan, frame, output);
  if (!ledger.knows(files.front())) return false;
  const std::string print = fingerprint(frame, output);
  return std::all_of(files.begin(), files.end(),
                     [&](const std::string& file) { return ledger.finished(file, print); });
}

bool JobContext::recorded(const plan::Frame& frame, size_t output) const {
  const auto files = plan::files_of(plan, frame, output);
  if (!ledger.knows(files.front())) return false;
  const std::string print = fingerprint(frame, output);
  return std::all_of(files.begin(), files.end(),
                     [&](const std::string& file) { return ledger.find(file, print); });
}

/// Memory of the largest picture that is whole in memory: a strip of it, but for drawn paths,
/// textures and products.
static double largest_picture_bytes(const plan::Plan& plan) {
  const double strip = plan.model == config::SkyModel::reference
                           ? std::numeric_limits<double>::max()
                           : double(kStripPixels);
  double largest = 1;
  const auto count = [&](const config::CameraConfig& camera, bool whole) {
    const double pixels = double(camera.camera.width) * camera.camera.height;
    largest = std::max(largest, whole ? pixels : std::min(pixels, strip));
  };
  for (const auto& camera : plan.job.cameras) count(camera, false);
  for (const config::Output& output : plan.job.outputs) {
    const auto* image = std::get_if<config::ImageOutput>(&output);
    const auto* product = std::get_if<config::ProductOutput>(&output);
    if (image != nullptr && image->own_view) count(*image->own_view, is_texture(output));
    if (product != nullptr && product->view) count(*product->view, true);
  }
  return largest * kBytesPerPixel;
}

int frames_in_flight(const plan::Plan& plan, int threads) {
  constexpr double kBudgetBytes = 1.5 * 1024 * 1024 * 1024;
  return std::clamp(int(kBudgetBytes / largest_picture_bytes(plan)), 1, threads + 1);
}

double picture_memory(const plan::Plan& plan, int threads) {
  return frames_in_flight(plan, threads) * largest_picture_bytes(plan);
}

Result<RunSummary> run_job(const plan::Plan& plan, const RunOptions& as_asked) {
  const auto start = Clock::now();
  RunOptions options = as_asked;
  std::mutex one_at_a_time;  // frames, tables and movies report from threads of their own
  if (as_asked.on_progress)
    options.on_progress = [&](const Progress& progress) {
      const std::lock_guard lock(one_at_a_time);
      as_asked.on_progress(progress);
    };
  const ThreadLimit limit(options.jobs);
  const auto io = output::open_image_io();
  if (!io) return io.error();
  const auto color_config = color_config_hash(plan.job);
  if (!color_config) return color_config.error();
  const auto displays = Displays::make(**io, plan.job);
  if (!displays) return displays.error();
  const Status movies_possible = check_movies_possible(plan);
  if (!movies_possible) return movies_possible.error();
  auto ledger = Ledger::open(options.output, writer_name(options.shard));
  if (!ledger) return ledger.error();
  AtmosphereService atmospheres(plan, options.backend, [&](double share) {
    if (options.on_progress)
      options.on_progress({long(100 * share), 100, 0, seconds_since(start), "atmosphere %"});
    return options.stop_signal == nullptr || options.stop_signal->load() == 0;
  });
  std::atomic<double> frames_by_paths = 0;
  const JobContext job{plan,        options,       **io,  *displays,       *ledger,
                       atmospheres, *color_config, start, &frames_by_paths};
  remove_leftovers(job);

  RunSummary summary;
  auto failure = render_all(job, summary, start);
  const Status refreshed = ledger->refresh();
  if (!failure && !refreshed) failure = refreshed.error();
  if (!failure) {
    const auto movie_start = Clock::now();
    const Status movies = make_movies(job, summary);
    if (!movies) failure = movies.error();
    summary.movie_seconds = seconds_since(movie_start);
  }
  if (!failure) {
    const auto library_start = Clock::now();
    const Status library = make_library_files(job, summary);
    if (!library) failure = library.error();
    summary.library_seconds = seconds_since(library_start);
  }
  summary.complete = all_recorded(job);
  for (const std::string& text : atmospheres.notes()) summary.notes.push_back(text);
  // What is finished is written down even if the job failed; the first failure is what counts.
  const Status manifest = write_manifest(job);
  if (!failure && !manifest) failure = manifest.error();
  summary.seconds = seconds_since(start);
  if (failure) return *failure;
  return summary;
}

}  // namespace skylapse::pipeline
