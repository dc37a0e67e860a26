#pragma once
// What a frame's file says about itself: standard OpenEXR attributes, and ours as "skylapse:...".
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "astro/sky_state.h"
#include "color/rgb_space.h"
#include "core/frames.h"
#include "core/quantity.h"
#include "image/camera/camera.h"
#include "output/image_writer.h"
#include "output/sun_policy.h"

namespace skylapse::output {

/// How the picture lies on the sphere, for programs that light scenes with it.
enum class EnvironmentMap { none, lat_long, cube };

/// What the pixel values mean.
enum class PixelEncoding {
  absolute,  // scene-linear, 1.0 is 683 cd/m^2 (683 / scale with a scaled sun)
  exposed,   // scene-linear times the exposure
  display,   // through an OpenColorIO display and view
};

/// What of the scene the pixels are of.
enum class PictureContent {
  radiance,
  sky_without_disc,  // whether the sun is up or not
  standard_error,    // of the radiance
};

/// "radiance", "sky without disc", "standard error".
std::string picture_content_name(PictureContent content);

struct FrameMetadata {
  std::chrono::sys_time<std::chrono::microseconds> utc{};
  std::chrono::seconds utc_offset{};  // local = utc + utc_offset (east positive)
  std::string zone;                   // "Europe/Prague"
  astro::GeodeticPosition position;
  std::string site;
  std::optional<Direction<Enu>> sun, moon;  // apparent
  std::optional<Angle> sun_radius;
  color::RgbSpace space = color::RgbSpace::rec709;
  PixelEncoding encoding = PixelEncoding::absolute;
  std::string display, view;  // with PixelEncoding::display
  EnvironmentMap environment = EnvironmentMap::none;
  std::optional<PictureContent> content;
  std::string projection;        // "lat-long"
  std::string orientation;       // the renderer's convention, where one was asked for: "usd"
  std::optional<Angle> heading;  // azimuth of a map's centre, of a cube's +Z face in OpenEXR's axes
  std::string cube_layout;       // "cross"; "faces": each in a file of its own
  std::optional<image::Look> look;     // of pictures that do not stand upright
  std::optional<Angle> field_of_view;  // of perspective and fisheye pictures
  std::optional<double> exposure_ev100;
  std::string model;                           // "hosek-wilkie"
  bool extrapolated = false;                   // outside the model's range
  std::string fingerprint;                     // of config, code and tables
  std::optional<SunPolicyRecord> sun_policy;   // half-float files
  bool disc_treated = true;                    // whether the policy had a disc to act on
  std::optional<Illuminance> sun_illuminance;  // normal to the beam: what `split` leaves out
};

/// The attributes for EncodeRequest. Table with types and meanings: docs/color.md.
std::vector<Attribute> frame_attributes(const FrameMetadata& frame);

}  // namespace skylapse::output
