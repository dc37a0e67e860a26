#include "image/diff/flip_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace skylapse::image {
namespace {

constexpr double kPi = std::numbers::pi;

using Colour = std::array<double, 3>;

/// Where and how large; noise is drawn R, G, B for each pixel, row by row, in [0, 1).
struct Pixel {
  double x, y, u, v;
  Colour noise;
};

struct Colours {
  Colour reference, test;
};

using Formula = std::function<Colours(const Pixel&)>;

double sq(double a) { return a * a; }

double gauss(const Pixel& p, double cx, double cy, double s) {
  return std::exp(-((p.x - cx) * (p.x - cx) + (p.y - cy) * (p.y - cy)) / (2 * s * s));
}

Colours checker(const Pixel& p) {
  const auto at = [&](double x) {
    const double c = std::fmod(std::floor(x / 8) + std::floor(p.y / 8), 2);
    return Colour{0.21 + 0.6 * c, 0.41 + 0.35 * c, 0.72 - 0.11 * c};
  };
  return {at(p.x), at(p.x + 1)};
}

Colours blobs(const Pixel& p) {
  const auto with = [&](double red, double blue) {
    return Colour{0.11 + 0.8 * gauss(p, 40, 30, red), 0.16 + 0.7 * gauss(p, 84, 60, 14),
                  0.21 + 0.6 * gauss(p, 64, 48, blue)};
  };
  return {with(9, 20), with(10, 18)};
}

Colours noisy_waves(const Pixel& p) {
  const Colour waves{0.502 + 0.4 * std::sin(2 * kPi * p.x / 16),
                     0.502 + 0.3 * std::sin(2 * kPi * p.y / 11),
                     0.502 + 0.25 * std::sin(2 * kPi * (p.x + p.y) / 23)};
  Colour noisy{};
  for (size_t i = 0; i < 3; ++i) noisy[i] = waves[i] + 0.1 * (p.noise[i] - 0.5);
  return {waves, noisy};
}

Colours zone_plate(const Pixel& p) {
  const double c = std::cos(kPi * (sq(p.x - 50) + sq(p.y - 38)) / 160);
  return {{0.503 + 0.45 * c, 0.503 + 0.40 * c, 0.503 + 0.35 * c},
          {0.503 + 0.38 * c, 0.503 + 0.34 * c, 0.503 + 0.30 * c}};
}

Colours display_stars(const Pixel& p) {
  const auto with = [&](double s) {
    return Colour{0.03 + 0.97 * s, 0.04 + 0.91 * s, 0.08 + 0.83 * s};
  };
  const double s = std::fmod(p.x, 20) == 10 && std::fmod(p.y, 20) == 10 ? 1 : 0;
  return {with(s), with(p.x == 50 && p.y == 30 ? 0 : s)};
}

Colours disc_sky(const Pixel& p, double ground_gain, double disc_gain) {
  const double d = sq(p.x - 90) + sq(p.y - 20), k = d <= 9 ? 5000 : 0;
  const double a = 0.20 + 0.50 * p.v * p.v + 6 / (1 + d / 40);
  const double b = 0.35 + 0.45 * p.v * p.v + 5 / (1 + d / 40);
  const double c = 0.80 + 0.20 * p.v * p.v + 4 / (1 + d / 40);
  const double g = p.y >= 32 ? ground_gain : 1;
  const double red = disc_gain, green = 0.95 * disc_gain, blue = 0.85 * disc_gain;
  return {{a + k, b + 0.95 * k, c + 0.85 * k},
          {g * (a + red * k), g * (b + green * k), g * (c + blue * k)}};
}

Colours noisy_sky(const Pixel& p) {
  const double d = sq(p.x - 170) + sq(p.y - 50), k = d <= 16 ? 20000 : 0;
  const double v3 = p.v * p.v * p.v;
  const Colour sky{0.3 + 0.9 * v3 + 8 / (1 + d / 90) + k,
                   0.5 + 0.7 * v3 + 7 / (1 + d / 90) + 0.9 * k,
                   1.1 + 0.3 * v3 + 6 / (1 + d / 90) + 0.8 * k};
  Colour noisy{};
  for (size_t i = 0; i < 3; ++i) noisy[i] = sky[i] * (1 + 0.2 * (p.noise[i] - 0.5));
  return {sky, noisy};
}

Colours warmer_ramp(const Pixel& p) {
  const double e = std::exp(6 * p.u - 3);
  return {{e * (0.6 + 0.4 * p.v), e * 0.8, e * (1.0 - 0.4 * p.v)},
          {e * (0.6 + 0.4 * p.v) * 1.10, e * 0.8, e * (1.0 - 0.4 * p.v) * 0.90}};
}

Colours chirp(const Pixel& p) {
  const auto at = [&](double y) {
    const double e = 2 + 1.5 * std::sin(p.x * y / 150);
    return Colour{e, 0.7 * e + 0.2, 0.4 * e + 0.5};
  };
  return {at(p.y), at(p.y + 1)};
}

Colours stars_on_black(const Pixel& p) {
  const double grid = std::fmod(p.x, 16) == 8 && std::fmod(p.y, 12) == 6 ? 1 : 0;
  const double s = grid * (0.05 + 0.0005 * p.x * p.y);
  double t = p.x == 40 && p.y == 30 ? 0 : s;
  if (p.x == 56 && p.y == 18) t *= 0.5;
  return {{s, 0.95 * s, 0.9 * s}, {t, 0.95 * t, 0.9 * t}};
}

Colours dark_limb(const Pixel& p) {
  const double r = std::sqrt(sq(p.x - 30) + sq(p.y - 25));
  const double k = r <= 4 ? 800 * (0.4 + 0.6 * std::sqrt(std::clamp(1 - r * r / 16, 0.0, 1.0))) : 0;
  const double h = 0.15 + 1.2 / (1 + sq((p.y - 45) / 9));
  return {{h + k, 0.9 * h + k, 1.3 * h + k}, {h + k, 0.9 * h + k, 1.3 * h + k + 0.08 * p.u}};
}

Colours green_against_blue(const Pixel& p) {
  const double g = p.x < 32 ? 1.0 : 0.6;
  return {{0, g, 0}, {0, 0, g}};
}

const std::map<std::string, Formula>& formulas() {
  static const std::map<std::string, Formula> all{
      {"F01",
       [](const Pixel& p) {
         return Colours{{p.u, p.u, p.u}, {p.u + 0.03, p.u + 0.03, p.u + 0.03}};
       }},
      {"F02", checker},
      {"F03", blobs},
      {"F04", noisy_waves},
      {"F05",
       [](const Pixel& p) {
         const Colour c{p.u, p.v, 1 - p.u * p.v};
         return Colours{c, c};
       }},
      {"F06", zone_plate},
      {"F07", display_stars},
      {"F08", green_against_blue},
      {"F09", [](const Pixel& p) { return disc_sky(p, 1.05, 1); }},
      {"F10", [](const Pixel& p) { return disc_sky(p, 1, 0.5); }},
      {"F11", noisy_sky},
      {"F12", warmer_ramp},
      {"F13", chirp},
      {"F14", stars_on_black},
      {"F15", dark_limb},
  };
  return all;
}

uint32_t seed_of(const std::string& name) { return name == "F04" ? 12345 : 2026; }

float stored(double value, bool display) {
  if (!display) return float(value);
  return float(std::floor(255 * std::clamp(value, 0.0, 1.0) + 0.5) / 255);
}

void fill(FlipPair& pair) {
  const Formula& formula = formulas().at(pair.name);
  uint32_t state = seed_of(pair.name);
  const auto draw = [&] {
    state = 1664525 * state + 1013904223;
    return double(state / 256) / 16777216;
  };
  const int width = pair.reference.width, height = pair.reference.height;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Colour noise{draw(), draw(), draw()};
      const Colours c =
          formula({double(x), double(y), (x + 0.5) / width, (y + 0.5) / height, noise});
      const size_t i = 3 * (size_t(y) * size_t(width) + size_t(x));
      for (size_t k = 0; k < 3; ++k) {
        pair.reference.samples[i + k] = stored(c.reference[k], pair.reference.display_referred);
        pair.test.samples[i + k] = stored(c.test[k], pair.test.display_referred);
      }
    }
}

