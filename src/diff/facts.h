#pragma once
// What files say of themselves: pixels, and the facts that must agree before pixels are compared.
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "color/rgb_space.h"
#include "diff/diff_result.h"
#include "image/diff/picture.h"

namespace skylapse::diff {

/// Bounds on what one file may take.
struct ReadLimits {
  uint64_t pixels = 1ull << 28;  // of one picture: 16384 x 16384
  uint64_t bytes = 4ull << 30;   // of its samples as floats
  int channels = 64;
};

/// Facts for which a file may be wrong as a whole. Empty or nothing: the file does not say.
struct PictureFacts {
  FileFacts file;
  int parts = 1;
  image::SkyView view;
  std::string projection;   // "lat-long"
  std::string orientation;  // "usd"
  std::optional<double> heading_deg;
  std::string color_space;                // "rec709"
  std::optional<double> white_luminance;  // cd/m^2 of 1.0: the unit
  std::string content;                    // "radiance", "sky without disc", "standard error"
  std::string site;
  std::optional<double> exposure_ev100;
};

struct ReadPicture {
  image::Picture picture;
  PictureFacts facts;
};

/// Reads a file whole. The facts come from its attributes and, what they do not tell, from the
/// manifest's entry of that file (null: none; with "frame", "camera", "output" of that entry).
/// Errors: missing_input (not there, not an image, cut short, beyond the limits), with the reason.
Result<ReadPicture> read_picture(const std::string& path, const ReadLimits& limits,
                                 const nlohmann::json* manifest_entry = nullptr);

/// What does not agree: check "metadata.sun", "metadata.units", "metadata.projection",
/// "metadata.orientation", "metadata.time", "metadata.content", "parts", "stored-type". Facts that
/// one of the files does not tell agree with everything.
std::vector<Finding> compare_facts(const PictureFacts& a, const PictureFacts& b);

}  // namespace skylapse::diff
