#include "output/metadata.h"

#include <cstdio>

#include "color/exposure.h"
#include "core/constants.h"
#include "core/version.h"

namespace skylapse::output {
namespace {

/// "YYYY:MM:DD hh:mm:ss", as OpenEXR and Exif write times. Fractions of a second are cut off:
/// a frame never claims a second that had not begun.
std::string exif_time(std::chrono::sys_seconds local) {
  const auto day = std::chrono::floor<std::chrono::days>(local);
  const std::chrono::year_month_day date(day);
  const std::chrono::hh_mm_ss clock(local - day);
  char text[64];
  std::snprintf(text, sizeof text, "%04d:%02u:%02u %02d:%02d:%02d", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                static_cast<int>(clock.hours().count()), static_cast<int>(clock.minutes().count()),
                static_cast<int>(clock.seconds().count()));
  return text;
}

/// "YYYY-MM-DDThh:mm:ss.ffffffZ": the whole instant, for programs.
std::string iso_utc(std::chrono::sys_time<std::chrono::microseconds> utc) {
  const auto whole = std::chrono::floor<std::chrono::seconds>(utc);
  std::string text = exif_time(whole);
  text[4] = text[7] = '-';
  text[10] = 'T';
  char fraction[32];
  std::snprintf(fraction, sizeof fraction, ".%06dZ", static_cast<int>((utc - whole).count()));
  return text + fraction;
}

/// Longitude in [-180, 180], as maps write it.
double wrapped_degrees(Angle longitude) { return std::remainder(longitude.in(deg), 360.0); }

class AttributeList {
 public:
  void number(const char* name, double v) { all_.push_back({name, v}); }
  void single(const char* name, double v) { all_.push_back({name, static_cast<float>(v)}); }
  void text(const char* name, std::string v) {
    if (!v.empty()) all_.push_back({name, std::move(v)});
  }
  void integer(const char* name, int v) { all_.push_back({name, v}); }
  void floats(const char* name, std::vector<float> v) { all_.push_back({name, std::move(v)}); }
  std::vector<Attribute> take() { return std::move(all_); }

 private:
  std::vector<Attribute> all_;
};

void add_place_and_time(AttributeList& list, const FrameMetadata& f) {
  const auto local = std::chrono::floor<std::chrono::seconds>(f.utc + f.utc_offset);
  list.text("capDate", exif_time(local));
  // OpenEXR's sign: UTC = local + utcOffset, so two hours east of Greenwich is -7200.
  list.single("utcOffset", -static_cast<double>(f.utc_offset.count()));
  list.single("longitude", wrapped_degrees(f.position.longitude));
  list.single("latitude", f.position.latitude.in(deg));
  list.single("altitude", f.position.height.in(metre));
  list.text("skylapse:utc", iso_utc(f.utc));
  list.text("skylapse:zone", f.zone);
  list.text("skylapse:site", f.site);
}

void add_direction(AttributeList& list, const char* azimuth_name, const char* elevation_name,
                   const std::optional<Direction<Enu>>& direction) {
  if (!direction) return;
  list.number(azimuth_name, azimuth(*direction).in(deg));
  list.number(elevation_name, elevation(*direction).in(deg));
}

void add_colour(AttributeList& list, const FrameMetadata& f) {
  if (f.encoding == PixelEncoding::display) {
    list.text("skylapse:display", f.display);
    list.text("skylapse:view", f.view);
    // Becomes the sRGB chunk of PNG and the Exif colour space of JPEG.
    if (f.display.starts_with("sRGB")) list.text("oiio:ColorSpace", "sRGB");
    return;
  }
  const auto xy = color::exr_chromaticities(f.space);
  list.floats("chromaticities", {xy.begin(), xy.end()});
  list.text("skylapse:colorSpace", std::string(color::rgb_space_name(f.space)));
  if (f.encoding == PixelEncoding::absolute) {
    const double scale = f.sun_policy ? f.sun_policy->scale : 1.0;
    list.single("whiteLuminance", kLuminousEfficacy / scale);
  }
}

void add_exposure(AttributeList& list, const FrameMetadata& f) {
  if (!f.exposure_ev100) return;
  list.single("expTime", color::exposure_time_at_f8(*f.exposure_ev100).in(second));
  list.single("aperture", 8.0);
  list.single("isoSpeed", 100.0);
  list.number("skylapse:exposureEv100", *f.exposure_ev100);
}

void add_picture(AttributeList& list, const FrameMetadata& f) {
  // OpenImageIO makes OpenEXR's envmap attribute from this name; `envmap` itself it drops.
  if (f.environment == EnvironmentMap::lat_long) list.text("textureformat", "LatLong Environment");
  if (f.environment == EnvironmentMap::cube) list.text("textureformat", "CubeFace Environment");
  if (f.content) list.text("skylapse:content", picture_content_name(*f.content));
  list.text("skylapse:projection", f.projection);
  list.text("skylapse:orientation", f.orientation);
  if (f.heading) list.number("skylapse:heading", f.heading->in(deg));
  list.text("skylapse:cubeLayout", f.cube_layout);
  if (f.look) {
    list.number("skylapse:lookAzimuth", f.look->azimuth.in(deg));
    list.number("skylapse:lookElevation", f.look->elevation.in(deg));
    list.number("skylapse:roll", f.look->roll.in(deg));
  }
  if (f.field_of_view) list.number("skylapse:fieldOfView", f.field_of_view->in(deg));
}

void add_sun_policy(AttributeList& list, const FrameMetadata& f) {
  if (f.sun_radius) list.number("skylapse:sunRadius", f.sun_radius->in(deg));
  if (f.sun_illuminance) list.number("skylapse:sunIlluminance", f.sun_illuminance->in(lux));
  if (!f.sun_policy) return;
  if (f.disc_treated) list.text("skylapse:sunPolicy", sun_policy_name(f.sun_policy->policy));
  list.number("skylapse:scale", f.sun_policy->scale);
  list.integer("skylapse:pixelsBeyondHalf", static_cast<int>(f.sun_policy->pixels_beyond_half));
  list.number("skylapse:lostFraction", f.sun_policy->lost_fraction);
}

}  // namespace

std::string picture_content_name(PictureContent content) {
  switch (content) {
    case PictureContent::radiance:
      return "radiance";
    case PictureContent::sky_without_disc:
      return "sky without disc";
    case PictureContent::standard_error:
      return "standard error";
  }
  return {};
}

std::vector<Attribute> frame_attributes(const FrameMetadata& f) {
  AttributeList list;
  add_place_and_time(list, f);
  add_direction(list, "skylapse:sunAzimuth", "skylapse:sunElevation", f.sun);
  add_direction(list, "skylapse:moonAzimuth", "skylapse:moonElevation", f.moon);
  add_colour(list, f);
  add_exposure(list, f);
  add_picture(list, f);
  add_sun_policy(list, f);
  list.text("skylapse:model", f.model);
  list.integer("skylapse:extrapolated", f.extrapolated ? 1 : 0);
  list.text("skylapse:fingerprint", f.fingerprint);
  list.text("Software", std::string("skylapse ") + kVersion);
  return list.take();
}

}  // namespace skylapse::output
