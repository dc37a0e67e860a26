#include "diff/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/parallel.h"
#include "core/version.h"
#include "diff/diff_texts.h"
#include "diff/page_pictures.h"
#include "diff/wording.h"
#include "pipeline/library/web_page.h"

namespace skylapse::diff {
namespace {

using Json = nlohmann::ordered_json;

/// Six digits: more than is shown, and few bytes. What is not finite is a string that Number() of
/// JavaScript understands.
Json number(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value < 0 ? "-Infinity" : "Infinity";
  return std::stod(fmt::format("{:.6g}", value));
}
Json limit(double value) { return std::isnan(value) ? Json(nullptr) : number(value); }
Json angle(const std::optional<double>& degrees) {
  return degrees ? Json(std::stod(fmt::format("{:.3f}", *degrees))) : Json(nullptr);
}

/// Lists are shorter than objects; empty values at their end are left out.
Json trimmed(Json list) {
  const auto is_empty = [](const Json& j) { return j.is_null() || j == "" || j == Json::array(); };
  while (!list.empty() && is_empty(list.back())) list.erase(list.size() - 1);
  return list;
}

Json place_json(const std::optional<Place>& p) {
  if (!p) return nullptr;
  return trimmed({p->x, p->y, one_line(p->channel), angle(p->azimuth_deg), angle(p->elevation_deg),
                  angle(p->from_sun_deg), one_line(p->region)});
}

Json findings_json(const std::vector<const Finding*>& findings) {
  Json list = Json::array();
  for (const Finding* f : findings)
    list.push_back(trimmed(
        {int(f->severity), one_line(f->check), one_line(f->message), place_json(f->place)}));
  return list;
}

Json file_json(const FileFacts& f) {
  Json channels = Json::array();
  for (const std::string& c : f.channels) channels.push_back(one_line(c));
  return trimmed({one_line(f.path), one_line(f.format), one_line(f.sample_type), f.width, f.height,
                  channels, one_line(f.utc), one_line(f.model), one_line(f.renderer)});
}

/// Names, units and limits of measures, which many pairs share.
class MeasureKinds {
 public:
  int add(const MeasuredValue& m) {
    const std::string key =
        fmt::format("{}\n{}\n{}\n{}\n{}", m.name, m.unit, m.warn_above, m.fail_above, m.below);
    const auto [found, is_new] = known_.emplace(key, int(list_.size()));
    if (is_new)
      list_.push_back(
          {one_line(m.name), m.unit, limit(m.warn_above), limit(m.fail_above), m.below});
    return found->second;
  }
  [[nodiscard]] const Json& list() const { return list_; }

 private:
  std::map<std::string, int> known_;
  Json list_ = Json::array();
};

Json counts_json(const DiffResult& result) {
  const Counts counts = counts_of(result);
  return {{"different", counts.different},
          {"unreadable", counts.unreadable},
          {"warning", counts.warning},
          {"same", counts.same}};
}

/// Pictures that are packed one after the other, to bound the memory: beyond 2896 x 2896 pixels.
bool is_large(const PairResult& pair) {
  const auto pixels = [](const FileFacts& f) { return uint64_t(f.width) * uint64_t(f.height); };
  return std::max(pixels(pair.a), pixels(pair.b)) > 1u << 23;
}

class Page {
 public:
  Page(const DiffResult& result, const EvidenceSource& evidence, const PageOptions& options)
      : result_(result), order_(worst_first(result.pairs)) {
    pictures_.resize(std::min<size_t>(order_.size(), std::max(0, options.pictures)));
    const auto pack = [&](size_t rank) {
      pictures_[rank] = pictures_of(result.pairs[order_[rank]], evidence, options.max_width);
    };
    parallel_for_ranges(pictures_.size(), 1, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i)
        if (!is_large(result.pairs[order_[i]])) pack(i);
    });
    for (size_t i = 0; i < pictures_.size(); ++i)
      if (is_large(result.pairs[order_[i]])) pack(i);
    keep_within(options.max_bytes);
  }

