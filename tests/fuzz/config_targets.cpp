#include <fmt/format.h>

#include <cmath>

#include "config/atmosphere_file.h"
#include "config/job_config.h"
#include "config/yaml_reader.h"
#include "fuzz/require.h"
#include "fuzz/targets.h"

namespace skylapse::fuzz {
namespace {

using config::Node;

/// Longer inputs would test the bound on bytes only, slowly.
constexpr size_t kMaxBytes = 1 << 14;

struct JobText {
  std::string text;
  std::vector<config::Override> overrides;
};

/// The text, then overrides, parted by NUL bytes.
JobText split(std::string_view bytes) {
  JobText job;
  const size_t end = std::min(bytes.find('\0'), bytes.size());
  job.text = std::string(bytes.substr(0, end));
  for (size_t at = end; at < bytes.size() && job.overrides.size() < 8;) {
    const size_t next = std::min(bytes.find('\0', at + 1), bytes.size());
    const std::string_view one = bytes.substr(at + 1, next - at - 1);
    const size_t equals = one.find('=');
    if (equals != std::string_view::npos)
      job.overrides.push_back(
          {std::string(one.substr(0, equals)), std::string(one.substr(equals + 1))});
    at = next;
  }
  return job;
}

void require_good_sites(const config::JobConfig& job) {
  require(!job.sites.empty() && !job.cameras.empty() && !job.outputs.empty(),
          "an accepted job has places, cameras and outputs");
  for (const config::Site& site : job.sites) {
    const astro::GeodeticPosition& p = site.position;
    require(std::abs(p.latitude.in(rad)) <= M_PI / 2, "latitudes end at the poles");
    require(isfinite(p.longitude) && isfinite(p.height), "places are finite");
    require(!site.name.empty(), "sites have names");
  }
}

void require_good_values(const config::JobConfig& job) {
  for (const auto& turbidity : job.air.turbidity)
    require(std::isfinite(turbidity.value) && turbidity.value >= 1, "haze is that of some air");
  for (const auto& albedo : job.air.ground_albedo)
    require(albedo.value.value >= 0 && albedo.value.value <= 1, "albedos are shares");
  require(job.sky.wavelengths >= 3 && job.sky.wavelengths <= 32, "3 to 32 wavelengths");
  for (const config::CameraConfig& camera : job.cameras)
    require(camera.camera.width > 0 && camera.camera.height > 0 && camera.camera.width <= 65536 &&
                camera.camera.height <= 65536,
            "images have pixels and an end");
}

size_t nodes_of(const Node& node, int depth) {
  require(depth <= config::YamlLimits{}.depth, "nesting keeps its limit");
  size_t count = 1;
  for (const Node& item : node.items) count += nodes_of(item, depth + 1);
  for (const auto& entry : node.entries) count += nodes_of(entry.value, depth + 1);
  return count;
}

/// A place lies in the text, and verbatim scalars stand there letter by letter.
void require_places(const Node& node, const config::SourceSet& sources) {
  const std::string_view line = sources.line(0, node.place.line);
  require(node.place.line >= 0 && node.place.column >= 1, "places count from 1");
  require(size_t(node.place.column - 1) <= line.size() + 1, "places lie in their line", node.text);
  if (node.verbatim)
    require(line.substr(size_t(node.place.column - 1)).starts_with(node.text),
            "verbatim text stands in the source", node.text);
  for (const Node& item : node.items) require_places(item, sources);
  for (const auto& entry : node.entries) require_places(entry.value, sources);
}

}  // namespace

void job(std::string_view bytes) {
  if (bytes.size() > kMaxBytes) return;
  const JobText input = split(bytes);
  const auto parsed = config::parse_job(input.text, "job.yaml", input.overrides);
  if (!parsed) return require_printable(parsed.error());
  require_good_sites(*parsed);
  require_good_values(*parsed);
  require(config::parse_job(input.text, "job.yaml", input.overrides).ok(),
          "an accepted job is accepted again");
}

void atmosphere(std::string_view bytes) {
  if (bytes.size() > kMaxBytes) return;
  const auto parsed = config::parse_atmosphere(std::string(bytes), "air.yaml");
  if (!parsed) return require_printable(parsed.error());
  const Status good = check(medium_at(*parsed, sky::atmosphere::band_edges(3)));
  require(good.ok(), "accepted air makes a medium", good ? "" : good.error().message);
}

void yaml(std::string_view bytes) {
  if (bytes.size() > kMaxBytes) return;
  config::SourceSet sources;
  config::ErrorList errors;
  config::YamlLimits limits;
  limits.nodes = 1000;
  sources.add("file", config::normalised_text(std::string(bytes)));
  const auto root = config::read_yaml(sources, 0, errors, limits);
  if (!errors.empty()) require_printable(errors.diagnostics(sources));
  require(root.has_value() || !errors.empty(), "no tree without a reason");
  if (!root) return;
  require(nodes_of(*root, 0) <= limits.nodes, "trees keep their limit");
  require_places(*root, sources);
}

}  // namespace skylapse::fuzz
