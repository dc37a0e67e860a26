// Keys of images, movies, and of what is made of all frames. The rows are explained in key_spec.h.
#include "config/key_sections.h"
#include "config/words.h"

namespace skylapse::config {
namespace {

using K = ValueKind;
using D = Dimension;

/// A key of the camera, for an output that looks at the sky by itself.
KeySpec view_key(std::string_view name, std::string_view default_text, std::string_view doc) {
  KeySpec key = *find_key_spec(camera_spec(), name);
  key.default_text = default_text;
  key.doc = doc;
  return key;
}

KeySpec shown_image_key() {
  return {.name = "image",
          .kind = K::output_path,
          .required = true,
          .example = "preview/{site}_{date}_{time}.jpg",
          .doc =
              "The pictures that it shows: the name of an image output, letter by letter, that "
              "is display-referred."};
}

}  // namespace

const SectionSpec& image_spec() {
  static const SectionSpec spec{
      .name = "image output",
      .doc =
          "One image file for each frame, by the frame's camera or, with projection or size, a "
          "view of its own of the same sky.",
      .keys = {
          {.name = "image",
           .kind = K::output_path,
           .required = true,
           .example = "sky.####.exr",
           .doc = "File name, relative to the output folder. #### is the frame number; tokens: "
                  "{site} {date} {time} {camera} {turbidity} {albedo} {face} {sun_elevation} "
                  "{half} {size}. "
                  "The format follows from the ending: exr, hdr, png, jpg, tif, ktx2."},
          {.name = "type",
           .kind = K::word,
           .words = words_of(kSampleTypeWords),
           .example = "half",
           .doc = "Numbers in the file. Default float (exr, hdr), half (ktx2), u8 (png, jpg), u16 "
                  "(tif)."},
          {.name = "view",
           .kind = K::text,
           .example = "ACES SDR",
           .doc = "View of the OpenColorIO display: makes the image display-referred. png, jpg and "
                  "integer tif always are, by the default view; others are scene-linear."},
          {.name = "display",
           .kind = K::text,
           .example = "sRGB",
           .doc = "OpenColorIO display. Default: that of the OpenColorIO config."},
          {.name = "content",
           .kind = K::word,
           .words = words_of(kImageContentWords),
           .default_text = "radiance",
           .example = "sky",
           .doc = "What the values are: `sky` is the radiance without the sun's disc; "
                  "`standard-error` is that of each value of the picture without the disc, which "
                  "the model `reference` knows."},
          {.name = "sun",
           .kind = K::word,
           .words = words_of(kSunPolicyWords),
           .example = "split",
           .doc = "What the file does with the sun's disc, which is brighter than half numbers "
                  "reach: hold it as it is (`float`: a half file that cannot is written in 32 "
                  "bits), limit it, scale the image, leave the disc out and record it, or refuse. "
                  "Default `clip` for half numbers, else `float`."},
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
          view_key("projection", "",
                   "Gives the output a view of its own. Default: as the job's camera, if it has "
                   "one camera."),
          view_key("size", "",
                   "As of a camera. Without projection: the job's camera in another size."),
          view_key("fov", "", "Of an own view: as of a camera."),
          view_key("look_at", "",
                   "Of an own view: as of a camera. Default: for maps and cubes the heading of the "
                   "job's cameras, where they have one."),
          view_key("layout", "", "Of an own cube: as of a camera."),
          {.name = "orientation",
           .kind = K::word,
           .words = words_of(kOrientationWords),
           .example = "unreal",
           .doc = "Lays a map or cube out as this renderer wants it (docs/hdri.md), instead of by "
                  "look_at."},
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

const SectionSpec& gallery_spec() {
  static const SectionSpec spec{
      .name = "gallery output",
      .doc = "A page to look through all frames of the job, made when they are there.",
      .keys = {
          {.name = "gallery",
           .kind = K::output_path,
           .required = true,
           .example = "index.html",
           .doc = "File name, relative to the output folder, ending in html; without tokens."},
          shown_image_key(),
      }};
  return spec;
}

const SectionSpec& sheet_spec() {
  static const SectionSpec spec{
      .name = "sheet output",
      .doc = "A contact sheet of all frames of the job, with labels, made when they are there.",
      .keys = {
          {.name = "sheet",
           .kind = K::output_path,
           .required = true,
           .example = "contact.png",
           .doc =
               "File name, relative to the output folder, ending in png or jpg; without tokens."},
          shown_image_key(),
          {.name = "columns",
           .kind = K::integer,
           .min = "0",
           .max = "200",
           .default_text = "0",
           .example = "6",
           .doc = "Pictures in a row; 0: about as many as rows."},
      }};
  return spec;
}

}  // namespace skylapse::config
