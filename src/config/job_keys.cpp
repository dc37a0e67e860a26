// The table of keys. A new key is a row here, a field in the struct it fills, and a line in the
// build_ function of its section.
#include "config/key_spec.h"
#include "config/words.h"

namespace skylapse::config {
namespace {

using K = ValueKind;
using D = Dimension;

const SectionSpec& site_spec() {
  static const SectionSpec spec{
      .name = "location",
      .doc =
          "A place on the Earth. `locations` is a list of such sections; the job renders every "
          "one of them.",
      .keys = {
          {.name = "name",
           .kind = K::text,
           .default_text = "site1, site2, ...",
           .example = "Prague",
           .doc = "Name of the place, used in messages and by the token {site} of output names."},
          {.name = "latitude",
           .kind = K::quantity,
           .dimension = D::latitude,
           .min = "-90 deg",
           .max = "90 deg",
           .required = true,
           .example = "50.0755 deg",
           .doc = "Geodetic latitude (WGS84), north positive. A plain number is in degrees; "
                  "50°04'32\"N is understood too."},
          {.name = "longitude",
           .kind = K::quantity,
           .dimension = D::longitude,
           .min = "-180 deg",
           .max = "360 deg",
           .required = true,
           .example = "14.4378 deg",
           .doc = "Longitude, east positive. A plain number is in degrees."},
          {.name = "height",
           .kind = K::quantity,
           .dimension = D::length,
           .min = "-500 m",
           .max = "100 km",
           .default_text = "0 m",
           .example = "235 m",
           .doc = "Height above the WGS84 ellipsoid."},
          {.name = "zone",
           .kind = K::zone,
           .example = "Europe/Prague",
           .doc = "Time zone of this place. Wins over `time.zone`."},
      }};
  return spec;
}

const SectionSpec& date_range_spec() {
  static const SectionSpec spec{
      .name = "dates",
      .doc = "A range of days.",
      .keys = {
          {.name = "from",
           .kind = K::date,
           .required = true,
           .example = "2026-06-01",
           .doc = "First day."},
          {.name = "to",
           .kind = K::date,
           .required = true,
           .example = "2026-06-30",
           .doc = "Last day, included if the steps reach it."},
          {.name = "step",
           .kind = K::quantity,
           .dimension = D::days,
           .min = "1 day",
           .max = "3660 days",
           .default_text = "1 day",
           .example = "7 days",
           .doc = "From one day of the range to the next, in whole days."},
      }};
  return spec;
}

const SectionSpec& time_spec() {
  static const SectionSpec spec{
      .name = "time",
      .doc = "Which moments are rendered. Days and locations multiply with them.",
      .keys =
          {
              {.name = "zone",
               .kind = K::zone,
               .example = "Europe/Prague",
               .doc = "Time zone of all clock times and calendar days: an IANA name, UTC, or an "
                      "offset "
                      "such as +02:00. Needed unless every time carries its own offset."},
              {.name = "date",
               .kind = K::date,
               .example = "2026-06-21",
               .doc = "The day, for times that do not carry a day of their own."},
              {.name = "dates",
               .kind = K::dates,
               .sections = {&date_range_spec()},
               .example = "2026-06-01 .. 2026-06-30",
               .doc = "Several days: a range \"first .. last\", a section {from, to, step}, or a "
                      "list. "
                      "A day that the zone skips is passed over within a range."},
              {.name = "from",
               .kind = K::time,
               .default_text = "00:00",
               .example = "sunrise - 45 min",
               .doc = "Where the frames of a day begin."},
              {.name = "to",
               .kind = K::time,
               .default_text = "24:00",
               .example = "sunset + 45 min",
               .doc = "Where the frames of a day end."},
              {.name = "step",
               .kind = K::quantity,
               .dimension = D::duration,
               .min = "1 ms",
               .max = "366 day",
               .example = "2 min",
               .doc = "Time from one frame to the next."},
              {.name = "frames",
               .kind = K::integer,
               .min = "1",
               .max = "10000000",
               .example = "240",
               .doc = "Number of frames, evenly from `from` to `to`, both included."},
              {.name = "every",
               .kind = K::quantity,
               .dimension = D::angle,
               .min = "0.01 deg",
               .max = "90 deg",
               .example = "1 deg",
               .doc = "A frame whenever the sun's true elevation passes a multiple of this angle."},
              {.name = "at",
               .kind = K::time,
               .list = true,
               .example = "[sunrise, solar_noon, 18:30]",
               .doc = "The times themselves."},
              {.name = "dut1",
               .kind = K::quantity,
               .dimension = D::duration,
               .min = "-0.9 s",
               .max = "0.9 s",
               .default_text = "0 s",
               .example = "0.12 s",
               .doc = "UT1 - UTC, from IERS Bulletin A. Without it the sun is off by up to 13.5 "
                      "arcsec."},
          },
      .alternatives = {{{"date", "dates"}}, {{"step", "frames", "every", "at"}, true}}};
  return spec;
}

const SectionSpec& air_spec() {
  static const SectionSpec spec{
      .name = "air",
      .doc = "The air and the ground. Lists multiply the job.",
      .keys =
          {
              {.name = "turbidity",
               .kind = K::number,
               .min = "1",
               .max = "10",
               .list = true,
               .default_text = "2.5",
               .example = "3",
               .doc = "Preetham's turbidity: 2 very clear, 3 clear, 6 hazy, 10 dense haze."},
              {.name = "visibility",
               .kind = K::quantity,
               .dimension = D::length,
               .min = "1 m",
               .max = "1000 km",
               .list = true,
               .example = "40 km",
               .doc = "Meteorological range at 550 nm (2 % contrast), converted to turbidity."},
              {.name = "aerosol_optical_depth",
               .kind = K::number,
               .min = "0",
               .max = "10",
               .list = true,
               .example = "0.1",
               .doc = "Optical depth of the aerosol at 550 nm, vertical, converted to turbidity."},
              {.name = "ground_albedo",
               .kind = K::albedo,
               .min = "0",
               .max = "1",
               .list = true,
               .default_text = "0.2",
               .example = "grass",
               .doc = "Reflectance of the ground: a number, or the name of a measured spectrum."},
              {.name = "refraction",
               .kind = K::on_off,
               .default_text = "on",
               .example = "off",
               .doc = "Whether the air lifts sun and moon."},
              {.name = "pressure",
               .kind = K::quantity,
               .dimension = D::pressure,
               .min = "0 hPa",
               .max = "1100 hPa",
               .default_text = "1010 hPa",
               .example = "1013.25 hPa",
               .doc = "Air pressure at the observer, for refraction."},
              {.name = "temperature",
               .kind = K::quantity,
               .dimension = D::temperature,
               .min = "-100 degC",
               .max = "60 degC",
               .default_text = "10 degC",
               .example = "15 degC",
               .doc = "Air temperature at the observer, for refraction."},
          },
      .alternatives = {{{"turbidity", "visibility", "aerosol_optical_depth"}}}};
  return spec;
}

const SectionSpec& sky_spec() {
  static const SectionSpec spec{
      .name = "sky",
      .doc = "How the sky is computed.",
      .keys = {
          {.name = "model",
           .kind = K::word,
           .words = words_of(kSkyModelWords),
           .default_text = "auto",
           .example = "hosek-wilkie",
           .doc = "Sky model. `auto` takes the cheapest that fits the scene and says why."},
          {.name = "fit",
           .kind = K::word,
           .words = words_of(kFitWords),
           .default_text = "spectral",
           .example = "xyz",
           .doc = "Which of the three published Hosek-Wilkie fits."},
          {.name = "solar_flux",
           .kind = K::word,
           .words = words_of(kSolarFluxWords),
           .default_text = "reference",
           .example = "conserving",
           .doc = "Sun disc as published, or with the full flux of direct sunlight."},
          {.name = "sun_disc",
           .kind = K::on_off,
           .default_text = "on",
           .example = "off",
           .doc = "Whether the disc itself is drawn."},
          {.name = "sun_algorithm",
           .kind = K::word,
           .words = words_of(kSunAlgorithmWords),
           .default_text = "erfa",
           .example = "sg2",
           .doc = "Formulas for the sun's position; all but `erfa` are there to be compared."},
      }};
  return spec;
}

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
           .doc = "Width and height in pixels; for a cube the side of a face. Default 1920x1080 "
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

const SectionSpec& image_spec() {
  static const SectionSpec spec{
      .name = "image output",
      .doc = "One image file for each frame.",
      .keys = {
          {.name = "image",
           .kind = K::output_path,
           .required = true,
           .example = "sky.####.exr",
           .doc = "File name, relative to the output folder. #### is the frame number; tokens: "
                  "{site} {date} {time} {camera} {turbidity} {albedo} {face} {sun_elevation}. "
                  "The format follows from the ending: exr, hdr, png, jpg, tif."},
          {.name = "type",
           .kind = K::word,
           .words = words_of(kSampleTypeWords),
           .example = "half",
           .doc = "Numbers in the file. Default float (exr, hdr), u8 (png, jpg), u16 (tif)."},
          {.name = "view",
           .kind = K::text,
           .example = "ACES SDR",
           .doc = "View of the OpenColorIO display: makes the image display-referred. png, jpg and "
                  "integer tif always are, by the default view; others are scene-linear."},
          {.name = "display",
           .kind = K::text,
           .example = "sRGB",
           .doc = "OpenColorIO display. Default: that of the OpenColorIO config."},
          {.name = "sun",
           .kind = K::word,
           .words = words_of(kSunPolicyWords),
           .default_text = "clip",
           .example = "split",
           .doc = "What a half exr does with the sun's disc, which is brighter than half numbers "
                  "reach: limit it, scale the image, leave the disc out and record it, or refuse."},
          {.name = "compression",
           .kind = K::word,
           .words = {"none", "zip", "zips", "piz", "dwaa"},
           .default_text = "zip",
           .example = "piz",
           .doc = "Compression of exr; tif takes none or zip."},
          {.name = "quality",
           .kind = K::integer,
           .min = "1",
           .max = "100",
           .default_text = "92",
           .example = "95",
           .doc = "Quality of jpg."},
      }};
  return spec;
}

const SectionSpec& movie_spec() {
  static const SectionSpec spec{
      .name = "movie output",
      .doc = "A movie of the frames in order, made by ffmpeg.",
      .keys = {
          {.name = "movie",
           .kind = K::output_path,
           .required = true,
           .example = "day.mp4",
           .doc = "File name, relative to the output folder, ending in mp4, mkv, mov or webm. "
                  "Tokens: {site} {date} {camera} {turbidity} {albedo}; several locations, "
                  "cameras or airs need theirs."},
          {.name = "fps",
           .kind = K::quantity,
           .dimension = D::frame_rate,
           .min = "0.1 fps",
           .max = "240 fps",
           .default_text = "30 fps",
           .example = "24 fps",
           .doc = "Frames per second."},
          {.name = "crf",
           .kind = K::integer,
           .min = "0",
           .max = "51",
           .default_text = "18",
           .example = "23",
           .doc = "Constant rate factor: lower is better and larger."},
          {.name = "view",
           .kind = K::text,
           .example = "ACES SDR",
           .doc = "View of the OpenColorIO display. Default: its default view."},
          {.name = "display",
           .kind = K::text,
           .example = "sRGB",
           .doc = "OpenColorIO display. Default: that of the OpenColorIO config."},
      }};
  return spec;
}

}  // namespace

const KeySpec* find_key_spec(const SectionSpec& section, std::string_view key) {
  for (const KeySpec& spec : section.keys)
    if (spec.name == key) return &spec;
  return nullptr;
}

const Alternatives* alternatives_of(const SectionSpec& section, std::string_view key) {
  for (const Alternatives& group : section.alternatives)
    for (const std::string_view name : group.keys)
      if (name == key) return &group;
  return nullptr;
}

const SectionSpec& job_spec() {
  static const SectionSpec spec{
      .name = "",
      .doc = "A job.",
      .keys =
          {
              {.name = "title",
               .kind = K::text,
               .example = "Prague, summer solstice",
               .doc = "A line about the job, kept in the manifest."},
              {.name = "location",
               .kind = K::section,
               .sections = {&site_spec()},
               .example = "{latitude: 50.0755 deg, longitude: 14.4378 deg}",
               .doc = "The place."},
              {.name = "locations",
               .kind = K::section_list,
               .sections = {&site_spec()},
               .doc = "Several places."},
              {.name = "time",
               .kind = K::section,
               .required = true,
               .sections = {&time_spec()},
               .example = "{zone: Europe/Prague, date: 2026-06-21, step: 10 min}",
               .doc = "Which moments are rendered."},
              {.name = "air",
               .kind = K::section,
               .sections = {&air_spec()},
               .doc = "The air and the ground."},
              {.name = "sky",
               .kind = K::section,
               .sections = {&sky_spec()},
               .doc = "How the sky is computed."},
              {.name = "camera",
               .kind = K::section,
               .sections = {&camera_spec()},
               .example = "{look_at: west, size: 1280x720}",
               .doc = "The camera."},
              {.name = "cameras",
               .kind = K::section_list,
               .sections = {&camera_spec()},
               .doc = "Several cameras."},
              {.name = "exposure",
               .kind = K::section,
               .sections = {&exposure_spec()},
               .doc = "Exposure of display-referred images."},
              {.name = "color",
               .kind = K::section,
               .sections = {&color_spec()},
               .doc = "Colour spaces."},
              {.name = "outputs",
               .kind = K::section_list,
               .required = true,
               .sections = {&image_spec(), &movie_spec()},
               .example = "[{image: sky.####.png}]",
               .doc = "What is written: a list of images and movies."},
              {.name = "allow_outside_paths",
               .kind = K::on_off,
               .default_text = "off",
               .example = "on",
               .doc = "Lets outputs leave the output folder."},
          },
      .alternatives = {{{"location", "locations"}, true}, {{"camera", "cameras"}, true}}};
  return spec;
}

}  // namespace skylapse::config