std::optional<double> number_or_auto(const std::string& text) {
  if (text == "auto" || text == "-") return std::nullopt;
  return std::stod(text);
}

}  // namespace

Picture linear_picture(int width, int height) {
  Picture picture;
  picture.width = width;
  picture.height = height;
  picture.channels = {"R", "G", "B"};
  picture.samples.resize(3 * picture.pixel_count());
  return picture;
}

std::string fnv1a_of(const Picture& picture) {
  uint64_t hash = 0xcbf29ce484222325;
  const auto add = [&](uint8_t byte) { hash = (hash ^ byte) * 0x100000001b3; };
  for (const float v : picture.samples) {
    if (picture.display_referred) {
      add(uint8_t(std::lround(v * 255)));
      continue;
    }
    uint8_t bytes[4];
    std::memcpy(bytes, &v, 4);
    for (const uint8_t byte : bytes) add(byte);
  }
  std::ostringstream text;
  text << std::hex;
  text.fill('0');
  text.width(16);
  text << hash;
  return text.str();
}

FlipPair flip_pair(const std::string& row) {
  std::istringstream in(row);
  FlipPair pair;
  int display, width, height;
  std::string mapper, start, stop, exposures;
  in >> pair.name >> display >> width >> height >> pair.options.pixels_per_degree >> mapper >>
      start >> stop >> exposures >> pair.reference_fnv1a >> pair.test_fnv1a;
  if (!in) throw std::runtime_error("short row: " + row);
  pair.reference = pair.test = linear_picture(width, height);
  pair.reference.display_referred = pair.test.display_referred = display != 0;
  pair.options.published_exposures = true;
  pair.options.tone_mapper = mapper == "hable"      ? ToneMapper::hable
                             : mapper == "reinhard" ? ToneMapper::reinhard
                                                    : ToneMapper::aces;
  pair.options.start = number_or_auto(start);
  pair.options.stop = number_or_auto(stop);
  if (const auto count = number_or_auto(exposures)) pair.options.exposures = int(*count);
  fill(pair);
  return pair;
}

}  // namespace skylapse::image
