#include "study/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/printable.h"
#include "pipeline/library/web_page.h"
#include "study/picture.h"
#include "study/study_texts.h"
#include "study/svg_chart.h"

namespace skylapse::study {
namespace {

using Json = nlohmann::ordered_json;

/// Five digits: what a table can show, and no more bytes. Infinite: null.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::stod(fmt::format("{:.5g}", value));
}
Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

Json errors_json(const Measurement& m) {
  Json j;
  const ErrorMeasure& sky = m.errors.sky();
  j["rms"] = number(cost_of(m).error);
  j["below_noise"] = sky.rms < sky.rms_uncertainty;
  j["unsure"] = number(sky.rms_uncertainty);
  j["p95"] = number(sky.p95), j["max"] = number(sky.max);
  for (int i = 1; i < kSkyRegions; ++i)
    j[std::string(kSkyRegionNames[i])] =
        m.errors.by_region[i].directions > 0 ? number(m.errors.by_region[i].rms) : Json(nullptr);
  j["disc"] = number(m.disc), j["irradiance"] = number(m.irradiance);
  j["duv"] = number(m.errors.chromaticity.rms), j["duv_max"] = number(m.errors.chromaticity.max);
  j["de"] = number(m.delta_e.mean), j["de_p95"] = number(m.delta_e.p95);
  j["de_max"] = number(m.delta_e.max), j["arcsec"] = number(m.sun_arcsec);
  return j;
}

void add_costs(const Measurement& m, Json& j) {
  const Spread core = m.timing.core();
  const double with_pixels = core.median * m.timing.pixel_share();
  j["ms"] = number(core.median), j["q1"] = number(core.lower), j["q3"] = number(core.upper);
  j["frames"] = core.count;
  j["once"] = number(core.median - with_pixels), j["pixels"] = number(with_pixels);
  j["clock"] = number(m.timing.frame().median);
  // What the first frame takes beyond a further one: context, shaders, tables.
  const bool prepares = m.memory.table_bytes > 0 || !m.renderer.empty();
  j["prepare"] = prepares ? number(std::max(0.0, m.timing.first_core_ms - core.median)) : Json(0);
  j["first"] = number(m.timing.first_ms), j["tables"] = number(m.timing.tables_ms);
  j["table_mb"] = number(double(m.memory.table_bytes) / 1e6);
  j["rise_mb"] = m.memory.peak_rise ? number(double(*m.memory.peak_rise) / 1e6) : Json(nullptr);
  j["scaled"] = m.rung.small_picture;
}

class Report {
 public:
  Report(const StudyResult& study, const output::ImageIo& io, const output::DisplayTransform& view)
      : study_(study), io_(io), view_(view) {}

  Result<Json> data() const {
    Json j;
    const Machine& machine = study_.machine;
    j["machine"] = {{"cpu", machine.cpu},
                    {"cores", machine.cores},
                    {"load", number(machine.load)},
                    {"system", machine.system},
                    {"renderer", study_.renderer},
                    {"version", machine.version},
                    {"source", machine.source_hash.substr(0, 12)}};
    j["date"] = study_.date, j["command"] = study_.command, j["seconds"] = number(study_.seconds);
    j["quick"] = study_.quick, j["rounds"] = study_.rounds;
    j["noise"] = study_.truth.noise, j["wavelengths"] = study_.truth.wavelengths;
    j["seed"] = study_.truth.seed;
    j["pixels"] = kStudyWidth * kStudyHeight;
    j["groups"] = Json::array();
    for (const RungGroup& g : rung_groups())
      j["groups"].push_back({{"name", g.name}, {"title", g.title}, {"text", g.explanation}});
    j["scenes"] = Json::array();
    for (const SceneResult& scene : study_.scenes) {
      auto s = scene_json(scene);
      if (!s) return s.error();
      j["scenes"].push_back(*std::move(s));
    }
    return j;
  }

 private:
  Result<Json> scene_json(const SceneResult& scene) const {
    const StudyScene& s = scene.scene;
    Json j{{"id", s.id},
           {"title", s.title},
           {"sun", number(s.sun_elevation.in(deg))},
           {"height", number(s.height.in(metre))},
           {"instant", s.instant},
           {"directions", s.points.size()},
           {"paths", s.truth.paths},
           {"truth_seconds", number(s.truth.seconds)},
           {"truth_kept", s.truth.from_cache}};
    const auto truth = true_thumbnail(scene);
    if (!truth.empty()) {
      const auto url = png(shown(truth, s.exposure_ev, view_));
      if (!url) return url.error();
      j["truth"] = *url;
    }
    j["rungs"] = Json::array();
    const auto front = pareto_front(scene.rungs);
    for (size_t i = 0; i < scene.rungs.size(); ++i) {
      auto rung = rung_json(scene, i, truth);
      if (!rung) return rung.error();
      (*rung)["front"] = std::find(front.begin(), front.end(), i) != front.end();
      j["rungs"].push_back(*std::move(rung));
    }
    return j;
  }

  Result<Json> rung_json(const SceneResult& scene, size_t index,
                         const std::vector<glm::dvec3>& truth) const {
    const Measurement& m = scene.rungs[index];
    Json j{{"id", m.rung.id},
           {"group", m.rung.group},
           {"label", m.rung.label},
           {"setting", m.rung.setting},
           {"skipped", m.skipped}};
    if (!m.skipped.empty()) return j;
    j.update(errors_json(m));
    add_costs(m, j);
    if (m.picture.width() == 0 || truth.empty()) return j;
    const auto xyz = rung_thumbnail(scene, m);
    const auto picture = png(shown(xyz, m.ev, view_));
    if (!picture) return picture.error();
    const auto map = png(error_map(xyz, truth));
    if (!map) return map.error();
    j["picture"] = *picture, j["map"] = *map;
    return j;
  }

  [[nodiscard]] Result<std::string> png(const std::vector<uint8_t>& rgb) const {
    return png_url(io_, rgb, kThumbnailSize, kThumbnailSize);
  }

  const StudyResult& study_;
  const output::ImageIo& io_;
  const output::DisplayTransform& view_;
};

}  // namespace

Result<std::string> report_html(const StudyResult& study) {
  const auto io = output::open_image_io();
  if (!io) return io.error();
  const auto view = (*io)->display({"", "rec709", "", ""});
  if (!view) return view.error();
  const auto data = Report(study, **io, **view).data();
  if (!data) return data.error();
  std::string figures, multiples;
  for (const Figure& figure : figures_of(study)) {
    std::string& target = figure.name.starts_with("pareto_") ? figures : multiples;
    target += fmt::format("<figure id=\"{}\">{}</figure>\n", xml_escaped(figure.name), figure.svg);
  }
  return pipeline::filled_page(study_text("report.html"),
                               {{"style", pipeline::style_element(study_text("report.css"))},
                                {"figures", figures},
                                {"multiples", multiples},
                                {"data", pipeline::data_element(data->dump())},
                                {"script", pipeline::script_element(study_text("report.js"))}});
}

}  // namespace skylapse::study
