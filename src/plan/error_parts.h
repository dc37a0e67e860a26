#pragma once
// What the error of a way of computing the sky is made of. The parts have causes of their own, are
// measured apart, and add as squares.
#include <array>
#include <string_view>

namespace skylapse::plan {

enum class ErrorPart {
  hosek_wilkie,       // the fit against the computed atmosphere of the same haze and ground
  single_scattering,  // all further orders left out
  draft,              // tables of this level against those of `fine`
  low,
  standard,
  fine,     // tables of this level, and the slice of a frame, against the path tracer
  bands_4,  // this many bands of wavelengths against 32
  bands_8,
  bands_16,
  path,       // of the path tracer: one path a pixel
  path_time,  // no error: microseconds of one core for a path
};
inline constexpr int kErrorParts = 11;
inline constexpr std::array<std::string_view, kErrorParts> kErrorPartNames{
    "hosek_wilkie", "single_scattering", "draft",    "low",  "standard", "fine",
    "bands_4",      "bands_8",           "bands_16", "path", "path_time"};

}  // namespace skylapse::plan
