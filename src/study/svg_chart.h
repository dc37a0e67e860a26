#pragma once
// What the figures of a study are drawn with: an SVG document in text, axes in decades, labels that
// keep out of each other's way.
#include <string>
#include <utility>
#include <vector>

namespace skylapse::study {

/// "120 ms", "3.4 s", "2 min".
std::string time_text(double ms);
/// "0.35 %", "12 %".
std::string percent_text(double share);

/// A logarithmic axis onto pixels; `low` < `high`, both positive, are reached at `at_low` and
/// `at_high`. Values outside are put on the end that they lie beyond.
struct LogAxis {
  double low = 1, high = 10, at_low = 0, at_high = 100;
  [[nodiscard]] double operator()(double value) const;
  /// 1, 2, 5 of each decade, or powers of ten alone where there are more than three decades.
  [[nodiscard]] std::vector<double> ticks() const;
};

/// An axis that holds all values, rounded out to 1, 2 or 5 of a decade.
LogAxis axis_for(const std::vector<double>& values, double at_low, double at_high);

struct Box {
  double x = 0, y = 0, width = 0, height = 0;
  [[nodiscard]] bool meets(const Box& o) const {
    return x < o.x + o.width && o.x < x + width && y < o.y + o.height && o.y < y + height;
  }
};

/// Puts labels beside points so that no label covers another one, a point, or leaves the frame;
/// a label that finds no place is left out.
class LabelPlacer {
 public:
  explicit LabelPlacer(const Box& frame) : frame_(frame) {}
  /// What labels must not cover.
  void block(const Box& box) { taken_.push_back(box); }
  struct Place {
    double x, y;  // of the text's baseline, at its left end
    bool leader;  // further off: a line leads to it
    bool found = true;
  };
  Place place(double x, double y, const std::string& text, double font_size);

 private:
  Box frame_;
  std::vector<Box> taken_;
};

/// Width of a text in a sans-serif font: never less than what browsers draw.
double text_width(const std::string& text, double font_size);

/// A document in the making. Colours are classes, light and dark follow the reader's system, and
/// also stand alone as a file.
class Svg {
 public:
  Svg(double width, double height, const std::string& title, const std::string& description);
  void line(double x1, double y1, double x2, double y2, const std::string& css);
  void path(const std::string& d, const std::string& css);
  void rect(const Box& box, const std::string& css);
  void text(double x, double y, const std::string& text, const std::string& css,
            const std::string& attributes = "");
  void raw(const std::string& markup) { body_ += markup; }
  [[nodiscard]] std::string document() const;

 private:
  double width_, height_;
  std::string title_, description_, body_;
};

/// One of eight shapes, 5 px about a place, in the colour of its number: they can be told apart
/// without the colour. Colours: Okabe & Ito 2008, "Color Universal Design".
std::string marker(int number, double x, double y);

}  // namespace skylapse::study
