#pragma once
// The names in golden.json.
#include <array>

#include "diff/goldens.h"

namespace skylapse::diff {

inline constexpr const char* kGoldenFile = "golden.json";
inline constexpr const char* kGoldenFormat = "skylapse goldens";
inline constexpr int kGoldenVersion = 1;
inline constexpr const char* kUnknownRenderer = "unknown";

struct GoldenKey {
  const char* name;
  std::string GoldenVariant::*value;
  bool needed;
};
/// Texts of a variant, in the order in which they are written.
inline constexpr std::array<GoldenKey, 10> kGoldenKeys{
    {{"renderer", &GoldenVariant::renderer, true},
     {"file", &GoldenVariant::file, true},
     {"sha256", &GoldenVariant::sha256, false},
     {"accepted_utc", &GoldenVariant::accepted_utc, false},
     {"note", &GoldenVariant::note, false},
     {"program", &GoldenVariant::program, false},
     {"source_hash", &GoldenVariant::source_hash, false},
     {"config", &GoldenVariant::config, false},
     {"model", &GoldenVariant::model, false},
     {"utc", &GoldenVariant::utc, false}}};

}  // namespace skylapse::diff
