#include "color/rgb_space.h"

#include <cassert>
#include <cmath>
#include <vector>

namespace skylapse::color {
namespace {

struct SpaceEntry {
  RgbSpace space;
  std::string_view name;
  RgbPrimaries primaries;
};

constexpr Chromaticity kAcesWhite{0.32168, 0.33767};

constexpr std::array<SpaceEntry, 4> kSpaces{{
    // ITU-R BT.709-6 (2015), table 3; IEC 61966-2-1 (1999) has the same primaries.
    {RgbSpace::rec709, "rec709", {{0.640, 0.330}, {0.300, 0.600}, {0.150, 0.060}, kD65White}},
    // ITU-R BT.2020-2 (2015), table 3.
    {RgbSpace::rec2020, "rec2020", {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, kD65White}},
    // Academy S-2014-004 (ACEScg), 4.2: AP1.
    {RgbSpace::acescg, "acescg", {{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, kAcesWhite}},
    // SMPTE ST 2065-1:2012, table 1: AP0.
    {RgbSpace::aces2065_1,
     "aces2065-1",
     {{0.73470, 0.26530}, {0.00000, 1.00000}, {0.00010, -0.07700}, kAcesWhite}},
}};

const SpaceEntry& entry(RgbSpace space) {
  const auto& e = kSpaces[static_cast<size_t>(space)];
  assert(e.space == space);
  return e;
}

struct SpaceMatrices {
  glm::dmat3 to_xyz;
  glm::dmat3 from_xyz;
};

const SpaceMatrices& matrices(RgbSpace space) {
  static const std::array<SpaceMatrices, kSpaces.size()> all = [] {
    std::array<SpaceMatrices, kSpaces.size()> m{};
    for (size_t i = 0; i < kSpaces.size(); ++i) {
      const RgbPrimaries& p = kSpaces[i].primaries;
      m[i].to_xyz = bradford_adaptation(p.white, kD65White) * native_rgb_to_xyz(p);
      m[i].from_xyz = glm::inverse(m[i].to_xyz);
    }
    return m;
  }();
  return all[static_cast<size_t>(space)];
}

}  // namespace

const RgbPrimaries& rgb_primaries(RgbSpace space) { return entry(space).primaries; }

std::string_view rgb_space_name(RgbSpace space) { return entry(space).name; }

Result<RgbSpace> rgb_space_from_name(const std::string& name) {
  std::vector<std::string> names;
  std::string list;
  for (const SpaceEntry& e : kSpaces) {
    if (e.name == name) return e.space;
    names.emplace_back(e.name);
    list += (list.empty() ? "" : ", ") + names.back();
  }
  std::string hint = "known: " + list;
  if (const auto near = nearest_name(name, names)) hint += "; did you mean " + *near + "?";
  return Error{.code = ErrorCode::invalid_input,
               .message = "unknown colour space '" + name + "'",
               .hint = hint};
}

glm::dmat3 native_rgb_to_xyz(const RgbPrimaries& p) {
  // Columns: XYZ of the primaries, each scaled so that their sum is the white (SMPTE RP 177:1993).
  // AP0's blue has a negative y; dividing x, y, 1-x-y by nothing keeps it harmless.
  const auto column = [](Chromaticity c) { return glm::dvec3(c.x, c.y, 1.0 - c.x - c.y); };
  const glm::dmat3 unscaled(column(p.red), column(p.green), column(p.blue));
  assert(std::abs(glm::determinant(unscaled)) > 1e-6);
  const glm::dvec3 scale = glm::inverse(unscaled) * xyz_of(p.white).value;
  return {unscaled[0] * scale[0], unscaled[1] * scale[1], unscaled[2] * scale[2]};
}

glm::dmat3 bradford_adaptation(Chromaticity from, Chromaticity to) {
  // Rows of the cone response, written as columns for glm.
  const glm::dmat3 cone(glm::dvec3(0.8951, -0.7502, 0.0389), glm::dvec3(0.2664, 1.7135, -0.0685),
                        glm::dvec3(-0.1614, 0.0367, 1.0296));
  const glm::dvec3 gain = (cone * xyz_of(to).value) / (cone * xyz_of(from).value);
  const glm::dmat3 scaled(cone[0] * gain, cone[1] * gain, cone[2] * gain);
  return glm::inverse(cone) * scaled;
}

const glm::dmat3& xyz_to_rgb(RgbSpace space) { return matrices(space).from_xyz; }
const glm::dmat3& rgb_to_xyz(RgbSpace space) { return matrices(space).to_xyz; }

glm::dmat3 rgb_to_rgb(RgbSpace from, RgbSpace to) { return xyz_to_rgb(to) * rgb_to_xyz(from); }

std::array<float, 8> exr_chromaticities(RgbSpace space) {
  const RgbPrimaries& p = rgb_primaries(space);
  const auto f = [](double v) { return static_cast<float>(v); };
  return {f(p.red.x),  f(p.red.y),  f(p.green.x), f(p.green.y),
          f(p.blue.x), f(p.blue.y), f(p.white.x), f(p.white.y)};
}

Chromaticity chromaticity(Color<Xyz> xyz) {
  const glm::dvec3& v = xyz.value;
  const double sum = v.x + v.y + v.z;
  if (sum == 0) return {};
  return {v.x / sum, v.y / sum};
}

UniformChromaticity uniform_chromaticity(Color<Xyz> xyz) {
  const glm::dvec3& v = xyz.value;
  const double sum = v.x + 15.0 * v.y + 3.0 * v.z;  // CIE 15:2004, 8.2.1
  if (sum == 0) return {};
  return {4.0 * v.x / sum, 9.0 * v.y / sum};
}

Color<Xyz> xyz_of(Chromaticity c) {
  assert(c.y > 0);
  return {glm::dvec3(c.x / c.y, 1.0, (1.0 - c.x - c.y) / c.y)};
}

double correlated_colour_temperature_k(Chromaticity c) {
  // Table 1 of the paper: the epicentre and three (two) exponentials.
  const double n = (c.x - 0.3366) / (c.y - 0.1735);
  const double t = -949.86315 + 6253.80338 * std::exp(-n / 0.92159) +
                   28.70599 * std::exp(-n / 0.20039) + 0.00004 * std::exp(-n / 0.07125);
  if (t <= 50000.0) return t;
  const double hot = (c.x - 0.3356) / (c.y - 0.1691);
  return 36284.48953 + 0.00228 * std::exp(-hot / 0.07861) + 5.4535e-36 * std::exp(-hot / 0.01543);
}

}  // namespace skylapse::color
