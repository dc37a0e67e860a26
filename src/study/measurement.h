#pragma once
// One rung in one scene: its picture, its errors, its times and its memory.
#include <optional>
#include <string>
#include <vector>

#include "image/frame_buffer.h"
#include "study/ladder.h"
#include "study/sky_error.h"

namespace skylapse::study {

/// Middle and quartiles of repeated times, in ms.
struct Spread {
  double median = 0, lower = 0, upper = 0;
  int count = 0;
};
/// Linear between the ordered values; all 0 of none.
Spread spread_of(std::vector<double> values);

/// Times on the clock, and core times: what all threads of the process worked, which other
/// programs on the machine change little. `sky.time_budget` counts core time.
struct Timing {
  /// The first frame of a fresh program: context, shaders, tables and the picture. Once.
  double first_ms = 0, first_core_ms = 0;
  double tables_ms = 0;                // of first_ms, tables of multiple scattering
  std::vector<double> once_ms;         // further frames: what is computed once a frame ...
  std::vector<double> pixels_ms;       // ... and what goes with its pixels
  std::vector<double> core_ms;         // core time of the two together
  [[nodiscard]] Spread frame() const;  // on the clock, the two together
  [[nodiscard]] Spread core() const { return spread_of(core_ms); }
  /// The share of a frame that goes with its pixels.
  [[nodiscard]] double pixel_share() const;
};

struct Memory {
  size_t table_bytes = 0;
  std::optional<int64_t> peak_rise;  // bytes, of the process, during the first frame
};

/// CIEDE2000 between the pictures on a display, by solid angle.
struct PerceptualMeasure {
  double mean = 0, p95 = 0, max = 0;
};

struct Measurement {
  Rung rung;
  std::string skipped;  // why there is nothing else; empty: measured
  SkyErrors errors;
  PerceptualMeasure delta_e;
  std::optional<double> irradiance;  // relative error of XYZ, horizontal, sky alone
  std::optional<double> disc;  // relative error of XYZ, sun alone, facing it; nothing at night
  double sun_arcsec = 0;       // from the sun of the truth
  Timing timing;
  Memory memory;
  std::string renderer;  // GL's; empty where there was none
  /// Seen through the study's camera, without the disc. Empty of a small picture.
  image::FrameBuffer picture;
  double ev = 0;
};

}  // namespace skylapse::study
