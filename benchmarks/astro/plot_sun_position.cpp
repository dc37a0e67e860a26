// Draws docs/images/sun-position.svg: the azimuth and the error of every rung through one day.
//
//   plot_sun_position OUT.svg [LATITUDE LONGITUDE YYYY-MM-DD]     default Prague 2026-06-21
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "astro/ephemeris/ephemeris.h"

using namespace skylapse;
using namespace skylapse::astro;

namespace {

struct Line {
  SunAlgorithm algorithm;
  const char* colour;
  const char* dash;
  double width;
};
constexpr Line kLines[] = {
    {SunAlgorithm::preetham, "#d1495b", "", 2.2},
    {SunAlgorithm::erfa, "#1b4965", "", 3.0},
    {SunAlgorithm::preetham_atan2, "#edae49", "7 5", 2.0},
    {SunAlgorithm::sg2, "#2a9d8f", "2 4", 2.0},
};

/// A rectangle of the picture with its scales.
struct Panel {
  double left, top, width, height;
  double x_max;         // minutes
  double y_min, y_max;  // bottom and top value
  [[nodiscard]] double x(double v) const { return left + width * v / x_max; }
  [[nodiscard]] double y(double v) const {
    return top + height * (1 - (v - y_min) / (y_max - y_min));
  }
};

struct Curve {
  std::vector<double> minutes, values;
};

std::string text(double x, double y, const std::string& words, const char* anchor = "middle",
                 const char* colour = "#333") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n",
                     x, y, anchor, colour, words);
}

std::string rule(double x1, double y1, double x2, double y2) {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" "
      "stroke=\"#ddd\"/>\n",
      x1, y1, x2, y2);
}

/// A polyline that is lifted where the value leaps by more than `leap`.
std::string polyline(const Panel& panel, const Curve& curve, const Line& style, double leap) {
  std::string path;
  for (size_t i = 0; i < curve.values.size(); ++i) {
    const bool begin = i == 0 || std::abs(curve.values[i] - curve.values[i - 1]) > leap;
    path += fmt::format("{}{:.1f} {:.1f} ", begin ? 'M' : 'L', panel.x(curve.minutes[i]),
                        panel.y(curve.values[i]));
  }
  return fmt::format(
      "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
      "stroke-dasharray=\"{}\"/>\n",
      path, style.colour, style.width, style.dash);
}

/// Grey bands where the sun's centre is below the sunrise level.
std::string night(const Panel& p, const Ephemeris& judge, const GeodeticPosition& place,
                  const Instant& begin) {
  const auto down = [&](int m) {
    return elevation(judge.sun_state(begin + m * 1.0 * minute, place, {}).sun_true) <
           -50.0 * arcmin;
  };
  std::string svg;
  for (int m = 0; m < 1440;) {
    const int from = m;
    while (m < 1440 && down(m)) ++m;
    if (m > from)
      svg += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
          "fill=\"#eef0f3\"/>\n",
          p.x(from), p.top, p.x(m) - p.x(from), p.height);
    while (m < 1440 && !down(m)) ++m;
  }
  return svg;
}

std::string frame(const Panel& p, const std::string& title,
                  const std::vector<std::pair<double, std::string>>& ticks) {
  std::string svg;
  for (int h = 0; h <= 24; h += 3) {
    svg += rule(p.x(60.0 * h), p.top, p.x(60.0 * h), p.top + p.height);
    svg += text(p.x(60.0 * h), p.top + p.height + 18, fmt::format("{:02}:00", h));
  }
  for (const auto& [value, label] : ticks) {
    svg += rule(p.left, p.y(value), p.left + p.width, p.y(value));
    svg += text(p.left - 8, p.y(value) + 4, label, "end");
  }
  return svg + text(p.left, p.top - 10, title, "start");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 5) {
    fmt::print(stderr, "usage: plot_sun_position OUT.svg [LATITUDE LONGITUDE YYYY-MM-DD]\n");
    return 3;
  }
  const bool default_day = argc == 2;
  const double latitude = default_day ? 50.0755 : std::atof(argv[2]);
  const double longitude = default_day ? 14.4378 : std::atof(argv[3]);
  const std::string date = default_day ? "2026-06-21" : argv[4];
  const auto midnight = parse_instant(date + "T00:00Z");
  if (!midnight) {
    fmt::print(stderr, "{}\n", format_error(midnight.error()));
    return 3;
  }
  const GeodeticPosition place{latitude * deg, longitude * deg, 235.0 * metre};
  // Mean solar time of the place, so that noon stands in the middle.
  const Instant begin = *midnight + -longitude / 15 * hour;

  const Panel azimuths{70, 50, 780, 300, 1440, 0, 360};
  const Panel errors{70, 420, 780, 230, 1440, -5.5, 2.6};  // log10 of degrees
  const Ephemeris judge;
  std::string body = night(azimuths, judge, place, begin) + night(errors, judge, place, begin);
  body += frame(azimuths, "azimuth, degrees from north",
                {{0, "0 N"}, {90, "90 E"}, {180, "180 S"}, {270, "270 W"}, {360, "360 N"}});
  body += frame(errors, "angle from the erfa path, degrees",
                {{-5, "0.00001"},
                 {-4, "0.0001"},
                 {-3, "0.001"},
                 {-2, "0.01"},
                 {-1, "0.1"},
                 {0, "1"},
                 {1, "10"},
                 {2, "100"}});
  double key_x = azimuths.left;
  for (const Line& line : kLines) {
    const Ephemeris ephemeris({.algorithm = line.algorithm});
    Curve azimuth_curve, error_curve;
    for (int m = 0; m <= 1440; m += 2) {
      const Instant t = begin + m * 1.0 * minute;
      const Direction<Enu> sun = ephemeris.sun_state(t, place, {}).sun_true;
      const double error = separation(sun, judge.sun_state(t, place, {}).sun_true).in(deg);
      azimuth_curve.minutes.push_back(m);
      azimuth_curve.values.push_back(azimuth(sun).in(deg));
      error_curve.minutes.push_back(m);
      error_curve.values.push_back(std::max(errors.y_min, std::log10(error + 1e-12)));
    }
    body += polyline(azimuths, azimuth_curve, line, 90);
    if (line.algorithm != SunAlgorithm::erfa) body += polyline(errors, error_curve, line, 9);
    body += fmt::format(
        "<path d=\"M{:.0f} 14 h34\" stroke=\"{}\" stroke-width=\"{}\" "
        "stroke-dasharray=\"{}\"/>\n",
        key_x, line.colour, line.width, line.dash);
    body += text(key_x + 42, 18, name_of(line.algorithm), "start");
    key_x += 170;
  }
  std::ofstream out(argv[1]);
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"880\" height=\"700\" "
         "viewBox=\"0 0 880 700\" font-family=\"sans-serif\" font-size=\"13\">\n"
         "<rect width=\"880\" height=\"700\" fill=\"white\"/>\n"
      << body
      << text(
             460, 690,
             fmt::format("mean solar time at {:.4f} N {:.4f} E on {} (grey: sun below the horizon)",
                         latitude, longitude, date))
      << "</svg>\n";
  out.close();
  if (!out) {
    fmt::print(stderr, "cannot write {}\n", argv[1]);
    return 6;
  }
}
