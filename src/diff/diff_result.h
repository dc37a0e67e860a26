#pragma once
// What a comparison of files says: the values that all reports are made from.
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "image/diff/picture.h"

namespace skylapse::diff {

/// In the order of severity; the exit codes 0, 1, 2.
enum class Verdict { same, warning, different };

/// "same", "warning", "different".
std::string_view name_of(Verdict verdict);

/// Where something is, in the picture and in the sky.
struct Place {
  int x = 0, y = 0;     // column and row from the top left
  std::string channel;  // "R"; empty: all
  // Where the camera is known:
  std::optional<double> azimuth_deg, elevation_deg;
  std::optional<double> from_sun_deg;
  std::string region;  // "horizon ring", "sun's disc"; empty where it is not known
};

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A measure with its limits; those that have none carry NaN there.
struct MeasuredValue {
  std::string name;  // docs/diff.md
  std::string unit;  // "%", "code values", "px", "deg", "dB", ""
  double value = 0;  // in fractions, not percent
  double warn_above = kNone, fail_above = kNone;
  bool below = false;  // limits hold for values below them (psnr)
  Verdict verdict = Verdict::same;
  std::optional<Place> place;
};

/// Something that is not as it should be, in a sentence.
struct Finding {
  Verdict severity = Verdict::different;
  std::string check;    // "size", "nan", "metadata.sun", "relative.max", "sequence.order"
  std::string message;  // "one sample is NaN in B at column 200, row 100"
  std::optional<Place> place;
};

/// Of one file of a pair.
struct FileFacts {
  std::string path;
  std::string format;       // "openexr"
  std::string sample_type;  // "half", "float", "uint8", "rgbe"
  int width = 0, height = 0;
  std::vector<std::string> channels;
  std::string utc, model, renderer;  // as the file or its manifest says; empty: unknown
};

struct PairResult {
  std::string name;  // path below the folders, or the name of the file
  FileFacts a, b;    // A is the reference
  std::string profile;
  std::string golden;  // the renderer whose golden A is; empty: no golden
  Verdict verdict = Verdict::same;
  std::optional<Error> error;     // a file could not be read: nothing else holds
  std::vector<Finding> findings;  // worst first
  std::vector<MeasuredValue> measures;
  image::SkyView view;
  double read_ms = 0, measure_ms = 0, flip_ms = 0;
};

struct DiffResult {
  std::string a, b;  // as named on the command line
  std::vector<PairResult> pairs;
  std::vector<Finding> findings;  // of the whole: missing and extra files, order, flicker
  Verdict verdict = Verdict::same;
  bool unreadable = false;  // some file could not be read: exit 4
  size_t contrasts = 0;     // of a self-check: pairs of goldens that were tried
  double seconds = 0;
};

/// The line for the terminal: what is worst, where in the sky, by how much.
std::string summary_line(const PairResult& pair);

}  // namespace skylapse::diff
