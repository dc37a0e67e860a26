// Keys of camera, exposure and colour. The rows are explained in key_spec.h.
#include "config/key_sections.h"
#include "config/words.h"

namespace skylapse::config {
namespace {

using K = ValueKind;
using D = Dimension;

const SectionSpec& look_at_spec() {
  static const SectionSpec spec{
      .name = "look_at",
      .doc = "Direction of the image centre. Lat-long and cube images take the azimuth alone.",
      .keys = {
          {.name = "azimuth",
           .kind = K::azimuth,
           .dimension = D::angle,
           .min = "-360 deg",
           .max = "360 deg",
           .required = true,
           .example = "270 deg",
           .doc = "From north, clockwise: east is 90 deg. Compass points work too."},
          {.name = "elevation",
           .kind = K::quantity,
           .dimension = D::angle,
           .min = "-90 deg",
           .max = "90 deg",
           .default_text = "0 deg",
           .example = "15 deg",
           .doc = "Above the horizon."},
          {.name = "roll",
           .kind = K::quantity,
           .dimension = D::angle,
           .min = "-360 deg",
           .max = "360 deg",
           .default_text = "0 deg",
           .example = "5 deg",
           .doc = "Turn of the camera about its axis, clockwise as seen from behind."},
      }};
  return spec;
}

}  // namespace

const SectionSpec& camera_spec() {
  static const SectionSpec spec{
      .name = "camera",
      .doc = "A camera. `cameras` is a list of such sections; the job renders every one of them.",
      .keys = {
          {.name = "name",
           .kind = K::text,
           .default_text = "camera, or camera1, camera2, ...",
           .example = "west",
           .doc = "Name of the camera, used in messages and by the token {camera}."},
          {.name = "projection",
           .kind = K::word,
           .words = words_of(kProjectionWords),
           .default_text = "perspective",
           .example = "fisheye",
           .doc = "How directions become pixels; `fisheye` is the equidistant one."},
          {.name = "look_at",
           .kind = K::view_direction,
           .sections = {&look_at_spec()},
           .example = "{azimuth: 270 deg, elevation: 15 deg}",
           .doc = "Where the camera looks: {azimuth, elevation, roll}, a compass point on the "
                  "horizon, `zenith` or `nadir` (north at the top). Needed for perspective; a "
                  "fisheye looks at the zenith, lat-long and cube images are centred on north."},
          {.name = "fov",
           .kind = K::quantity,
           .dimension = D::angle,
           .min = "1 arcmin",
           .max = "360 deg",
           .example = "75 deg",
           .doc = "Field of view: across the width for perspective (default 90 deg, less than "
                  "180 deg), across the circle for fisheye (default 180 deg; stereographic less "
                  "than 360 deg)."},
          {.name = "size",
           .kind = K::image_size,
           .example = "1920x1080",
           .doc = "Width and height in pixels; one number is the side of a square or of a cube's "
                  "face, and the width of a lat-long map twice as wide as high. Default 1920x1080 "
                  "(perspective), 1024x1024 (fisheye), 2048x1024 (lat-long), 512 (cube)."},
          {.name = "layout",
           .kind = K::word,
           .words = words_of(kLayoutWords),
           .default_text = "vertical-strip",
           .example = "cross",
           .doc = "Arrangement of the faces of a cube; `faces` writes six files by {face}."},
      }};
  return spec;
}

const SectionSpec& exposure_spec() {
  static const SectionSpec spec{
      .name = "exposure",
      .doc = "Exposure of display-referred images. Scene-linear files keep absolute radiance.",
      .keys = {
          {.name = "mode",
           .kind = K::word,
           .words = words_of(kExposureModeWords),
           .default_text = "sun-curve",
           .example = "fixed",
           .doc = "A smooth curve over the sun's elevation, one fixed value, or metered from the "
                  "sky. With `ev` given the mode is `fixed`."},
          {.name = "ev",
           .kind = K::quantity,
           .dimension = D::exposure_value,
           .min = "-20 EV",
           .max = "30 EV",
           .default_text = "15 EV",
           .example = "15 EV",
           .doc = "Exposure value at ISO 100, for mode fixed."},
          {.name = "compensation",
           .kind = K::quantity,
           .dimension = D::exposure_value,
           .min = "-20 stops",
           .max = "20 stops",
           .default_text = "0 stops",
           .example = "-0.5 stops",
           .doc = "Correction in stops; positive is brighter."},
          {.name = "rate_limit",
           .kind = K::quantity,
           .dimension = D::exposure_rate,
           .min = "0.001 stops/min",
           .max = "100 stops/min",
           .default_text = "0.5 stops/min",
           .example = "0.5 stops/min",
           .doc = "Greatest change of exposure, for mode metered."},
      }};
  return spec;
}

const SectionSpec& color_spec() {
  static const SectionSpec spec{
      .name = "color",
      .doc = "Colour spaces.",
      .keys = {
          {.name = "space",
           .kind = K::word,
           .words = {"rec709", "rec2020", "acescg", "aces2065-1"},
           .default_text = "rec709",
           .example = "acescg",
           .doc = "Primaries of scene-linear pixels."},
          {.name = "ocio",
           .kind = K::file,
           .example = "studio.ocio",
           .doc = "OpenColorIO config. Default: $OCIO, else a built-in ACES config."},
      }};
  return spec;
}

}  // namespace skylapse::config
