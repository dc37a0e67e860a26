#include <fmt/format.h>

#include <filesystem>

#include "config/air_presets.h"
#include "config/build_job.h"
#include "config/override.h"
#include "config/text_file.h"
#include "config/yaml_reader.h"

namespace skylapse::config {
namespace {

namespace fs = std::filesystem;

JobConfig build_job(const Section& root, const std::string& file, const ReadContext& context) {
  JobConfig job;
  job.file = file;
  job.title = root.get<std::string>("title").value_or("");
  job.allow_outside_paths = root.get<bool>("allow_outside_paths").value_or(false);
  job.sites = build_sites(root, context);
  job.time = build_time(root, job.sites, context);
  job.air = build_air(root, job.sites, context);
  job.sky = build_sky(root, context);
  job.cameras = build_cameras(root, context);
  job.exposure = build_exposure(root, context);
  job.color = build_color(root, context);
  job.outputs = build_outputs(root, job, context);
  check_frame_count(root, job, context);
  return job;
}

/// A config is a section; an empty file is a section without keys.
bool is_section(Node& root, ErrorList& errors) {
  if (root.kind == Node::Kind::null) {
    root.kind = Node::Kind::map;
    root.place = {0, 1, 1, 0};
  }
  if (root.kind == Node::Kind::map) return true;
  errors.add(root.place,
             root.kind == Node::Kind::sequence
                 ? "the config is a list, not a section with keys"
                 : "the config is a single value, not a section with keys",
             "a config begins with keys such as \"location:\" and \"time:\"");
  return false;
}

}  // namespace

Result<JobConfig, Diagnostics> parse_job(const std::string& text, const std::string& name,
                                         const std::vector<Override>& overrides) {
  SourceSet sources;
  ErrorList errors;
  const int file = sources.add(name, normalised_text(text));
  auto root = read_yaml(sources, file, errors);
  if (!root || !is_section(*root, errors)) return errors.diagnostics(sources);
  for (const Override& change : overrides) apply_override(*root, change, sources, errors);
  apply_preset(*root, sources, errors);
  ReadContext context{sources, errors, fs::path(name).parent_path().string()};
  const Section section = read_section(*root, job_spec(), "", {file, 1, 1, 0}, context);
  JobConfig job = build_job(section, name, context);
  if (!errors.empty()) return errors.diagnostics(sources);
  return job;
}

Result<JobConfig, Diagnostics> load_job(const std::string& path,
                                        const std::vector<Override>& overrides) {
  const auto text = read_text_file(path, "config");
  if (!text) return text.error();
  return parse_job(*text, path, overrides);
}

}  // namespace skylapse::config
