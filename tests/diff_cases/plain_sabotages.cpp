// Broken pictures, made of the sketches in frames.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "diff_cases/case_list.h"
#include "diff_cases/frames.h"

namespace skylapse::diff_cases {
namespace {

constexpr int kStarColumn = 228;
constexpr int kStarRow = 26;
constexpr uint32_t kSeed = 99;

Image gained(const Image& image, float r, float g, float b) {
  const std::array<float, 3> gain{r, g, b};
  return changed(image, [&](int, int, int c, float v) { return v * gain[size_t(c)]; });
}

/// All three samples of one pixel.
Image one_pixel(Image image, int x, int y, std::array<float, 3> rgb) {
  for (int c = 0; c < 3; ++c) image.at(x, y, c) = rgb[size_t(c)];
  return image;
}

void add_brightness(CaseList& list) {
  const Image& day = list.frame("day");
  list.sabotage("S01", "day", "whole frame 2 % brighter", gained(day, 1.02F, 1.02F, 1.02F));
  list.sabotage("S02", "day", "blue 3 % low", gained(day, 1, 1, 0.97F));
  list.sabotage("S03", "day", "exposure off by a tenth of a stop",
                gained(day, 1.0718F, 1.0718F, 1.0718F));
  list.sabotage("S18", "day", "sky banded to steps of 1/32",
                changed(day, [](int, int, int, float v) { return std::floor(v * 32) / 32; }));
  const Noise noise(256, 128, kSeed);
  list.sabotage("S23", "day", "noise of +-2 % in every sample",
                changed(day, [&](int x, int y, int c, float v) {
                  return double(v) * (1 + 0.04 * (noise(x, y, c) - 0.5));
                }));
  list.sabotage("S24", "day", "checker of single pixels, +-1 %",
                changed(day, [](int x, int y, int, float v) {
                  return double(v) * (1 + 0.01 * ((x + y) % 2 * 2 - 1));
                }));
  list.sabotage(
      "S25", "day", "sRGB curve baked into linear data", changed(day, [](int, int, int, float v) {
        return v <= 0.0031308F ? 12.92F * v : 1.055F * std::pow(v, float(1 / 2.4)) - 0.055F;
      }));
  list.sabotage("S27", "day", "brightness tilted by +-3 % from left to right",
                changed(day, [](int x, int, int, float v) {
                  return double(v) * (1 + 0.06 * (x / 255.0 - 0.5));
                }));
  list.sabotage("S28", "day", "2 % of green leaks into red",
                changed(day, [&](int x, int y, int c, float v) {
                  return c == 0 ? v + 0.02F * day.at(x, y, 1) : v;
                }));
}

void add_odd_samples(CaseList& list) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Image& day = list.frame("day");
  Image one_nan = day;
  one_nan.at(200, 100, 1) = kNan;
  list.sabotage("S04", "day", "one NaN sample", one_nan);
  list.sabotage("S05", "day", "red is NaN everywhere",
                changed(day, [](int, int, int c, float v) { return c == 0 ? kNan : v; }));
  list.sabotage("S06", "day", "one pixel of the disc is infinite",
                one_pixel(day, kSunColumn, kSunRow, {kInfinity, kInfinity, kInfinity}));
  list.sabotage("S07", "day", "one negative pixel", one_pixel(day, 60, 60, {-1, -1, -1}));
  FileOptions half;
  half.type = "half";
  list.sabotage("S26", "bright", "disc above 65504 stored as half: infinite", list.frame("bright"),
                half);
}

void add_sun(CaseList& list) {
  const Image& day = list.frame("day");
  const float peak = *std::max_element(day.samples.begin(), day.samples.end());
  const auto is_disc = [](float v) { return v > 100; };
  list.sabotage("S08", "day", "sun clamped to half its peak",
                changed(day, [&](int, int, int, float v) { return std::min(v, peak / 2); }));
  list.sabotage("S09", "day", "sun's disc gone, aureole kept",
                changed(day, [](int, int, int c, float v) {
                  return std::min(double(v), std::array{6.5, 5.6, 4.9}[size_t(c)]);
                }));
  list.sabotage("S10", "day", "sun's disc moved by one pixel",
                changed(day, [&](int x, int y, int c, float v) {
                  const float here = is_disc(v) ? 6.0F : v;
                  const float left = day.at((x + 255) % 256, y, c);
                  return here + (is_disc(left) ? left : 0.0F);
                }));
  std::array<float, 3> brightest{};
  for (size_t i = 0; i < day.samples.size(); ++i)
    brightest[i % 3] = std::max(brightest[i % 3], day.samples[i]);
  list.sabotage("S11", "day", "sun's disc half a pixel larger in radius",
                changed(day, [&](int x, int y, int c, float v) {
                  return sun_distance_squared(x, y) <= 12 ? brightest[size_t(c)] : v;
                }));
}

void add_places(CaseList& list) {
  using Pixel = std::pair<int, int>;
  const Image& day = list.frame("day");
  list.sabotage("S12", "day", "azimuth off by one pixel", moved(day, [](int x, int y) {
                  return Pixel{x - 1, y};
                }));
  list.sabotage("S13", "day", "east and west exchanged", moved(day, [](int x, int y) {
                  return Pixel{255 - x, y};
                }));
  list.sabotage("S14", "day", "upside down", moved(day, [](int x, int y) {
                  return Pixel{x, 127 - y};
                }));
  list.sabotage("S15", "day", "red and blue exchanged",
                changed(day, [&](int x, int y, int c, float) { return day.at(x, y, 2 - c); }));
  list.sabotage("S16", "day", "black seam at the first column",
                changed(day, [](int x, int, int, float v) { return x == 0 ? 0.0F : v; }));
  list.sabotage("S17", "day", "one row doubled, all below it one row low",
                moved(day, [](int x, int y) {
                  return Pixel{x, y >= 65 ? y - 1 : y};
                }));
  list.sabotage("S19", "day", "horizon one row too low", moved(day, [](int x, int y) {
                  return Pixel{x, y == kGroundRow ? y - 1 : y};
                }));
  const auto within = [](int v, int from, int size) { return v >= from && v < from + size; };
  list.sabotage("S20", "day", "one tile of 16x16 black",
                changed(day, [&](int x, int y, int, float v) {
                  return within(y, 32, 16) && within(x, 64, 16) ? 0.0F : v;
                }));
  list.sabotage("S21", "day", "two tiles of 16x16 exchanged", moved(day, [&](int x, int y) {
                  if (!within(x, 64, 16)) return Pixel{x, y};
                  return Pixel{x, within(y, 64, 16) ? y + 16 : within(y, 80, 16) ? y - 16 : y};
                }));
  list.sabotage("S22", "day", "whole frame blurred", blurred(day, 3));
}

void add_night(CaseList& list) {
  const Image& night = list.frame("night");
  list.sabotage("S29", "night", "one star missing", moved(night, [](int x, int y) {
                  return std::pair{x == kStarColumn && y == kStarRow ? x + 1 : x, y};
                }));
  list.sabotage("S30", "night", "one star fainter by half a magnitude",
                changed(night, [](int x, int y, int, float v) {
                  return x == kStarColumn && y == kStarRow ? 0.63F * v : v;
                }));
  list.sabotage("S31", "night", "stars moved by half a pixel",
                changed(night, [&](int x, int y, int c, float v) {
                  return 0.5F * (v + night.at((x + 255) % 256, y, c));
                }));
  list.sabotage("S32", "night", "faint background lost",
                changed(night, [](int, int, int, float v) { return v < 0.001F ? 0.0F : v; }));
  list.sabotage("S33", "night", "night frame black", Image(256, 128));
}

void add_display(CaseList& list) {
  const Image& png = list.frame("png");
  list.sabotage("S34", "png", "three code values too bright",
                changed(png, [](int, int, int, float v) { return std::min(v + 3, 255.0F); }));
  const Noise noise(256, 128, kSeed);
  list.sabotage("S35", "png", "0.2 % of the pixels burnt white",
                changed(png, [&](int x, int y, int, float v) {
                  return noise(x, y, 0) < 0.002 ? 255.0F : v;
                }));
}

void add_shape(CaseList& list) {
  const Image& day = list.frame("day");
  list.sabotage("S36", "day", "one row short", cropped(day, 0, 0, 256, 127));
  Image with_alpha = day;
  with_alpha.channels = {"R", "G", "B", "A"};
  with_alpha.samples.resize(size_t(256) * 128 * 4);
  with_alpha = changed(with_alpha,
                       [&](int x, int y, int c, float) { return c == 3 ? 0.5F : day.at(x, y, c); });
  list.sabotage("S37", "day", "an alpha channel has appeared", with_alpha);
}

void add_sequences(CaseList& list) {
  namespace fs = std::filesystem;
  const auto copy = [&](const std::string& id) {
    fs::remove_all(list.path(id));
    fs::copy(list.path("frames/seq"), list.path(id), fs::copy_options::recursive);
    return list.path(id);
  };
  const fs::path exchanged = copy("S38");
  fs::rename(exchanged / "f.0003.exr", exchanged / "t");
  fs::rename(exchanged / "f.0004.exr", exchanged / "f.0003.exr");
  fs::rename(exchanged / "t", exchanged / "f.0004.exr");
  list.add({"S38", true, "seq", "two frames exchanged", "frames/seq", "S38"});
  fs::remove(copy("S39") / "f.0005.exr");
  list.add({"S39", true, "seq", "one frame missing", "frames/seq", "S39"});
  const fs::path repeated = copy("S40");
  fs::copy_file(repeated / "f.0005.exr", repeated / "f.0006.exr",
                fs::copy_options::overwrite_existing);
  list.add({"S40", true, "seq", "one frame repeated", "frames/seq", "S40"});
}

}  // namespace

void add_plain_sabotages(CaseList& list) {
  add_brightness(list);
  add_odd_samples(list);
  add_sun(list);
  add_places(list);
  add_night(list);
  add_display(list);
  add_shape(list);
  add_sequences(list);
}

}  // namespace skylapse::diff_cases
