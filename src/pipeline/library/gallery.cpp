#include "pipeline/library/gallery.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "core/constants.h"
#include "core/version.h"
#include "pipeline/library/sheet.h"
#include "pipeline/library/web_page.h"
#include "pipeline/output_view.h"
#include "pipeline/products/dome.h"
#include "plan/sky_model.h"

namespace skylapse::pipeline {
namespace {

using Json = nlohmann::ordered_json;

/// Digits that a page can show and a filter can compare, and no more bytes.
Json rounded(double value, int digits = 6) {
  return std::stod(fmt::format("{:.{}g}", value, digits));
}

Result<size_t> preview_of(const config::JobConfig& job, const config::LibraryOutput& gallery) {
  const auto refused = [&](const std::string& message) {
    return Error{ErrorCode::invalid_input, message, gallery.image_path.span,
                 "the path of a png or jpg output, as it is written there"};
  };
  for (size_t o = 0; o < job.outputs.size(); ++o) {
    const auto* const image = std::get_if<config::ImageOutput>(&job.outputs[o]);
    if (image == nullptr || image->path.value != gallery.image_path.value) continue;
    if (!image->display && !image->view) return refused("a gallery shows pictures for display");
    return o;
  }
  return refused("no image output has the path \"" + gallery.image_path.value + "\"");
}

/// What an output is, in the words of the config.
std::string label_of(const config::Output& output) {
  if (const auto* const image = std::get_if<config::ImageOutput>(&output)) {
    const bool display = image->display || image->view;
    const bool sky = image->content == config::ImageContent::sky;
    return fmt::format("{} {}", display ? "picture" : sky ? "sky" : "map", image->path.value);
  }
  if (const auto* const product = std::get_if<config::ProductOutput>(&output)) {
    constexpr std::array kKinds{"specular", "irradiance", "harmonics", "sun", "dome"};
    return fmt::format("{} {}", kKinds[size_t(product->kind)], product->path.value);
  }
  return config::path_of(output).value;
}

bool leaves_disc_out(const config::Output& output) {
  if (const auto* const image = std::get_if<config::ImageOutput>(&output))
    return pipeline::leaves_disc_out(*image);
  const auto* const product = std::get_if<config::ProductOutput>(&output);
  return product != nullptr && !product->sun_disc;
}

Angle heading_of(const image::Camera& camera) {
  const glm::dvec3 forward = camera.camera_to_enu[2];
  return azimuth(Direction<Enu>::from_vector(forward));
}

class Gallery {
 public:
  Gallery(const JobContext& job, size_t preview, const std::string& path)
      : job_(job), preview_(preview), folder_(std::filesystem::path(path).parent_path()) {}

  Json head() const {
    const config::JobConfig& config = job_.plan.job;
    auto sites = Json::array(), outputs = Json::array(), without_disc = Json::array();
    for (const config::Site& site : config.sites) sites.push_back(site.name);
    for (const config::Output& output : config.outputs) {
      outputs.push_back(label_of(output));
      without_disc.push_back(leaves_disc_out(output));
    }
    return {{"title", config.title},
            {"config", config.file},
            {"version", kVersion},
            {"model", plan::name_of(job_.plan.model)},
            {"space", config.color.space},
            {"white", kLuminousEfficacy},
            {"sites", sites},
            {"outputs", outputs},
            {"without_disc", without_disc}};
  }

