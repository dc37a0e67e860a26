#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "astro/time/instant.h"
#include "core/printable.h"
#include "diff/facts.h"
#include "diff/stored_type.h"
#include "image/camera/camera_words.h"

namespace skylapse::diff {
namespace {

using image::SampleStorage;

// What two programs that mean the same may write apart: directions come in decimal texts and
// floats, times to the millisecond (manifests) or microsecond (files), places in floats of degrees.
constexpr double kSameDirectionDeg = 0.01;
constexpr double kSameRadiusDeg = 0.001;
constexpr double kSameTimeS = 0.002;
constexpr double kSamePlaceDeg = 1e-4;
constexpr double kSameHeightM = 1;
constexpr double kSameChromaticity = 1e-4;
constexpr double kSameShare = 1e-5;  // of luminances, floats

class Findings {
 public:
  void add(const char* check, std::string message, Verdict severity = Verdict::different) {
    all_.push_back(
        {.severity = severity, .check = check, .message = std::move(message), .place = {}});
  }
  /// Two texts of which neither is empty.
  void texts(const char* check, const char* what, const std::string& a, const std::string& b) {
    if (a.empty() || b.empty() || a == b) return;
    add(check, fmt::format("{} is \"{}\" in A and \"{}\" in B", what, shown(a), shown(b)));
  }
  /// Two numbers that are both told.
  void numbers(const char* check, const char* what, const char* unit, std::optional<double> a,
               std::optional<double> b, double same) {
    if (!a || !b || std::abs(*a - *b) <= same) return;
    add(check, fmt::format("{} is {:.10g}{} in A and {:.10g}{} in B", what, *a, unit, *b, unit));
  }
  std::vector<Finding> take() { return std::move(all_); }

