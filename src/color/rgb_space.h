#pragma once
// Named scene-linear RGB spaces and the way into them from CIE XYZ.
//
// The scene white is D65 (x 0.3127, y 0.3290): XYZ of that chromaticity becomes equal R, G, B in
// every space here. Spaces whose own white differs (ACES, about D60) are reached through a Bradford
// adaptation, as OpenColorIO's ACES transforms do, so a neutral grey stays neutral in all of them.
#include <array>
#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "core/result.h"

namespace skylapse::color {

/// A colour of a space; sums and scalings stay in that space, mixing two does not compile.
template <class Space>
struct Color {
  glm::dvec3 value{0.0};
  friend Color operator+(Color a, Color b) { return {a.value + b.value}; }
  friend Color operator-(Color a, Color b) { return {a.value - b.value}; }
  friend Color operator*(Color a, double s) { return {a.value * s}; }
  friend Color operator*(double s, Color a) { return {a.value * s}; }
};

/// CIE 1931 2-degree tristimulus values; 683 Y is cd/m^2 when made from W m^-2 sr^-1.
struct Xyz {};
/// Scene-linear RGB of an RgbSpace that the owner of the value names.
struct SceneRgb {};

/// CIE 1931 chromaticity x, y.
struct Chromaticity {
  double x = 0, y = 0;
};

/// CIE 1976 uniform chromaticity u', v'.
struct UniformChromaticity {
  double u = 0, v = 0;
};

/// D65 as the RGB standards round it (ITU-R BT.709-6, table 3.1.4).
inline constexpr Chromaticity kD65White{0.3127, 0.3290};

enum class RgbSpace {
  rec709,      // primaries of sRGB and Rec. 709
  rec2020,     // primaries of Rec. 2020
  acescg,      // AP1
  aces2065_1,  // AP0
};

struct RgbPrimaries {
  Chromaticity red, green, blue, white;
};

/// Primaries and white as the standards give them (sources beside the figures in the .cpp).
const RgbPrimaries& rgb_primaries(RgbSpace space);

/// "rec709", "rec2020", "acescg", "aces2065-1".
std::string_view rgb_space_name(RgbSpace space);
/// Inverse of rgb_space_name; an unknown name is an error that lists the four.
Result<RgbSpace> rgb_space_from_name(const std::string& name);

/// Matrix from linear RGB to XYZ with (1,1,1) -> the white of `primaries`, Y = 1. No adaptation.
/// Precondition: the three primaries are not collinear (asserted).
glm::dmat3 native_rgb_to_xyz(const RgbPrimaries& primaries);

/// Bradford adaptation of XYZ seen under `from` to XYZ seen under `to`.
/// Source: Lam 1985; matrix as in ICC.1:2010, annex E.
glm::dmat3 bradford_adaptation(Chromaticity from, Chromaticity to);

/// Matrix from XYZ (D65 scene) to `space`. Luminance of greys is kept: (1,1,1) <- Y = 1.
const glm::dmat3& xyz_to_rgb(RgbSpace space);
/// Its inverse.
const glm::dmat3& rgb_to_xyz(RgbSpace space);
/// Matrix from one space to another; greys map to the same greys.
glm::dmat3 rgb_to_rgb(RgbSpace from, RgbSpace to);

inline Color<SceneRgb> to_rgb(Color<Xyz> xyz, RgbSpace space) {
  return {xyz_to_rgb(space) * xyz.value};
}
inline Color<Xyz> to_xyz(Color<SceneRgb> rgb, RgbSpace space) {
  return {rgb_to_xyz(space) * rgb.value};
}

/// OpenEXR's `chromaticities`: red x y, green x y, blue x y, white x y.
std::array<float, 8> exr_chromaticities(RgbSpace space);

/// x, y of a colour. Precondition: X + Y + Z is not 0 (else 0, 0 is returned).
Chromaticity chromaticity(Color<Xyz> xyz);
UniformChromaticity uniform_chromaticity(Color<Xyz> xyz);
/// XYZ of the chromaticity with Y = 1. Precondition: y > 0.
Color<Xyz> xyz_of(Chromaticity chromaticity);

/// Correlated colour temperature in kelvin, 3000..800000 K, within about 2 % (its authors' figure);
/// outside that range the returned number means no more than "redder" or "bluer".
/// Source: Hernandez-Andres, Lee, Romero 1999, Applied Optics 38:5703, Eq. (3), made for daylight
/// and skylight chromaticities.
double correlated_colour_temperature_k(Chromaticity chromaticity);

}  // namespace skylapse::color
