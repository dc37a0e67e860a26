#include "study/svg_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/printable.h"

namespace skylapse::study {
namespace {

/// Light, then dark. Series 0..7 after Okabe & Ito; black and yellow are changed where they would
/// not be seen.
constexpr const char* kStyle = R"(<style>
.sk{--paper:#ffffff;--ink:#1c2128;--soft:#5b6470;--grid:#e3e6ea;--band:#eef1f4;--front:#1c2128;
--c0:#0072b2;--c1:#d55e00;--c2:#009e73;--c3:#cc79a7;--c4:#b8860b;--c5:#56b4e9;--c6:#8b5a2b;--c7:#4d4d4d;
font-family:system-ui,-apple-system,"Segoe UI",Roboto,"DejaVu Sans",sans-serif}
@media (prefers-color-scheme:dark){.sk{--paper:#14181d;--ink:#e8ebef;--soft:#a3adb8;--grid:#2a3038;--band:#1d232a;--front:#e8ebef;
--c0:#4aa3df;--c1:#ff8c42;--c2:#2fc79b;--c3:#e6a3c8;--c4:#e6b422;--c5:#8fd0f5;--c6:#c08a54;--c7:#b0b0b0}}
.sk .paper{fill:var(--paper)}.sk .band{fill:var(--band)}.sk .grid{stroke:var(--grid);stroke-width:1;fill:none}
.sk .axis{stroke:var(--soft);stroke-width:1;fill:none}.sk .front{stroke:var(--front);stroke-width:2;fill:none;stroke-linejoin:round}
.sk .leader{stroke:var(--soft);stroke-width:.7;fill:none}.sk .t{fill:var(--ink);font-size:15px;font-weight:600}
.sk .s{fill:var(--soft);font-size:12px}.sk .l{fill:var(--ink);font-size:12px}.sk .b{fill:var(--ink);font-size:12px;font-weight:600}
.sk .m{stroke:var(--paper);stroke-width:1.2}.sk .on{stroke:var(--front);stroke-width:2}
.sk .k0{fill:var(--c0)}.sk .k1{fill:var(--c1)}.sk .k2{fill:var(--c2)}.sk .k3{fill:var(--c3)}
.sk .k4{fill:var(--c4)}.sk .k5{fill:var(--c5)}.sk .k6{fill:var(--c6)}.sk .k7{fill:var(--c7)}
.sk .l0{stroke:var(--c0)}.sk .l1{stroke:var(--c1)}.sk .l2{stroke:var(--c2)}.sk .l3{stroke:var(--c3)}
.sk .l4{stroke:var(--c4)}.sk .l5{stroke:var(--c5)}.sk .l6{stroke:var(--c6)}.sk .l7{stroke:var(--c7)}
.sk .series{fill:none;stroke-width:1.8}
</style>)";

/// 1, 2 or 5 of a decade, at most (or at least) `value`.
double round_down(double value) {
  const double decade = std::pow(10, std::floor(std::log10(value)));
  const double lead = value / decade * (1 + 1e-12);
  return decade * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
}
double round_up(double value) {
  const double low = round_down(value);
  if (low >= value * (1 - 1e-12)) return low;
  const double decade = std::pow(10, std::floor(std::log10(low * (1 + 1e-9))));
  const double lead = low / decade;
  return decade * (lead < 1.5 ? 2 : lead < 3 ? 5 : 10);
}

}  // namespace

std::string time_text(double ms) {
  if (ms < 1) return fmt::format("{:.2g} ms", ms);
  if (ms < 10) return fmt::format("{:.2g} ms", ms);
  if (ms < 1000) return fmt::format("{:.0f} ms", ms);
  if (ms < 10'000) return fmt::format("{:.2g} s", ms / 1000);
  if (ms < 120'000) return fmt::format("{:.0f} s", ms / 1000);
  if (ms < 7'200'000) return fmt::format("{:.0f} min", ms / 60'000);
  return fmt::format("{:.0f} h", ms / 3'600'000);
}

std::string percent_text(double share) {
  const double percent = 100 * share;
  if (percent < 1) return fmt::format("{:.2g} %", percent);
  if (percent < 10) return fmt::format("{:.2g} %", percent);
  return fmt::format("{:.0f} %", percent);
}

double LogAxis::operator()(double value) const {
  const double share = std::log(std::clamp(value, low, high) / low) / std::log(high / low);
  return at_low + share * (at_high - at_low);
}

std::vector<double> LogAxis::ticks() const {
  const bool many = high / low > 1100;
  std::vector<double> values;
  const int first = int(std::floor(std::log10(low))), last = int(std::ceil(std::log10(high)));
  for (int d = first; d <= last; ++d)
    for (const int lead : {1, 2, 5}) {
      if (many && lead != 1) continue;
      const double v = lead * std::pow(10, d);
      if (v >= low * (1 - 1e-9) && v <= high * (1 + 1e-9)) values.push_back(v);
    }
  return values;
}

LogAxis axis_for(const std::vector<double>& values, double at_low, double at_high) {
  double low = HUGE_VAL, high = 0;
  for (const double v : values)
    if (v > 0 && std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  if (high == 0) low = 0.1, high = 10;
  low = round_down(low / 1.15), high = round_up(high * 1.15);
  return {low, high, at_low, at_high};
}

double text_width(const std::string& text, double font_size) {
  return 0.56 * font_size * double(text.size());
}

LabelPlacer::Place LabelPlacer::place(double x, double y, const std::string& text,
                                      double font_size) {
  const double w = text_width(text, font_size), h = font_size * 1.1;
  const auto box_at = [&](double left, double base) {
    return Box{left - 2, base - h + 2, w + 4, h};
  };
  for (const double off : {9.0, 20.0, 36.0, 56.0, 80.0}) {
    const double up = y - off * 0.75, down = y + off * 0.75 + font_size * 0.7;
    const std::pair<double, double> tries[] = {{x + off, y + 4},         {x + off * 0.8, up},
                                               {x + off * 0.8, down},    {x - off - w, y + 4},
                                               {x - off * 0.8 - w, up},  {x - off * 0.8 - w, down},
                                               {x - w / 2, y - off - 1}, {x - w / 2, y + off + 9}};
    for (const auto& [left, base] : tries) {
      const Box box = box_at(left, base);
      if (box.x < frame_.x || box.y < frame_.y || box.x + box.width > frame_.x + frame_.width ||
          box.y + box.height > frame_.y + frame_.height)
        continue;
      if (std::any_of(taken_.begin(), taken_.end(), [&](const Box& b) { return b.meets(box); }))
        continue;
      taken_.push_back(box);
      return {left, base, off > 10};
    }
  }
  return {0, 0, false, false};
}

Svg::Svg(double width, double height, const std::string& title, const std::string& description)
    : width_(width), height_(height), title_(title), description_(description) {}

void Svg::line(double x1, double y1, double x2, double y2, const std::string& css) {
  body_ +=
      fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n",
                  x1, y1, x2, y2, css);
}

void Svg::path(const std::string& d, const std::string& css) {
  body_ += fmt::format("<path d=\"{}\" class=\"{}\"/>\n", d, css);
}

void Svg::rect(const Box& box, const std::string& css) {
  body_ += fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" class=\"{}\"/>\n", box.x,
      box.y, box.width, box.height, css);
}

void Svg::text(double x, double y, const std::string& text, const std::string& css,
               const std::string& attributes) {
  body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\"{}{}>{}</text>\n", x, y, css,
                       attributes.empty() ? "" : " ", attributes, xml_escaped(text));
}

std::string Svg::document() const {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"sk\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "role=\"img\" aria-label=\"{2}\">\n<title>{2}</title>\n<desc>{3}</desc>\n{4}\n"
      "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" class=\"paper\"/>\n{5}</svg>\n",
      width_, height_, xml_escaped(title_), xml_escaped(description_), kStyle, body_);
}

std::string marker(int number, double x, double y) {
  const std::string css = fmt::format("m k{}", number % 8);
  const auto polygon = [&](const std::vector<std::pair<double, double>>& corners) {
    std::string points;
    for (const auto& [dx, dy] : corners) points += fmt::format("{:.1f},{:.1f} ", x + dx, y + dy);
    return fmt::format("<polygon points=\"{}\" class=\"{}\"/>", points, css);
  };
  switch (number % 8) {
    case 0:
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" class=\"{}\"/>", x, y, css);
    case 1:
      return polygon({{-4.5, -4.5}, {4.5, -4.5}, {4.5, 4.5}, {-4.5, 4.5}});
    case 2:
      return polygon({{0, -5.8}, {5.4, 4}, {-5.4, 4}});
    case 3:
      return polygon({{0, -6}, {6, 0}, {0, 6}, {-6, 0}});
    case 4:
      return polygon({{0, 5.8}, {5.4, -4}, {-5.4, -4}});
    case 5:
      return polygon({{-6, -2},
                      {-2, -2},
                      {-2, -6},
                      {2, -6},
                      {2, -2},
                      {6, -2},
                      {6, 2},
                      {2, 2},
                      {2, 6},
                      {-2, 6},
                      {-2, 2},
                      {-6, 2}});
    case 6:
      return polygon({{0, -6}, {5.7, -1.9}, {3.5, 4.9}, {-3.5, 4.9}, {-5.7, -1.9}});
    default:
      return polygon({{-6, 0}, {-3, -5.2}, {3, -5.2}, {6, 0}, {3, 5.2}, {-3, 5.2}});
  }
}

}  // namespace skylapse::study