 private:
  std::vector<Finding> all_;
};

std::string direction_text(const Direction<Enu>& d) {
  return fmt::format("azimuth {:.4f} deg, elevation {:.4f} deg", azimuth(d).in(deg),
                     elevation(d).in(deg));
}

void compare_suns(const PictureFacts& a, const PictureFacts& b, Findings& out) {
  if (a.view.sun && b.view.sun) {
    const double apart = separation(*a.view.sun, *b.view.sun).in(deg);
    if (apart > kSameDirectionDeg)
      out.add("metadata.sun",
              fmt::format("the sun is at {} in A and at {} in B, {:.4g} deg apart",
                          direction_text(*a.view.sun), direction_text(*b.view.sun), apart));
  }
  if (a.sun_radius_told && b.sun_radius_told)
    out.numbers("metadata.sun", "the radius of the sun", " deg", a.view.sun_radius.in(deg),
                b.view.sun_radius.in(deg), kSameRadiusDeg);
}

void compare_units(const PictureFacts& a, const PictureFacts& b, Findings& out) {
  constexpr auto kCheck = "metadata.units";
  if (a.white_luminance && b.white_luminance) {
    const double larger = std::max(std::abs(*a.white_luminance), std::abs(*b.white_luminance));
    out.numbers(kCheck, "the luminance of the value 1", " cd/m^2", a.white_luminance,
                b.white_luminance, kSameShare * larger);
  }
  out.texts(kCheck, "the colour space", a.color_space, b.color_space);
  const bool both = !a.chromaticities.empty() && !b.chromaticities.empty();
  const bool named = !a.color_space.empty() && !b.color_space.empty();
  if (both && !named) {
    double most = 0;
    for (size_t i = 0; i < a.chromaticities.size(); ++i)
      most = std::max(most, std::abs(a.chromaticities[i] - b.chromaticities[i]));
    if (most > kSameChromaticity)
      out.add(kCheck,
              fmt::format("the primaries' chromaticities are {:.4f} in A and {:.4f} in B",
                          fmt::join(a.chromaticities, " "), fmt::join(b.chromaticities, " ")));
  }
  out.texts(kCheck, "the display", a.display, b.display);
  out.texts(kCheck, "the view of the display", a.display_view, b.display_view);
  const auto shows = [](const PictureFacts& f) { return !f.display.empty(); };
  const auto linear = [](const PictureFacts& f) {
    return !f.color_space.empty() && f.display.empty();
  };
  if (shows(a) && linear(b))
    out.add(kCheck, fmt::format("A is made for a display (\"{}\"), B is scene-linear (\"{}\")",
                                shown(a.display), shown(b.color_space)));
  if (linear(a) && shows(b))
    out.add(kCheck, fmt::format("A is scene-linear (\"{}\"), B is made for a display (\"{}\")",
                                shown(a.color_space), shown(b.display)));
}

double degrees_apart(double a, double b) { return std::abs(std::remainder(a - b, 360.0)); }

bool has_field_of_view(image::Projection p) { return !image::sees_whole_sphere(p); }

/// Heading, look direction and roll are one thing: how the cameras' axes stand.
void compare_axes(const image::Camera& a, const image::Camera& b, Findings& out) {
  double apart = 0;
  for (int axis = 0; axis < 3; ++axis)
    apart = std::max(apart, separation(Direction<Enu>::from_vector(a.camera_to_enu[axis]),
                                       Direction<Enu>::from_vector(b.camera_to_enu[axis]))
                                .in(deg));
  if (apart <= kSameDirectionDeg) return;
  const auto text = [](const image::Camera& camera) {
    const image::Look look = image::look_of(camera.camera_to_enu);
    return fmt::format("azimuth {:.4f} deg, elevation {:.4f} deg, roll {:.4f} deg",
                       look.azimuth.in(deg), look.elevation.in(deg), look.roll.in(deg));
  };
  out.add("metadata.orientation",
          fmt::format("the camera looks to {} in A and to {} in B", text(a), text(b)));
}

void compare_views(const PictureFacts& a, const PictureFacts& b, Findings& out) {
  out.texts("metadata.projection", "the projection", a.projection, b.projection);
  out.texts("metadata.orientation", "the orientation", a.orientation, b.orientation);
  if (a.view.camera && b.view.camera && a.view.camera->projection == b.view.camera->projection) {
    const image::Camera &ca = *a.view.camera, &cb = *b.view.camera;
    if (has_field_of_view(ca.projection))
      out.numbers("metadata.projection", "the field of view", " deg", ca.field_of_view.in(deg),
                  cb.field_of_view.in(deg), kSameDirectionDeg);
    if (ca.projection == image::Projection::cube)
      out.texts("metadata.projection", "the layout of the cube",
                std::string(name_of(ca.cube_layout)), std::string(name_of(cb.cube_layout)));
    compare_axes(ca, cb, out);
  } else if (a.heading_deg && b.heading_deg &&
             degrees_apart(*a.heading_deg, *b.heading_deg) > kSameDirectionDeg) {
    out.add("metadata.orientation",
            fmt::format("the heading is {:.6g} deg in A and {:.6g} deg in B", *a.heading_deg,
                        *b.heading_deg));
  }
}

void compare_times(const PictureFacts& a, const PictureFacts& b, Findings& out) {
  if (a.file.utc.empty() || b.file.utc.empty()) return;
  const auto at_a = astro::parse_instant(a.file.utc), at_b = astro::parse_instant(b.file.utc);
  if (at_a && at_b && std::abs((*at_b - *at_a).in(second)) <= kSameTimeS) return;
  out.texts("metadata.time", "the time", a.file.utc, b.file.utc);
}

void compare_sites(const PictureFacts& a, const PictureFacts& b, Findings& out) {
  constexpr auto kCheck = "metadata.site";
  out.numbers(kCheck, "the latitude", " deg", a.latitude_deg, b.latitude_deg, kSamePlaceDeg);
  if (a.longitude_deg && b.longitude_deg &&
      degrees_apart(*a.longitude_deg, *b.longitude_deg) > kSamePlaceDeg)
    out.numbers(kCheck, "the longitude", " deg", a.longitude_deg, b.longitude_deg, 0);
  out.numbers(kCheck, "the height of the place", " m", a.height_m, b.height_m, kSameHeightM);
}

/// Of the channels that both have.
void compare_storage(const PictureFacts& a, const PictureFacts& b, Findings& out) {
  std::string fewer;
  std::string types;
  for (size_t i = 0; i < a.storage.size(); ++i) {
    const auto& names = b.file.channels;
    const size_t j = size_t(std::ranges::find(names, a.file.channels[i]) - names.begin());
    if (j >= b.storage.size() || precision_bits(b.storage[j]) >= precision_bits(a.storage[i]))
      continue;
    fewer += (fewer.empty() ? "" : ", ") + a.file.channels[i];
    if (types.empty())
      types = fmt::format("{} in A and {} in B", type_name(a.storage[i]), type_name(b.storage[j]));
  }
  if (!fewer.empty())
    out.add("stored-type", fmt::format("B is stored in fewer bits: {} is {}", shown(fewer), types),
            Verdict::warning);
}

void compare_parts(const PictureFacts& a, const PictureFacts& b, Findings& out) {
  if (a.parts != b.parts)
    return out.add("parts", fmt::format("A has {} and B has {} part{}", a.parts, b.parts,
                                        b.parts == 1 ? "" : "s"));
  if (a.parts_apart != b.parts_apart)
    out.add("parts",
            "parts of another size than the first, which are compared for equality alone, "
            "differ");
}

}  // namespace

std::vector<Finding> compare_facts(const PictureFacts& a, const PictureFacts& b) {
  Findings out;
  compare_suns(a, b, out);
  compare_units(a, b, out);
  compare_views(a, b, out);
  compare_times(a, b, out);
  compare_sites(a, b, out);
  out.texts("metadata.content", "what is shown", a.content, b.content);
  compare_parts(a, b, out);
  compare_storage(a, b, out);
  return out.take();
}

}  // namespace skylapse::diff
