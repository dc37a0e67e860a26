#include "diff/heat_map_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "color/false_color.h"
#include "core/parallel.h"
#include "diff/shrink.h"
#include "diff/wording.h"

namespace skylapse::diff {
namespace {

using image::FrameBuffer;
using Colour = std::array<float, 3>;

constexpr Colour kBackground{0.14f, 0.14f, 0.16f}, kInk{1, 1, 1};
constexpr Colour kEqual{0, 0, 0}, kNoNumber{0, 0.9f, 0.9f}, kWorst{0.2f, 1, 0.3f};
constexpr int kText = 13, kLine = 18;  // heights of letters and of lines of text
constexpr int kLeft = 40, kRight = 16, kTop = 2 * kLine + 26, kBottom = 62;
constexpr int kLeastWidth = 560, kLargestWidth = 4096;

/// Ends and marks of the scales.
struct Scale {
  double from, to;
  std::vector<double> marks;
  const char* unit;
  const char* title;
};

const Scale& scale_of(bool display_referred) {
  static const Scale light{
      1e-4, 1, {1e-4, 1e-3, 1e-2, 0.1, 1}, "%", "error as a share of the light"};
  static const Scale codes{0.1, 255, {0.1, 1, 10, 100, 255}, "", "error in 8-bit code values"};
  return display_referred ? codes : light;
}

Colour colour_of(float error, bool display_referred) {
  if (!std::isfinite(error)) return kNoNumber;
  if (error == 0) return kEqual;
  // The lowest tenth of the colours cannot be told from black.
  const glm::dvec3 c = color::inferno(0.1 + 0.9 * place_on_scale(error, display_referred)) / 255.0;
  return {float(c.x), float(c.y), float(c.z)};
}

void set(FrameBuffer& image, int x, int y, const Colour& colour) {
  if (x < 0 || y < 0 || x >= image.width() || y >= image.height()) return;
  std::copy(colour.begin(), colour.end(), image.pixel(x, y));
}

void fill(FrameBuffer& image, int x, int y, int width, int height, const Colour& colour) {
  for (int row = y; row < y + height; ++row)
    for (int column = x; column < x + width; ++column) set(image, column, row, colour);
}

void frame(FrameBuffer& image, int x, int y, int width, int height, const Colour& colour) {
  fill(image, x, y, width, 1, colour);
  fill(image, x, y + height - 1, width, 1, colour);
  fill(image, x, y, 1, height, colour);
  fill(image, x + width - 1, y, 1, height, colour);
}

void ring(FrameBuffer& image, double x, double y, double radius, const Colour& colour) {
  const int reach = int(radius) + 2;
  for (int row = int(y) - reach; row <= int(y) + reach; ++row)
    for (int column = int(x) - reach; column <= int(x) + reach; ++column)
      if (std::abs(std::hypot(column + 0.5 - x, row + 0.5 - y) - radius) < 0.7)
        set(image, column, row, colour);
}

/// Where the picture lies on the panel, and how large its pixels are there.
struct Layout {
  int magnified = 1, shrunk = 1;
  int width = 0, height = 0;  // of the picture on the panel
  [[nodiscard]] double x(double column) const { return kLeft + column * magnified / shrunk; }
  [[nodiscard]] double y(double row) const { return kTop + row * magnified / shrunk; }
};

Layout layout_of(int width, int height) {
  Layout layout;
  layout.shrunk = shrink_factor(width, height, kLargestWidth);
  layout.width = (width + layout.shrunk - 1) / layout.shrunk;
  layout.height = (height + layout.shrunk - 1) / layout.shrunk;
  constexpr int kWanted = 512, kMost = 64;
  layout.magnified = std::clamp(kWanted / std::max(layout.width, layout.height), 1, kMost);
  layout.width *= layout.magnified;
  layout.height *= layout.magnified;
  return layout;
}

class Panel {
 public:
  Panel(const output::ImageIo& io, const Layout& layout)
      : io_(io),
        layout_(layout),
        image_(std::max(kLeastWidth, kLeft + layout.width + kRight),
               kTop + layout.height + kBottom) {
    fill(image_, 0, 0, image_.width(), image_.height(), kBackground);
  }
  void draw_errors(const std::vector<float>& errors, int width, int height, bool display_referred);
  void draw_title(const PairResult& pair);
  void draw_scale(bool display_referred);
  void draw_sky(const image::SkyView& view);
  void draw_worst(const std::vector<float>& errors, int width);
  Result<FrameBuffer> finish() {
    if (!state_) return state_.error();
    return std::move(image_);
  }

