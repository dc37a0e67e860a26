#include "diff/manifest_facts.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "core/printable.h"
#include "diff/json_file.h"
#include "image/camera/camera_words.h"
#include "image/orientation.h"

namespace skylapse::diff {
namespace {

using nlohmann::json;

Error bad_manifest(const std::filesystem::path& path, const std::string& why) {
  return {.code = ErrorCode::missing_input,
          .message = "cannot read the manifest '" + printable(path.native()) + "': " + why};
}

std::string text_of(const json& object, const char* key) {
  if (!object.is_object()) return {};
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

const json& list_of(const json& object, const char* key) {
  static const json kNone = json::array();
  if (!object.is_object()) return kNone;
  const auto found = object.find(key);
  return found != object.end() && found->is_array() ? *found : kNone;
}

json part_of(const json& object, const char* key) {
  if (!object.is_object()) return {};
  const auto found = object.find(key);
  return found != object.end() ? *found : json();
}

json named(const json& list, const std::string& name) {
  for (const json& item : list)
    if (!name.empty() && text_of(item, "name") == name) return item;
  return {};
}

/// Whether a path can come from "{camera}/f.####.exr": its fixed parts stand in it in this order,
/// the first at the beginning and the last at the end.
bool fits_template(std::string_view path, const std::string& written) {
  std::string with_tokens;
  for (const char c : written) {
    if (c != '#')
      with_tokens += c;
    else if (!with_tokens.ends_with("{#}"))  // a frame's number of several digits
      with_tokens += "{#}";
  }
  std::string_view shape = with_tokens;
  const size_t token = shape.find('{');
  if (token == shape.npos) return path == shape;
  if (!path.starts_with(shape.substr(0, token))) return false;
  path.remove_prefix(token);
  shape.remove_prefix(token);
  while (true) {
    const size_t close = shape.find('}');
    if (close == shape.npos) return false;
    shape.remove_prefix(close + 1);
    const size_t next = shape.find('{');
    if (next == shape.npos) return path.ends_with(shape);
    const size_t found = path.find(shape.substr(0, next));
    if (found == path.npos) return false;
    path.remove_prefix(found + next);
    shape.remove_prefix(next);
  }
}

/// The one output whose path the file's can be; null if several can.
json output_of(const json& outputs, const std::string& path) {
  json found;
  for (const json& output : outputs) {
    bool fits = false;
    for (const char* key : {"image", "specular", "irradiance", "dome"})
      fits = fits || fits_template(path, text_of(output, key));
    if (fits && !found.is_null()) return {};
    if (fits) found = output;
  }
  return found;
}

/// The file's words for what an image output shows. A plain output may leave the sun's disc out
/// (sun policy split): not told.
std::string content_of(const json& output) {
  const std::string word = text_of(output, "content");
  if (word == "sky") return "sky without disc";
  return word == "standard-error" ? "standard error" : "";
}

/// The output's own camera, else the frame's, turned to the output's orientation.
json camera_of(const json& manifest, const json& frame, const json& output) {
  json camera = part_of(output, "camera");
  if (camera.is_object()) return camera;
  camera = named(list_of(manifest, "cameras"), text_of(frame, "camera"));
  const auto orientation = image::orientation_from_name(text_of(output, "orientation"));
  const auto projection = image::projection_from_name(text_of(camera, "projection"));
  if (orientation && projection && image::stands_upright(*projection))
    camera["azimuth_deg"] = image::map_heading(*projection, *orientation).in(deg);
  return camera;
}

/// Of all that the frame tells, what can be held against another file.
json facts_of_frame(const json& frame) {
  json facts = json::object();
  for (const char* key : {"utc", "sun", "exposure", "model"}) facts[key] = part_of(frame, key);
  return facts;
}

class ManifestReader {
 public:
  ManifestReader(const std::filesystem::path& path, const json& manifest)
      : path_(path), manifest_(manifest) {
    const json atmosphere = part_of(manifest, "atmosphere");
    facts_.ours = true;
    facts_.renderer = text_of(part_of(atmosphere, "computed_by"), "renderer");
    // Models that need no GL run on the processor.
    if (facts_.renderer.empty()) facts_.renderer = "cpu";
  }

  Status take(const json& frame) {
    if (!frame.is_object()) return bad_manifest(path_, "a frame is not an object");
    size_t number = 0;
    for (const json& file : list_of(frame, "files"))
      if (const Status taken = take(frame, file, number++); !taken) return taken;
    return Done{};
  }
  ManifestFacts result() { return std::move(facts_); }

 private:
  Status take(const json& frame, const json& file, size_t number) {
    const std::string path = text_of(file, "path");
    if (!stays_below(path))
      return bad_manifest(path_, "the path '" + shown(path) + "' does not stay below its folder");
    const json output = output_of(list_of(manifest_, "outputs"), path);
    json entry{{"frame", facts_of_frame(frame)},
               {"file", {{"encoding", part_of(file, "encoding")}}},
               {"camera", camera_of(manifest_, frame, output)},
               {"output", output},
               {"content", content_of(output)},
               {"site", named(list_of(manifest_, "sites"), text_of(frame, "site"))},
               {"renderer", facts_.renderer},
               {"program", text_of(manifest_, "program") + " " + text_of(manifest_, "version")},
               {"source_hash", text_of(manifest_, "source_hash")},
               {"config", text_of(manifest_, "config")}};
    const json scene_linear = part_of(output, "scene_linear");
    if (scene_linear.is_boolean() && scene_linear.get<bool>())
      entry["color"] = part_of(manifest_, "color");
    const json index = part_of(frame, "frame");
    ManifestFile told;
    told.frame = index.is_number() ? index.get<double>() : double(facts_.order.size());
    told.sequence = part_of(frame, "site").dump() + part_of(frame, "camera").dump() +
                    part_of(frame, "turbidity").dump() + part_of(frame, "ground_albedo").dump() +
                    std::to_string(number);
    told.key = std::to_string(told.frame) + told.sequence;
    told.entry = entry.dump();
    if (!facts_.files.emplace(path, std::move(told)).second)
      return bad_manifest(path_, "it lists '" + shown(path) + "' twice");
    facts_.order.push_back(path);
    return Done{};
  }

  const std::filesystem::path& path_;
  const json& manifest_;
  ManifestFacts facts_;
};

}  // namespace

Result<ManifestFacts> read_manifest(const std::filesystem::path& path) {
  const auto manifest = read_json(path);
  if (!manifest) return manifest.error();
  if (text_of(*manifest, "program") != "skylapse") return ManifestFacts{};
  ManifestReader reader(path, *manifest);
  for (const json& frame : list_of(*manifest, "frames"))
    if (const Status taken = reader.take(frame); !taken) return taken.error();
  return reader.result();
}

}  // namespace skylapse::diff