  Json sky(const plan::Frame& frame) const {
    const config::JobConfig& config = job_.plan.job;
    std::map<std::string, double> light;
    Json files = files_of_frame(frame, light);
    const auto lux_of = [&](const char* key) {
      const auto found = light.find(key);
      return found == light.end() ? Json(nullptr) : rounded(found->second);
    };
    const bool lit = light.contains("sky_horizontal_lux") && light.contains("sun_horizontal_lux");
    const Json total =
        lit ? rounded(light["sky_horizontal_lux"] + light["sun_horizontal_lux"]) : Json(nullptr);
    const config::CameraConfig view = preview_camera(frame);
    const int faces = view.cube_faces_apart ? 6 : 1;  // of a strip, one is shown
    return {{"number", frame.index},
            {"site", frame.site},
            {"utc", format_utc(frame.instant, 0)},
            {"local", format_local(frame.local)},
            {"sun", rounded(elevation(frame.sky.sun_true).in(deg), 8)},
            {"apparent", rounded(elevation(frame.sky.sun_apparent).in(deg))},
            {"azimuth", rounded(azimuth(frame.sky.sun_apparent).in(deg))},
            {"turbidity", rounded(config.air.turbidity[frame.turbidity].value)},
            {"albedo", config.air.ground_albedo[frame.albedo].value.name},
            {"camera", config.cameras[frame.camera].name},
            {"choices", choices_of(config, frame)},
            {"lat_long", view.camera.projection == image::Projection::lat_long},
            {"width", view.camera.width},
            {"height", view.camera.height / faces},
            {"heading", rounded(heading_of(view.camera).in(deg))},
            {"horizon", rounded(frame.horizon.in(deg))},
            {"ev", rounded(frame.ev)},
            {"lux", total},
            {"sky", lux_of("sky_horizontal_lux")},
            {"direct", lux_of("sun_normal_lux")},
            {"preview", linked(plan::files_of(job_.plan, frame, preview_).front())},
            {"files", std::move(files)}};
  }

 private:
  config::CameraConfig preview_camera(const plan::Frame& frame) const {
    const auto& image = std::get<config::ImageOutput>(job_.plan.job.outputs[preview_]);
    return view_of_output(job_.plan, frame, image).camera;
  }

  std::string linked(const std::string& file) const {
    return std::filesystem::path(file)
        .lexically_relative(folder_.empty() ? "." : folder_)
        .generic_string();
  }

  static Json file_json(const LedgerEntry& entry, const std::string& path, size_t output) {
    Json file{{"path", path}, {"output", output}, {"bytes", entry.bytes}, {"sha256", entry.sha256}};
    const auto add = [&](const char* name, const char* key) {
      const auto found = entry.encoding.find(key);
      if (found != entry.encoding.end()) file[name] = rounded(found->second);
    };
    add("has", "horizontal_lux");
    add("true", "true_horizontal_lux");
    add("error", "error_percent");
    add("lost", "lost_fraction");
    add("scale", "scale");
    return file;
  }

  Json files_of_frame(const plan::Frame& frame, std::map<std::string, double>& light) const {
    auto files = Json::array();
    for (size_t o = 0; o < job_.plan.job.outputs.size(); ++o) {
      if (!config::is_per_frame(job_.plan.job.outputs[o])) continue;
      const auto paths = plan::files_of(job_.plan, frame, o);
      if (!job_.ledger.knows(paths.front())) continue;
      const std::string print = job_.fingerprint(frame, o);
      for (const std::string& path : paths) {
        const auto entry = job_.ledger.find(path, print);
        if (!entry) continue;
        files.push_back(file_json(*entry, linked(path), o));
        if (!entry->light.empty()) light = entry->light;
      }
    }
    return files;
  }

  const JobContext& job_;
  size_t preview_;
  std::filesystem::path folder_;  // of the page, relative to the output folder
};

}  // namespace

Result<std::string> make_gallery(const JobContext& job, const config::LibraryOutput& output) {
  const auto preview = preview_of(job.plan.job, output);
  if (!preview) return preview.error();
  const Gallery gallery(job, *preview, output.path.value);
  const auto text_of = [](const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  // One sky a line, made one after the other: a large library's page is larger than its plan.
  std::string skies;
  for (const plan::Frame& frame : job.plan.frames)
    skies += (skies.empty() ? "\n" : ",\n") + text_of(gallery.sky(frame));
  std::string data = text_of(gallery.head());
  data.back() = ',';
  data += "\"skies\":[" + skies + "\n]}";
  return filled_page(web_text("gallery.html"),
                     {{"style", style_element(web_text("gallery.css"))},
                      {"data", data_element(data)},
                      {"script", script_element(std::string(web_text("panorama.js")) +
                                                std::string(web_text("gallery.js")))}});
}

}  // namespace skylapse::pipeline
