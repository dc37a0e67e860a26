#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/printable.h"
#include "study/report.h"
#include "study/svg_chart.h"

namespace skylapse::study {
namespace {

bool is_drawn(const Measurement& m) {
  return m.skipped.empty() && std::isfinite(cost_of(m).error) && cost_of(m).ms > 0;
}

/// Colour and shape of a rung in the figures of errors against times: five kinds of model, and the
/// groups of variations of the base taken together as they cost and err alike.
struct Kind {
  const char* name;
  int number;
};
Kind kind_of(const Measurement& m) {
  const std::string& id = m.rung.id;
  if (id == kBaseRung) return {"Bruneton", 0};
  if (id == "cie" || id == "preetham") return {"CIE and Preetham", 3};
  if (id.starts_with("hosek")) return {"Hosek-Wilkie", 1};
  if (id.starts_with("single")) return {"single scattering", 2};
  if (id.starts_with("reference")) return {"reference (paths)", 4};
  if (m.rung.group == "sun" || m.rung.group == "refraction" || m.rung.group == "ozone")
    return {"Bruneton, sun or air changed", 7};
  if (m.rung.group == "mixture") return {"Bruneton, mixtures", 6};
  return {"Bruneton, one key changed", 5};
}

void draw_frame(Svg& svg, const Box& plot, const LogAxis& x, const LogAxis& y) {
  for (const double t : x.ticks()) {
    svg.line(x(t), plot.y, x(t), plot.y + plot.height, "grid");
    svg.text(x(t), plot.y + plot.height + 17, time_text(t), "s", "text-anchor=\"middle\"");
  }
  for (const double e : y.ticks()) {
    svg.line(plot.x, y(e), plot.x + plot.width, y(e), "grid");
    svg.text(plot.x - 7, y(e) + 4, percent_text(e), "s", "text-anchor=\"end\"");
  }
  svg.line(plot.x, plot.y + plot.height, plot.x + plot.width, plot.y + plot.height, "axis");
  svg.line(plot.x, plot.y, plot.x, plot.y + plot.height, "axis");
}

/// A staircase: between two rungs of the front, time buys nothing.
std::string staircase(const std::vector<Measurement>& rungs, const std::vector<size_t>& front,
                      const LogAxis& x, const LogAxis& y, double right) {
  std::string d;
  double level = 0;
  for (const size_t i : front) {
    const CostPoint c = cost_of(rungs[i]);
    if (d.empty())
      d = fmt::format("M{:.1f},{:.1f}", x(c.ms), y(c.error));
    else
      d += fmt::format("L{:.1f},{:.1f}L{:.1f},{:.1f}", x(c.ms), level, x(c.ms), y(c.error));
    level = y(c.error);
  }
  return d.empty() ? d : d + fmt::format("L{:.1f},{:.1f}", right, level);
}

/// The names of the kinds that occur, in rows under the title.
void draw_legend(Svg& svg, const std::vector<Measurement>& rungs, double left, double y,
                 double right) {
  std::map<int, std::string> kinds;
  for (const Measurement& m : rungs)
    if (is_drawn(m)) kinds[kind_of(m).number] = kind_of(m).name;
  double x = left;
  for (const auto& [number, name] : kinds) {
    const double width = 22 + text_width(name, 12);
    if (x + width > right) x = left, y += 18;
    svg.raw(marker(number, x + 6, y - 4) + "\n");
    svg.text(x + 16, y, name, "s");
    x += width + 8;
  }
}

Figure pareto_figure(const SceneResult& result, size_t scene) {
  const auto& rungs = result.rungs;
  const Box plot{64, 84, 760, 396};
  std::vector<double> times, errors;
  for (const Measurement& m : rungs)
    if (is_drawn(m)) times.push_back(cost_of(m).ms), errors.push_back(cost_of(m).error);
  const LogAxis x = axis_for(times, plot.x, plot.x + plot.width);
  const LogAxis y = axis_for(errors, plot.y + plot.height, plot.y);
  const std::string title = "Error against time: " + result.scene.title;
  Svg svg(850, 530, title,
          "Each mark is one way to compute this sky; the line joins those that nothing else beats "
          "in both time and error.");
  svg.text(16, 26, title, "t");
  draw_legend(svg, rungs, 20, 50, 830);
  draw_frame(svg, plot, x, y);
  svg.text(plot.x + plot.width / 2, 516, "core time of a frame of 540 x 270 pixels, tables ready",
           "s", "text-anchor=\"middle\"");
  svg.text(16, 300, "rms error of the sky", "s",
           "text-anchor=\"middle\" transform=\"rotate(-90 16 300)\"");
  const auto front = pareto_front(rungs);
  svg.path(staircase(rungs, front, x, y, plot.x + plot.width), "front");

  LabelPlacer labels(plot);
  for (const Measurement& m : rungs)
    if (is_drawn(m)) labels.block({x(cost_of(m).ms) - 6, y(cost_of(m).error) - 6, 12, 12});
  // The line itself, as thin boxes.
  for (size_t k = 0; k < front.size(); ++k) {
    const CostPoint here = cost_of(rungs[front[k]]);
    const bool last = k + 1 == front.size();
    const double right = last ? plot.x + plot.width : x(cost_of(rungs[front[k + 1]]).ms);
    labels.block({x(here.ms), y(here.error) - 1, right - x(here.ms), 2});
    if (!last)
      labels.block(
          {right - 1, y(here.error), 2, y(cost_of(rungs[front[k + 1]]).error) - y(here.error)});
  }
  const auto draw_label = [&](const Measurement& m, const char* css) {
    const double px = x(cost_of(m).ms), py = y(cost_of(m).error);
    const auto place = labels.place(px, py, m.rung.label, 12);
    if (!place.found) return;
    if (place.leader) {
      const double w = text_width(m.rung.label, 12);
      const double lx = std::clamp(px, place.x, place.x + w);
      svg.line(px, py, lx, place.y > py ? place.y - 10 : place.y + 2, "leader");
    }
    svg.text(place.x, place.y, m.rung.label, css);
  };
  for (const size_t i : front) draw_label(rungs[i], "b");
  for (const Measurement& m : rungs)
    if (is_drawn(m) && (m.rung.group == "model") &&
        std::none_of(front.begin(), front.end(), [&](size_t i) { return &rungs[i] == &m; }))
      draw_label(m, "s");
  for (size_t i = 0; i < rungs.size(); ++i) {
    const Measurement& m = rungs[i];
    if (!is_drawn(m)) continue;
    svg.raw(fmt::format(
        "<g data-scene=\"{}\" data-rung=\"{}\"><title>{}: {} off, {} a frame</title>{}</g>\n",
        scene, i, xml_escaped(m.rung.label), percent_text(cost_of(m).error),
        time_text(cost_of(m).ms),
        marker(kind_of(m).number, x(cost_of(m).ms), y(cost_of(m).error))));
  }
  return {"pareto_" + result.scene.id, title, svg.document()};
}

/// The rungs of a group in their order, the base in its place; labels without the group's name.
struct Series {
  std::vector<std::string> labels;
  std::vector<const Measurement*> points;
};

std::string short_label(const Rung& rung) {
  const size_t cut = rung.id.find('-');
  return cut == std::string::npos ? rung.id : rung.id.substr(cut + 1);
}

Series series_of(const SceneResult& result, const RungGroup& group) {
  Series s;
  const Measurement* base = nullptr;
  for (const Measurement& m : result.rungs)
    if (m.rung.id == kBaseRung) base = &m;
  for (const Measurement& m : result.rungs) {
    if (m.rung.group != group.name) continue;
    s.labels.push_back(short_label(m.rung));
    s.points.push_back(&m);
  }
  if (base == nullptr || s.points.empty()) return {};
  // A quick study has fewer rungs; the base keeps its side of those it has.
  const auto& all = ladder(false);
  int place = 0, rank = 0;
  for (const Rung& rung : all) {
    if (rung.group != group.name) continue;
    if (rank++ < group.before_base &&
        std::any_of(s.points.begin(), s.points.end(),
                    [&](const Measurement* m) { return m->rung.id == rung.id; }))
      ++place;
  }
  s.labels.insert(s.labels.begin() + place, group.base);
  s.points.insert(s.points.begin() + place, base);
  return s;
}

/// Single scattering by steps, as a group of its own.
Series single_scattering_series(const SceneResult& result) {
  Series s;
  for (const Measurement& m : result.rungs)
    if (m.rung.id.starts_with("single-scattering-")) {
      s.labels.push_back(m.rung.id.substr(18));
      s.points.push_back(&m);
    }
  return s;
}

struct Panel {
  std::string title;
  std::vector<Series> of_scene;
};

std::vector<Panel> panels_of(const StudyResult& study) {
  std::vector<Panel> panels;
  const auto add = [&](Panel panel) {
    if (std::any_of(panel.of_scene.begin(), panel.of_scene.end(),
                    [](const Series& s) { return s.points.size() > 1; }))
      panels.push_back(std::move(panel));
  };
  for (const RungGroup& group : rung_groups()) {
    if (group.base.empty()) continue;
    Panel panel{group.title, {}};
    for (const SceneResult& scene : study.scenes) panel.of_scene.push_back(series_of(scene, group));
    add(std::move(panel));
  }
  Panel steps{"Single scattering, steps", {}};
  for (const SceneResult& scene : study.scenes)
    steps.of_scene.push_back(single_scattering_series(scene));
  add(std::move(steps));
  return panels;
}

template <class Value>
void draw_panel(Svg& svg, const Panel& panel, const Box& plot, const LogAxis& y, Value value_of,
                std::string (*tick_text)(double)) {
  svg.text(plot.x, plot.y - 10, panel.title, "b");
  for (const double t : y.ticks()) {
    svg.line(plot.x, y(t), plot.x + plot.width, y(t), "grid");
    svg.text(plot.x - 6, y(t) + 4, tick_text(t), "s", "text-anchor=\"end\"");
  }
  for (size_t scene = 0; scene < panel.of_scene.size(); ++scene) {
    const Series& s = panel.of_scene[scene];
    const auto x = [&](size_t i) {
      return plot.x + plot.width * (double(i) + 0.5) / double(s.points.size());
    };
    std::string d, marks;
    for (size_t i = 0; i < s.points.size(); ++i) {
      if (scene == 0)
        svg.text(x(i), plot.y + plot.height + 16, s.labels[i], "s", "text-anchor=\"middle\"");
      if (!is_drawn(*s.points[i])) continue;
      const double py = y(value_of(*s.points[i]));
      d += fmt::format("{}{:.1f},{:.1f}", d.empty() ? "M" : "L", x(i), py);
      marks += marker(int(scene), x(i), py);
    }
    svg.path(d, fmt::format("series l{}", scene % 8));
    svg.raw(marks + "\n");
  }
}

/// Small multiples: a panel for each group, a line for each scene.
template <class Value>
Figure multiples(const StudyResult& study, const std::string& name, const std::string& title,
                 Value value_of, std::string (*tick_text)(double)) {
  const auto panels = panels_of(study);
  constexpr int kColumns = 3;
  constexpr double kWidth = 280, kHeight = 210;
  const int rows = int((panels.size() + kColumns - 1) / kColumns);
  std::vector<double> values;
  for (const Panel& panel : panels)
    for (const Series& s : panel.of_scene)
      for (const Measurement* m : s.points)
        if (is_drawn(*m)) values.push_back(value_of(*m));
  Svg svg(kColumns * kWidth + 10, rows * kHeight + 70, title,
          "Each panel varies one thing; each line is a scene.");
  svg.text(16, 26, title, "t");
  double legend = 20;
  for (size_t i = 0; i < study.scenes.size(); ++i) {
    svg.raw(marker(int(i), legend + 6, 46) + "\n");
    svg.text(legend + 16, 50, study.scenes[i].scene.title, "s");
    legend += 34 + text_width(study.scenes[i].scene.title, 12);
  }
  for (size_t i = 0; i < panels.size(); ++i) {
    const Box plot{62 + double(i % kColumns) * kWidth, 96 + double(i / kColumns) * kHeight,
                   kWidth - 72, kHeight - 72};
    draw_panel(svg, panels[i], plot, axis_for(values, plot.y + plot.height, plot.y), value_of,
               tick_text);
  }
  return {name, title, svg.document()};
}

}  // namespace

std::vector<Figure> figures_of(const StudyResult& study) {
  std::vector<Figure> figures;
  for (size_t i = 0; i < study.scenes.size(); ++i)
    figures.push_back(pareto_figure(study.scenes[i], i));
  if (panels_of(study).empty()) return figures;
  figures.push_back(multiples(
      study, "error_by_setting", "What each setting does to the error",
      [](const Measurement& m) { return cost_of(m).error; }, percent_text));
  figures.push_back(multiples(
      study, "time_by_setting", "What each setting does to the core time of a frame",
      [](const Measurement& m) { return cost_of(m).ms; }, time_text));
  return figures;
}

}  // namespace skylapse::study
