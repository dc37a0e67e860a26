#pragma once
// The three ways of saying how hazy the air is, brought to one.
#include <array>
#include <optional>
#include <string_view>

#include "config/section_reader.h"

namespace skylapse::config {

inline constexpr std::array<std::string_view, 3> kHazeKeys{"turbidity", "visibility",
                                                           "aerosol_optical_depth"};

/// Turbidities that the Hosek-Wilkie sky was fitted to: 1 to 10.
bool within_hosek_wilkie(double turbidity);

/// Turbidities that a fitted model takes.
struct TurbidityRange {
  double lowest = 1, highest = 10;
};
TurbidityRange turbidity_range(SkyModel model);

/// Reads haze in the air of a description, for a model.
struct HazeReader {
  const sky::atmosphere::AirDescription& air;
  SkyModel model;
  int cie_type;
  const ReadContext& context;

  /// A CIE sky without sun, to which haze means nothing.
  [[nodiscard]] bool is_covered() const;

  /// The turbidity of a value of a key of kHazeKeys; reports a range beyond that of clear air, and
  /// what a demanded fitted sky does not reach. Nothing after an error.
  [[nodiscard]] std::optional<double> turbidity(const Section& section, std::string_view key,
                                                const Value& value) const;
};

/// Keyframes of `section`, the air of the job; what they leave out is that of `air`.
std::vector<AirKeyframe> build_keyframes(const Section& root, const Section& section,
                                         const Air& air, const std::vector<Site>& sites,
                                         const ReadContext& context);

}  // namespace skylapse::config
