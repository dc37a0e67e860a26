#pragma once
// What files say of themselves: pixels, and the facts that must agree before pixels are compared.
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "color/rgb_space.h"
#include "diff/diff_result.h"
#include "image/diff/picture.h"
#include "output/image_writer.h"

namespace skylapse::diff {

using output::ReadLimits;

/// Facts for which a file may be wrong as a whole. Empty or nothing: the file does not say.
struct PictureFacts {
  FileFacts file;
  int parts = 1;
  /// Of each part that is not joined to the first (read_picture): size and a digest of its samples.
  std::vector<std::string> parts_apart;
  std::vector<image::SampleStorage> storage;  // of each channel
  image::SkyView view;
  bool sun_radius_told = false;
  std::string projection;   // "lat-long"
  std::string orientation;  // "usd"
  std::optional<double> heading_deg;
  std::string color_space;                // "rec709"
  std::vector<double> chromaticities;     // x, y of red, green, blue, white; or empty
  std::optional<double> white_luminance;  // cd/m^2 of 1.0: the unit
  std::string display, display_view;      // "sRGB", "ACES SDR": of display files
  std::string content;                    // "radiance", "sky without disc", "standard error"
  std::string program;                    // that wrote the file: "skylapse 0.1.0"
  std::string site;
  std::optional<double> latitude_deg, longitude_deg, height_m;
  std::optional<double> exposure_ev100;
};

struct ReadPicture {
  image::Picture picture;
  PictureFacts facts;
};

/// Reads a file whole: the first part, with the channels of further parts of the same size joined
/// to it as "<part>.<channel>". Parts of other sizes (small copies, pyramids) are told apart by
/// their digests. The facts come from its attributes and, what they do not tell, from the
/// manifest's entry of that file (null: none; FilePair::manifest_entry_a).
/// Errors: missing_input (not there, not an image, cut short, beyond the limits), with the reason.
Result<ReadPicture> read_picture(const std::string& path, const ReadLimits& limits,
                                 const nlohmann::json* manifest_entry = nullptr);

/// What does not agree: check "metadata.sun", "metadata.units", "metadata.projection",
/// "metadata.orientation", "metadata.time", "metadata.site", "metadata.content", "parts",
/// "stored-type" (a warning: B holds fewer bits). Facts that one of the files does not tell agree
/// with everything; so do programs, dates of writing, fingerprints, models and renderers.
std::vector<Finding> compare_facts(const PictureFacts& a, const PictureFacts& b);

}  // namespace skylapse::diff
