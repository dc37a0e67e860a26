#include "pipeline/library/library_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/sha256.h"
#include "core/version.h"
#include "output/atomic_file.h"
#include "pipeline/library/gallery.h"
#include "pipeline/library/sheet.h"

namespace skylapse::pipeline {
namespace {

using config::LibraryKind;
using config::LibraryOutput;

std::vector<const LibraryOutput*> library_outputs(const plan::Plan& plan) {
  std::vector<const LibraryOutput*> all;
  for (const config::Output& output : plan.job.outputs)
    if (const auto* library = std::get_if<LibraryOutput>(&output)) all.push_back(library);
  return all;
}

/// The outputs whose files are shown or linked: a gallery links them all.
std::vector<size_t> outputs_shown(const plan::Plan& plan, const LibraryOutput& library) {
  std::vector<size_t> shown;
  for (size_t o = 0; o < plan.job.outputs.size(); ++o) {
    const config::Output& output = plan.job.outputs[o];
    const bool is_picture = std::holds_alternative<config::ImageOutput>(output) &&
                            config::path_of(output).value == library.image_path.value;
    if (is_picture || (library.kind == LibraryKind::gallery && config::is_per_frame(output)))
      shown.push_back(o);
  }
  return shown;
}

bool frames_ready(const JobContext& job, const std::vector<size_t>& shown) {
  return std::all_of(job.plan.frames.begin(), job.plan.frames.end(), [&](const plan::Frame& frame) {
    return std::all_of(shown.begin(), shown.end(),
                       [&](size_t output) { return job.recorded(frame, output); });
  });
}

std::string fingerprint_of(const JobContext& job, const LibraryOutput& library) {
  nlohmann::json all{{"source", kSourceHash},      {"kind", int(library.kind)},
                     {"path", library.path.value}, {"image", library.image_path.value},
                     {"columns", library.columns}, {"title", job.plan.job.title}};
  auto frames = nlohmann::json::array();
  for (const plan::Frame& frame : job.plan.frames)
    for (const size_t output : outputs_shown(job.plan, library)) {
      frames.push_back(job.fingerprint(frame, output));
      frames.push_back(plan::files_of(job.plan, frame, output));
    }
  all["frames"] = frames;
  return sha256_hex(all.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

Result<std::vector<std::byte>> content_of(const JobContext& job, const LibraryOutput& library,
                                          RunSummary& summary) {
  if (library.kind == LibraryKind::sheet) return make_sheet(job, library, summary);
  const auto page = make_gallery(job, library);
  if (!page) return page.error();
  const auto* bytes = reinterpret_cast<const std::byte*>(page->data());
  return std::vector<std::byte>(bytes, bytes + page->size());
}

Status make_file(const JobContext& job, const LibraryOutput& library, const std::string& print,
                 RunSummary& summary) {
  const auto bytes = content_of(job, library, summary);
  if (!bytes) return bytes.error();
  const Status written =
      output::write_file_atomically(job.options.output / library.path.value, *bytes);
  if (!written) return written;
  summary.bytes_written += bytes->size();
  return job.ledger.record(
      {library.path.value, print, sha256_hex(*bytes), bytes->size(), {}, {}, {}, {}});
}

}  // namespace

Status make_library_files(const JobContext& job, RunSummary& summary) {
  for (const LibraryOutput* library : library_outputs(job.plan)) {
    const std::string print = fingerprint_of(job, *library);
    const auto finished = [&] {
      return !job.options.overwrite && job.ledger.finished(library->path.value, print);
    };
    if (finished()) continue;
    if (!frames_ready(job, outputs_shown(job.plan, *library))) {
      summary.notes.push_back(fmt::format(
          "{} is left out: not all of the {} frames are there; render the whole job to make it",
          library->path.value, job.plan.frames.size()));
      continue;
    }
    const auto lock = FolderLock::take(job.options.output);
    if (!lock) return lock.error();
    const Status refreshed = job.ledger.refresh();
    if (!refreshed) return refreshed;
    if (finished()) continue;  // another shard was quicker
    const Status made = make_file(job, *library, print, summary);
    if (!made) return made;
  }
  return Done{};
}

std::vector<LedgerEntry> library_entries(const JobContext& job) {
  std::vector<LedgerEntry> entries;
  for (const LibraryOutput* library : library_outputs(job.plan))
    if (job.ledger.knows(library->path.value))
      if (auto entry = job.ledger.find(library->path.value, fingerprint_of(job, *library)))
        entries.push_back(*std::move(entry));
  return entries;
}

}  // namespace skylapse::pipeline