  [[nodiscard]] std::string html() {
    const std::string data = pipeline::data_element(data_json().dump());
    std::string elements;
    for (size_t i = 0; i < pictures_.size(); ++i)
      for (const auto& [name, text] : pictures_[i].elements)
        elements +=
            fmt::format("<script type=\"text/plain\" id=\"{}{}\">{}</script>\n", name, i, text);
    std::string scripts;
    for (const char* name : {"decode.js", "shade.js", "viewer.js", "input.js", "report.js"})
      scripts += diff_text(name);
    return pipeline::filled_page(diff_text("report.html"),
                                 {{"style", pipeline::style_element(diff_text("report.css"))},
                                  {"data", data},
                                  {"pictures", elements},
                                  {"script", pipeline::script_element(scripts)}});
  }

 private:
  static PackedPictures with_note(const std::string& note) {
    PackedPictures none;
    none.facts = {{"note", one_line(note)}};
    return none;
  }

  /// Noise does not pack: a page of it could be larger than a browser likes.
  void keep_within(size_t bytes) {
    size_t sum = 0;
    for (PackedPictures& pictures : pictures_) {
      for (const auto& [name, text] : pictures.elements) sum += text.size();
      if (sum > bytes && !pictures.elements.empty())
        pictures = with_note("those of worse pairs fill this page");
    }
  }

  static PackedPictures pictures_of(const PairResult& pair, const EvidenceSource& evidence,
                                    int max_width) {
    if (pair.error) return with_note(pair.error->message);
    const auto read = evidence(pair);
    if (!read) return with_note(read.error().message);
    return packed_pictures(*read, max_width);
  }

  Json data_json() {
    Json j{{"program", std::string("skylapse ") + kVersion},
           {"a", one_line(result_.a)},
           {"b", one_line(result_.b)},
           {"verdict", int(result_.verdict)},
           {"unreadable", result_.unreadable},
           {"seconds", number(result_.seconds)},
           {"counts", counts_json(result_)}};
    std::vector<const Finding*> whole;
    for (const Finding& f : result_.findings) whole.push_back(&f);
    j["findings"] = findings_json(whole);
    j["pairs"] = Json::array();
    for (size_t i = 0; i < order_.size(); ++i) j["pairs"].push_back(pair_json(i));
    j["kinds"] = kinds_.list();
    j["cameras"] = cameras_.list();
    return j;
  }

  Json pair_json(size_t rank) {
    const PairResult& pair = result_.pairs[order_[rank]];
    Json j{{"n", one_line(pair.name)},
           {"v", pair.error ? 3 : int(pair.verdict)},
           {"s", summary_text(pair)},
           {"p", one_line(pair.profile)}};
    if (!pair.golden.empty()) j["g"] = one_line(pair.golden);
    if (pair.error) j["e"] = Json{one_line(pair.error->message), one_line(pair.error->hint)};
    const Headline headline = headline_of(pair);
    const std::string region = headline.place ? headline.place->region : "";
    j["w"] = trimmed({one_line(headline.check), number(headline.ratio), one_line(region)});
    j["a"] = file_json(pair.a), j["b"] = file_json(pair.b);
    j["f"] = findings_json(structural_findings(pair));
    j["m"] = Json::array();
    for (const MeasuredValue& m : pair.measures)
      j["m"].push_back(trimmed({kinds_.add(m), number(m.value), int(m.verdict),
                                m.value != 0 ? place_json(m.place) : Json(nullptr)}));
    j["t"] = {number(pair.read_ms), number(pair.measure_ms), number(pair.flip_ms)};
    if (pair.view.sun)
      j["sun"] = {angle(azimuth(*pair.view.sun).in(deg)), angle(elevation(*pair.view.sun).in(deg))};
    if (rank < pictures_.size()) {
      j["pic"] = pictures_[rank].facts;
      if (pair.view.camera && !pictures_[rank].elements.empty()) add_camera(pair.view, j["pic"]);
    }
    return j;
  }

  void add_camera(const image::SkyView& view, Json& picture) {
    picture["camera"] = cameras_.add(*view.camera);
    if (!view.sun) return;
    if (const auto at = position_of(*view.camera, *view.sun))
      picture["sun"] = {number(at->x), number(at->y)};
  }

  const DiffResult& result_;
  std::vector<size_t> order_;
  std::vector<PackedPictures> pictures_;
  MeasureKinds kinds_;
  CameraGrids cameras_;
};

}  // namespace

std::string page_of(const DiffResult& result, const EvidenceSource& evidence,
                    const PageOptions& options) {
  return Page(result, evidence, options).html();
}

}  // namespace skylapse::diff
