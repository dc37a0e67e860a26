// The same kinds of damage on every frame: what is wrong with a picture does not depend on what it
// shows. Amounts are those that must be caught, and larger ones.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "diff_cases/case_list.h"
#include "diff_cases/frames.h"

namespace skylapse::diff_cases {
namespace {

struct Damage {
  std::string id, what;
  std::function<Image(const Image&)> apply;
};

using Pixel = std::pair<int, int>;

Damage gain(const std::string& id, const std::string& what, std::array<double, 3> by) {
  return {id, what, [by](const Image& a) {
            return changed(a,
                           [&](int, int, int c, float v) { return c < 3 ? v * by[size_t(c)] : v; });
          }};
}

/// Rows and columns from (x, y) on, as shares of the picture, `size` pixels each way.
bool in_tile(const Image& a, int x, int y, double at_x, double at_y, int size) {
  const int left = int(at_x * a.width);
  const int top = int(at_y * a.height);
  return x >= left && x < left + size && y >= top && y < top + size;
}

Damage tile(const std::string& id, const std::string& what, int size, double by) {
  return {id, what, [=](const Image& a) {
            return changed(a, [&](int x, int y, int, float v) {
              return in_tile(a, x, y, 0.25, 0.2, size) ? v * by : double(v);
            });
          }};
}

Damage one_sample(const std::string& id, const std::string& what, double at_x, double at_y,
                  std::function<float(float)> change) {
  return {id, what, [=](const Image& a) {
            Image b = a;
            float& sample = b.at(int(at_x * a.width), int(at_y * a.height), 1);
            sample = change(sample);
            return b;
          }};
}

double mean_of(const Image& a) {
  // The disc does not count: the mean of what is below 50 times the median.
  std::vector<float> sorted = a.samples;
  std::sort(sorted.begin(), sorted.end());
  const float median = sorted[sorted.size() / 2];
  double sum = 0;
  size_t count = 0;
  for (const float v : sorted)
    if (v <= 50 * median) {
      sum += v;
      ++count;
    }
  return sum / double(count);
}

/// As if stored in linear integers whose white is four times the mean, as a photograph's is.
Damage banding(const std::string& id, const std::string& what, double steps) {
  return {id, what, [=](const Image& a) {
            const double step = 4 * mean_of(a) / steps;
            return changed(a, [&](int, int, int, float v) { return std::floor(v / step) * step; });
          }};
}

Image mixed(const Image& a, const Image& b, double share) {
  return changed(a, [&](int x, int y, int c, float v) {
    return double(v) + share * (double(b.at(x, y, c)) - double(v));
  });
}

std::vector<Damage> damages_of_light() {
  return {
      gain("gain+0.5%", "half a percent brighter", {1.005, 1.005, 1.005}),
      gain("gain-1%", "1 % darker", {0.99, 0.99, 0.99}),
      gain("gain-2%", "2 % darker", {0.98, 0.98, 0.98}),
      gain("exposure+0.05", "exposure off by 0.05 EV", {1.03526, 1.03526, 1.03526}),
      gain("exposure-0.05", "exposure off by -0.05 EV", {0.96594, 0.96594, 0.96594}),
      gain("red+1%", "hue off: red 1 % high", {1.01, 1, 1}),
      gain("blue-1%", "hue off: blue 1 % low", {1, 1, 0.99}),
      gain("green+1%", "hue off: green 1 % high", {1, 1.01, 1}),
      banding("banding64", "banded as by 6 bits", 64),
      banding("banding256", "banded as by 8 bits", 256),
      banding("banding1024", "banded as by 10 bits", 1024),
      {"power", "a power of 1.02 left in the data",
       [](const Image& a) {
         return changed(a, [](int, int, int, float v) {
           return v > 0 ? std::pow(double(v), 1.02) : double(v);
         });
       }},
      {"vignette", "corners 3 % darker",
       [](const Image& a) {
         return changed(a, [&](int x, int y, int, float v) {
           const double u = 2 * (x + 0.5) / a.width - 1;
           const double w = 2 * (y + 0.5) / a.height - 1;
           return v * (1 - 0.015 * (u * u + w * w));
         });
       }},
      {"noise1%", "noise of +-1 % in every sample",
       [](const Image& a) {
         const Noise noise(a.width, a.height, 7);
         return changed(a, [&](int x, int y, int c, float v) {
           return v * (1 + 0.02 * (noise(x, y, c) - 0.5));
         });
       }},
  };
}

std::vector<Damage> damages_of_places() {
  return {
      {"mirrored", "east and west exchanged",
       [](const Image& a) {
         return moved(a, [&](int x, int y) { return Pixel{a.width - 1 - x, y}; });
       }},
      {"shift1", "one pixel to the right",
       [](const Image& a) { return moved(a, [](int x, int y) {
                              return Pixel{x - 1, y};
                            }); }},
      {"shift-half", "resampled half a pixel to the right",
       [](const Image& a) {
         return mixed(a, moved(a, [](int x, int y) { return Pixel{x - 1, y}; }), 0.5);
       }},
      {"down1", "one pixel down",
       [](const Image& a) { return moved(a, [](int x, int y) {
                              return Pixel{x, y - 1};
                            }); }},
      {"nearest", "shrunk to half the size and blown up again",
       [](const Image& a) {
         return moved(a, [](int x, int y) { return Pixel{x / 2 * 2, y / 2 * 2}; });
       }},
      {"row+1%", "one row 1 % high",
       [](const Image& a) {
         return changed(a, [&](int, int y, int, float v) {
           return v * (y == int(0.45 * a.height) ? 1.01 : 1.0);
         });
       }},
      {"column-1%", "one column 1 % low",
       [](const Image& a) {
         return changed(a, [&](int x, int, int, float v) {
           return v * (x == int(0.45 * a.width) ? 0.99 : 1.0);
         });
       }},
      tile("tile+1%", "one tile of 8x8 1 % high", 8, 1.01),
      tile("tile-black", "one tile of 16x16 black", 16, 0),
      {"tiles-swapped", "two tiles of 16x16 exchanged",
       [](const Image& a) {
         const int apart = a.height / 4;
         return moved(a, [&](int x, int y) {
           if (in_tile(a, x, y, 0.25, 0.15, 16)) return Pixel{x, y + apart};
           if (in_tile(a, x, y - apart, 0.25, 0.15, 16)) return Pixel{x, y - apart};
           return Pixel{x, y};
         });
       }},
  };
}

/// Rings beside edges: of pictures that have some.
std::vector<Damage> damages_of_edges() {
  return {
      {"sharpened", "sharpened, which rings beside edges",
       [](const Image& a) { return mixed(a, blurred(a, 3), -0.5); }},
  };
}

std::vector<Damage> damages_of_samples() {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  return {
      one_sample("nan", "NaN in one channel of one pixel", 0.5, 0.3, [](float) { return kNan; }),
      one_sample("inf", "one sample infinite", 0.3, 0.4, [](float) { return kInfinity; }),
      one_sample("-inf", "one sample infinitely dark", 0.6, 0.4, [](float) { return -kInfinity; }),
      one_sample("negative", "one sample with the sign lost", 0.4, 0.4, [](float v) { return -v; }),
      one_sample("pixel+5%", "one sample 5 % high", 0.4, 0.35, [](float v) { return v * 1.05F; }),
      one_sample("pixel-black", "one sample black", 0.45, 0.3, [](float) { return 0.0F; }),
  };
}

void apply(CaseList& list, const std::string& frame, const std::vector<Damage>& damages) {
  FileOptions quick;
  quick.compression = "none";
  for (const Damage& d : damages)
    list.sabotage(frame + "." + d.id, frame, d.what, d.apply(list.frame(frame)), quick);
}

/// Only frames whose sun's disc is in the picture.
void add_sun(CaseList& list, const std::string& frame) {
  const Image& a = list.frame(frame);
  const float peak = *std::max_element(a.samples.begin(), a.samples.end());
  const auto clamped = [&](const std::string& id, const std::string& what, double at) {
    list.sabotage(frame + "." + id, frame, what,
                  changed(a, [&](int, int, int, float v) { return std::min(double(v), at); }));
  };
  clamped("sun-half", "sun clamped to half its peak", peak / 2.0);
  clamped("sun-90%", "sun clamped to 90 % of its peak", 0.9 * peak);
  constexpr float kLargestHalf = 65504;
  if (peak > kLargestHalf) {
    clamped("sun-65504", "sun clamped to the largest half float", kLargestHalf);
    FileOptions half;
    half.type = "half";
    list.sabotage(frame + ".half-inf", frame, "half for float: the disc is infinite", a, half);
  }
}

/// Pixels of the night sketch with a star, brightest first.
std::vector<Pixel> stars_of(const Image& night) {
  constexpr float kFaintestStar = 0.05F;
  std::vector<Pixel> stars;
  for (int y = 0; y < kGroundRow; ++y)
    for (int x = 0; x < night.width; ++x)
      if (night.at(x, y, 0) > kFaintestStar) stars.emplace_back(x, y);
  std::sort(stars.begin(), stars.end(), [&](const Pixel& p, const Pixel& q) {
    return night.at(p.first, p.second, 0) > night.at(q.first, q.second, 0);
  });
  return stars;
}

void add_night(CaseList& list) {
  const Image& night = list.frame("night");
  const std::vector<Pixel> stars = stars_of(night);
  const auto star = [&](const std::string& id, const std::string& what, Pixel at, double by) {
    list.sabotage(id, "night", what, changed(night, [&](int x, int y, int, float v) {
                    return Pixel{x, y} == at ? v * by : double(v);
                  }));
  };
  star("night.star-10%", "one star a tenth fainter", stars.front(), 0.9);
  star("night.star-5%", "one of the fainter stars by a twentieth", stars.back(), 0.95);
  const auto [sx, sy] = stars[stars.size() / 2];
  list.sabotage("night.planet-moved", "night", "one star moved by a pixel",
                moved(night, [sx = sx, sy = sy](int x, int y) {
                  if (y != sy || (x != sx && x != sx + 1)) return Pixel{x, y};
                  return Pixel{x == sx ? sx + 1 : sx, y};
                }));
  list.sabotage("night.half-pixel", "night", "stars blurred", blurred(night, 3));
  list.sabotage("night.background+1%", "night", "faint background 1 % high",
                changed(night, [](int, int, int, float v) { return v < 0.001F ? v * 1.01 : v; }));
  // A moonless night in units of 683 cd/m^2: half floats have few digits left there.
  list.add_frame("faint", changed(night, [](int, int, int, float v) { return v * 1e-3; }));
  FileOptions half;
  half.type = "half";
  list.sabotage("faint.half", "faint", "half for float of a moonless night", list.frame("faint"),
                half);
}

void add_faces(CaseList& list) {
  const Image& cube = list.frame("cube");
  const int edge = cube.width;
  const auto faces = [&](const std::string& id, const std::string& what, auto source) {
    list.sabotage("cube." + id, "cube", what,
                  moved(cube, [&](int x, int y) { return source(y / edge, x, y % edge); }));
  };
  faces("faces-swapped", "east and west exchanged", [&](int f, int x, int y) {
    return Pixel{x, (f < 2 ? 1 - f : f) * edge + y};
  });
  faces("face-turned", "the top face turned by a quarter", [&](int f, int x, int y) {
    return f == 2 ? Pixel{y, f * edge + edge - 1 - x} : Pixel{x, f * edge + y};
  });
  faces("face-upside-down", "one face upside down", [&](int f, int x, int y) {
    return Pixel{x, f * edge + (f == 5 ? edge - 1 - y : y)};
  });
}

void add_channels(CaseList& list) {
  const Image& day = list.frame("day");
  Image with_alpha(256, 128);
  with_alpha.channels = {"R", "G", "B", "A"};
  with_alpha.samples.resize(size_t(256) * 128 * 4);
  with_alpha = changed(with_alpha,
                       [&](int x, int y, int c, float) { return c == 3 ? 1.0F : day.at(x, y, c); });
  list.add_frame("alpha", with_alpha);
  list.sabotage("alpha.missing", "alpha", "the alpha channel is missing", day);
  list.sabotage("alpha.pixel", "alpha", "one pixel half transparent",
                changed(with_alpha, [](int x, int y, int c, float v) {
                  return x == 30 && y == 90 && c == 3 ? 0.5F : v;
                }));
  Image grey(256, 128);
  grey.channels = {"Y"};
  grey.samples.resize(size_t(256) * 128);
  list.sabotage("day.grey", "day", "colours became one channel",
                changed(grey, [&](int x, int y, int, float) { return day.at(x, y, 1); }));
}

void add_display(CaseList& list) {
  const Image& a = list.frame("screen");
  const auto spoilt = [&](const std::string& id, const std::string& what, auto change) {
    Image b = changed(a, [&](int x, int y, int c, float v) {
      return std::clamp(std::floor(change(x, y, c, v) + 0.5), 0.0, 255.0);
    });
    list.sabotage("screen." + id, "screen", what, b);
  };
  spoilt("code+1", "every code value one too high", [](int, int, int, float v) { return v + 1.0; });
  spoilt("red+2", "red two code values high",
         [](int, int, int c, float v) { return v + (c == 0 ? 2.0 : 0.0); });
  spoilt("gain+2%", "code values 2 % high", [](int, int, int, float v) { return v * 1.02; });
  spoilt("gamma", "gamma of 2.2 for 2.4",
         [](int, int, int, float v) { return 255 * std::pow(v / 255.0, 2.2 / 2.4); });
  spoilt("6-bits", "banded to 6 bits",
         [](int, int, int, float v) { return std::floor(v / 4) * 4; });
  spoilt("contrast", "full range squeezed to 16..235",
         [](int, int, int, float v) { return 16 + v * 219 / 255; });
  spoilt("tile", "one tile of 8x8 four code values high", [&](int x, int y, int, float v) {
    return v + (in_tile(a, x, y, 0.4, 0.3, 8) ? 4.0 : 0.0);
  });
  spoilt("seam", "one column two code values low",
         [&](int x, int, int, float v) { return v - (x == a.width / 3 ? 2.0 : 0.0); });
  spoilt("noise", "grain of +-4 code values",
         [&, noise = Noise(a.width, a.height, 5)](int x, int y, int c, float v) {
           return v + 8 * (noise(x, y, c) - 0.5);
         });
  list.sabotage("screen.mirrored", "screen", "east and west exchanged", moved(a, [&](int x, int y) {
                  return Pixel{a.width - 1 - x, y};
                }));
  list.sabotage("screen.shift1", "screen", "one pixel to the right", moved(a, [](int x, int y) {
                  return Pixel{x - 1, y};
                }));
  list.sabotage("screen.bgr", "screen", "red and blue exchanged",
                changed(a, [&](int x, int y, int c, float) { return a.at(x, y, 2 - c); }));
  // The upper bytes of 16 bits that held more than 8: half a code value is lost on the mean.
  Image fine = changed(
      a, [](int x, int, int, float v) { return std::min(v * 257 + float(x % 257), 65535.0F); });
  fine.bits = 16;
  list.add_frame("fine", fine);
  Image coarse = changed(fine, [](int, int, int, float v) { return std::floor(v / 257); });
  coarse.bits = 8;
  list.sabotage("fine.cut", "fine", "16 bits cut down to 8", coarse);
}

}  // namespace

void add_damages(CaseList& list) {
  for (const std::string frame :
       {"day", "noon", "evening", "twilight", "fisheye", "view", "cube"}) {
    apply(list, frame, damages_of_light());
    apply(list, frame, damages_of_places());
    apply(list, frame, damages_of_samples());
    if (frame != "view") apply(list, frame, damages_of_edges());
  }
  for (const char* const frame : {"noon", "evening", "small"}) add_sun(list, frame);
  add_night(list);
  add_faces(list);
  add_channels(list);
  add_display(list);
}

}  // namespace skylapse::diff_cases