 private:
  enum class Align { left, middle, right };
  void text(double x, double baseline, const std::string& words, Align align = Align::left);
  void draw_lat_long(const image::Camera& camera);
  void draw_compass(const image::Camera& camera);

  const output::ImageIo& io_;
  Layout layout_;
  FrameBuffer image_;
  Status state_ = Done{};
};

/// Mean width of a letter over its height, of the font of draw_text.
constexpr double kLetterWidth = 0.6;

void Panel::text(double x, double baseline, const std::string& words, Align align) {
  if (!state_ || words.empty()) return;
  const double width = kLetterWidth * kText * double(words.size());
  const double from = x - (align == Align::left ? 0 : align == Align::middle ? width / 2 : width);
  state_ = io_.draw_text(image_, std::max(2, int(std::lround(from))), int(std::lround(baseline)),
                         kText, words);
}

void Panel::draw_errors(const std::vector<float>& errors, int width, int height,
                        bool display_referred) {
  const std::vector<float> small =
      layout_.shrunk == 1 ? errors : shrunk_by_largest(errors, width, height, layout_.shrunk);
  const int columns = layout_.width / layout_.magnified;
  parallel_for_ranges(size_t(layout_.height), 64, [&](size_t begin, size_t end) {
    for (size_t y = begin; y < end; ++y)
      for (int x = 0; x < layout_.width; ++x) {
        const size_t row = y / size_t(layout_.magnified);
        const float error = small[row * size_t(columns) + size_t(x / layout_.magnified)];
        set(image_, kLeft + x, kTop + int(y), colour_of(error, display_referred));
      }
  });
}

/// As many letters as surely fit.
std::string cut(const std::string& words, int width) {
  const auto fit = size_t(std::max(8.0, width / (kLetterWidth * kText)));
  if (words.size() <= fit) return words;
  size_t end = fit - 3;
  while (end > 0 && (uint8_t(words[end]) & 0xc0) == 0x80) --end;  // not within a letter of UTF-8
  return words.substr(0, end) + "...";
}

void Panel::draw_title(const PairResult& pair) {
  const int width = image_.width() - 16;
  text(8, kLine - 4, cut(one_line(pair.name), width));
  text(8, 2 * kLine - 4,
       cut(fmt::format("{}: {}", name_of(pair.verdict), one_line(summary_text(pair))), width));
}

void Panel::draw_scale(bool display_referred) {
  const Scale& scale = scale_of(display_referred);
  const int y = kTop + layout_.height + 12, height = 12;
  const int left = kLeft + 84, width = std::min(520, image_.width() - left - kRight - 20);
  for (int x = 0; x < width; ++x) {
    const double error = scale.from * std::pow(scale.to / scale.from, (x + 0.5) / width);
    fill(image_, left + x, y, 1, height, colour_of(float(error), display_referred));
  }
  for (const double mark : scale.marks) {
    const double x = left + width * place_on_scale(float(mark), display_referred);
    fill(image_, int(x), y + height, 1, 4, kInk);
    text(x, y + height + 16,
         display_referred ? fmt::format("{:g}", mark)
                          : fmt::format("{:g} {}", 100 * mark, scale.unit),
         Align::middle);
  }
  fill(image_, 8, y, 14, height, kEqual);
  frame(image_, 8, y, 14, height, kInk);
  text(26, y + height - 1, "equal");
  fill(image_, 8, y + height + 6, 14, height, kNoNumber);
  text(26, y + 2 * height + 4, "NaN, Inf");
  text(left + width / 2.0, y + height + 32, scale.title, Align::middle);
}

void Panel::draw_worst(const std::vector<float>& errors, int width) {
  const auto [least, worst] = std::minmax_element(errors.begin(), errors.end());
  if (errors.size() > 1 && *least == *worst) return;  // no place is worse than others
  const auto place = int64_t(worst - errors.begin());
  const double x = double(place % width), y = double(place / width);
  const int size = std::max(1, layout_.magnified / layout_.shrunk), gap = 5;
  frame(image_, int(layout_.x(x)) - gap, int(layout_.y(y)) - gap, size + 2 * gap, size + 2 * gap,
        kWorst);
}

struct NamedAzimuth {
  const char* name;
  double azimuth_deg;
};
constexpr NamedAzimuth kCompass[] = {{"N", 0},   {"NE", 45},  {"E", 90},  {"SE", 135},
                                     {"S", 180}, {"SW", 225}, {"W", 270}, {"NW", 315}};

void Panel::draw_lat_long(const image::Camera& camera) {
  for (const auto& [name, azimuth_deg] : kCompass) {
    const auto at = image::position_of(camera, enu_direction(azimuth_deg * deg, Angle{}));
    if (!at) continue;
    fill(image_, int(layout_.x(at->x)), kTop - 5, 1, 4, kInk);
    text(layout_.x(at->x), kTop - 9, name, Align::middle);
  }
  const auto middle = image::direction_at(camera, {camera.width / 2.0, camera.height / 2.0});
  for (const int elevation_deg : {90, 60, 30, 0, -30, -60, -90}) {
    // Just inside the poles, where the camera's heading still says where to look.
    const double inside = std::clamp(double(elevation_deg), -89.999, 89.999);
    const auto at = image::position_of(camera, enu_direction(azimuth(*middle), inside * deg));
    if (!at) continue;
    fill(image_, kLeft - 5, int(std::lround(layout_.y(at->y))), 4, 1, kInk);
    text(kLeft - 8, layout_.y(at->y) + kText / 3.0, fmt::format("{}", elevation_deg), Align::right);
  }
}

void Panel::draw_compass(const image::Camera& camera) {
  for (const auto& [name, azimuth_deg] : kCompass) {
    const auto at = image::position_of(camera, enu_direction(azimuth_deg * deg, Angle{}));
    if (!at) continue;
    const int letters = int(std::string_view(name).size());
    // Within the panel where the horizon is its rim.
    const double x = std::clamp(layout_.x(at->x), kLeft + 12.0, kLeft + layout_.width - 12.0);
    const double y = std::clamp(layout_.y(at->y), kTop + 10.0, kTop + layout_.height - 10.0);
    fill(image_, int(x) - 5 * letters - 2, int(y) - 8, 10 * letters + 4, 16, kBackground);
    text(x, y + kText / 3.0 + 1, name, Align::middle);
  }
}

void Panel::draw_sky(const image::SkyView& view) {
  if (!view.camera) return;
  if (view.camera->projection == image::Projection::lat_long)
    draw_lat_long(*view.camera);
  else
    draw_compass(*view.camera);
  if (!view.sun) return;
  const auto at = image::position_of(*view.camera, *view.sun);
  if (!at) return;
  const double radius = 8 + 2.0 * layout_.magnified;
  ring(image_, layout_.x(at->x), layout_.y(at->y), radius, kInk);
}

}  // namespace

double place_on_scale(float error, bool display_referred) {
  const Scale& scale = scale_of(display_referred);
  const double place = std::log(double(error) / scale.from) / std::log(scale.to / scale.from);
  return std::clamp(place, 0.0, 1.0);
}

Result<FrameBuffer> heat_map_panel(const output::ImageIo& io, const PairResult& pair,
                                   const PairEvidence& evidence, const std::vector<float>& errors) {
  const image::Picture& a = evidence.a;
  Panel panel(io, layout_of(a.width, a.height));
  panel.draw_errors(errors, a.width, a.height, a.display_referred);
  panel.draw_title(pair);
  panel.draw_scale(a.display_referred);
  panel.draw_sky(pair.view);
  panel.draw_worst(errors, a.width);
  return panel.finish();
}

}  // namespace skylapse::diff
