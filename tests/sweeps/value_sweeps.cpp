// Colour, exposure, and values as people write them.
#include <fmt/format.h>

#include "color/cie_observer.h"
#include "color/exposure.h"
#include "color/rgb_space.h"
#include "config/quantity_parser.h"
#include "config/time_expression.h"
#include "sweeps/sweep.h"

namespace skylapse::sweeps {
namespace {

using namespace skylapse::color;

/// Light from starlight to the sun's disc, some of it outside every gamut.
glm::dvec3 draw_light(Draw& draw) {
  const double scale = draw.magnitude(1e-30, 1e30);
  return scale * glm::dvec3(draw.in(-1, 1), draw.in(-1, 1), draw.in(-1, 1));
}

void add_color(std::vector<Sweep>& sweeps) {
  sweeps.push_back({"color: XYZ to RGB and back", "relative to the largest channel", 1e-14,
                    "two 3 x 3 matrices with entries up to 2.8", 1, [](Draw& draw, Tally& tally) {
                      const auto space = RgbSpace(draw.below(4));
                      const glm::dvec3 xyz = draw_light(draw);
                      const auto where = [&] {
                        return fmt::format("space {} XYZ {:.17g} {:.17g} {:.17g}", int(space),
                                           xyz.x, xyz.y, xyz.z);
                      };
                      const glm::dvec3 back = to_xyz(to_rgb({xyz}, space), space).value;
                      if (!tally.finite(back.x + back.y + back.z, where)) return;
                      const glm::dvec3 off = glm::abs(back - xyz), size = glm::abs(xyz);
                      // Denormal numbers have fewer digits.
                      const double largest = std::max({size.x, size.y, size.z});
                      if (largest > 1e-290)
                        tally.error(std::max({off.x, off.y, off.z}) / largest, where);
                    }});
  sweeps.push_back({"color: chromaticity and temperature", "none", 0, "laws alone", 1,
                    [](Draw& draw, Tally& tally) {
                      const glm::dvec3 xyz = glm::abs(draw_light(draw));
                      const auto where = [&] {
                        return fmt::format("XYZ {:.17g} {:.17g} {:.17g}", xyz.x, xyz.y, xyz.z);
                      };
                      const Chromaticity c = chromaticity({xyz});
                      const UniformChromaticity u = uniform_chromaticity({xyz});
                      if (!tally.finite(c.x + c.y + u.u + u.v, where)) return;
                      tally.law(c.x >= 0 && c.y >= 0 && c.x + c.y <= 1 + 1e-12, where);
                    }});
  sweeps.push_back({"color: xyz_of_spectrum", "of sums, relative", 1e-12, "integration is linear",
                    0.01, [](Draw& draw, Tally& tally) {
                      std::vector<Wavelength> nodes;
                      std::vector<double> a, b, sum;
                      double at = draw.in(200, 500);
                      for (int i = 0, n = 1 + draw.below(40); i < n; ++i) {
                        nodes.push_back(at * nm);
                        at += draw.magnitude(0.01, 100);
                        a.push_back(draw.magnitude(1e-6, 1e6));
                        b.push_back(draw.magnitude(1e-6, 1e6));
                        sum.push_back(a.back() + b.back());
                      }
                      const auto where = [&] {
                        return fmt::format("{} nodes {:.17g}..{:.17g} nm", nodes.size(),
                                           nodes[0].in(nm), nodes.back().in(nm));
                      };
                      const glm::dvec3 both = xyz_of_spectrum(nodes, sum).value;
                      if (!tally.finite(both.x + both.y + both.z, where)) return;
                      tally.law(both.x >= 0 && both.y >= 0 && both.z >= 0, where);
                      const glm::dvec3 parts =
                          xyz_of_spectrum(nodes, a).value + xyz_of_spectrum(nodes, b).value;
                      if (both.y > 0) tally.error(std::abs(parts.y / both.y - 1), where);
                    }});
}

void add_exposure(std::vector<Sweep>& sweeps) {
  sweeps.push_back({"color: metered_ev and sun_curve_ev", "none", 0, "laws alone", 1,
                    [](Draw& draw, Tally& tally) {
                      const double light = draw.below(8) == 0 ? 0 : draw.magnitude(1e-30, 1e12);
                      const double more = std::max(light, 1e-30) * (1 + draw.magnitude(1e-9, 10));
                      const auto where = [&] { return fmt::format("{:.17g} cd/m2", light); };
                      for (const auto curve : {metered_ev, sun_curve_ev}) {
                        const double ev = curve(light * cd_per_m2);
                        if (!tally.finite(ev, where)) continue;
                        tally.law(curve(more * cd_per_m2) >= ev, where);
                        const double scale = exposure_scale_per_cd_m2(ev);
                        tally.law(std::isfinite(scale) && scale > 0, where);
                        tally.law(exposure_time_at_f8(ev).in(second) > 0, where);
                      }
                    }});
  sweeps.push_back({"color: follow_meter", "stops beyond the rate", 1e-9, "sums in double", 0.02,
                    [](Draw& draw, Tally& tally) {
                      std::vector<MeteredFrame> frames;
                      double at = 0;
                      for (int i = 0; i < 50; ++i) {
                        frames.push_back({at * second, draw.in(-10, 20)});
                        at += draw.below(4) == 0 ? 0 : draw.magnitude(1e-3, 1e4);
                      }
                      const double rate = draw.in(0, 5);
                      const auto where = [&] { return fmt::format("rate {:.17g}", rate); };
                      const auto followed = follow_meter(frames, rate);
                      tally.law(followed.size() == frames.size(), where);
                      for (size_t i = 0; i < followed.size(); ++i) {
                        if (!tally.finite(followed[i], where) || i == 0) continue;
                        const double minutes = (frames[i].time - frames[i - 1].time).in(minute);
                        tally.error(std::abs(followed[i] - followed[i - 1]) - rate * minutes,
                                    where);
                      }
                    }});
}

/// A value written in a unit, read back.
void read_back(Draw& draw, Tally& tally) {
  using namespace config;
  const auto dimension = Dimension(1 + draw.below(int(Dimension::share)));
  const auto& units = info_of(dimension).units;
  const UnitName& unit = units[size_t(draw.below(int(units.size())))];
  const double sign = draw.below(2) == 0 ? 1 : -1;
  const double value = draw.below(8) == 0 ? 0 : sign * draw.magnitude(1e-250, 1e250);
  const std::string text = fmt::format("{:.17g} {}", value, unit.symbol);
  const auto where = [&] { return text; };
  const auto read = parse_quantity(text, dimension);
  tally.law(read.ok(), where);
  if (!read || !tally.finite(*read, where)) return;
  const double truth = value * unit.factor + unit.offset;
  if (truth != 0) tally.error(std::abs(*read / truth - 1), where);
}

void add_texts(std::vector<Sweep>& sweeps) {
  sweeps.push_back({"config: parse_quantity", "relative", 2.3e-16, "one rounding", 1, read_back});
  sweeps.push_back({"config: parse_number", "relative", 0, "the shortest text reads back exactly",
                    1, [](Draw& draw, Tally& tally) {
                      const double value = draw.below(4) == 0 ? draw.in(-1e308, 1e308)
                                                              : draw.magnitude(2.3e-308, 1e308);
                      const std::string text = fmt::format("{}", value);
                      const auto where = [&] { return text; };
                      const auto read = config::parse_number(text);
                      // A text below the normal numbers may be refused: from_chars calls it out of
                      // range.
                      if (std::fpclassify(value) == FP_SUBNORMAL && !read) return;
                      tally.law(read.ok(), where);
                      if (read && tally.finite(*read, where)) tally.law(*read == value, where);
                    }});
  sweeps.push_back({"config: parse_time_expression", "seconds", 1e-6,
                    "times are kept to the microsecond", 0.2, [](Draw& draw, Tally& tally) {
                      const int h = draw.below(24), m = draw.below(60), s = draw.below(60);
                      const int micro = draw.below(1'000'000);
                      const double shift = std::floor(draw.magnitude(1, 400 * 86400));
                      const std::string text =
                          fmt::format("{:02}:{:02}:{:02}.{:06} {} {} s", h, m, s, micro,
                                      draw.below(2) == 0 ? '+' : '-', shift);
                      const auto where = [&] { return text; };
                      const auto time = config::parse_time_expression(text);
                      tally.law(time.ok() && time->clock, where);
                      if (!time || !time->clock) return;
                      const double clock = double(time->clock->count()) * 1e-6;
                      if (!tally.finite(clock + time->offset.in(second), where)) return;
                      tally.law(std::abs(time->offset.in(second)) == shift, where);
                      tally.error(std::abs(clock - (h * 3600 + m * 60 + s + micro * 1e-6)), where);
                    }});
}

}  // namespace

void add_value_sweeps(std::vector<Sweep>& sweeps) {
  add_color(sweeps);
  add_exposure(sweeps);
  add_texts(sweeps);
}

}  // namespace skylapse::sweeps
