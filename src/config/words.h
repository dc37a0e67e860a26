#pragma once
// The words of the config and the values of the lower folders that they stand for.
#include <array>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "config/job_config.h"

namespace skylapse::config {

template <class T, size_t N>
using Words = std::array<std::pair<std::string_view, T>, N>;

inline constexpr Words<SkyModel, 8> kSkyModelWords{
    {{"auto", SkyModel::automatic},
     {"cie", SkyModel::cie},
     {"preetham", SkyModel::preetham},
     {"hosek-wilkie", SkyModel::hosek_wilkie},
     {"hosek-wilkie-gl", SkyModel::hosek_wilkie_gl},
     {"single-scattering", SkyModel::single_scattering},
     {"bruneton", SkyModel::bruneton},
     {"reference", SkyModel::reference}}};

/// A fitted model in a sentence: "the Preetham sky".
constexpr std::string_view fitted_name(SkyModel model) {
  return model == SkyModel::preetham ? "the Preetham sky"
         : model == SkyModel::cie    ? "the CIE general sky"
                                     : "the Hosek-Wilkie sky";
}

inline constexpr Words<SkyPrecision, 3> kPrecisionWords{{{"half", SkyPrecision::half},
                                                         {"float", SkyPrecision::single},
                                                         {"double", SkyPrecision::full}}};

inline constexpr Words<sky::bruneton::Level, 4> kLevelWords{
    {{"draft", sky::bruneton::Level::draft},
     {"low", sky::bruneton::Level::low},
     {"standard", sky::bruneton::Level::standard},
     {"fine", sky::bruneton::Level::fine}}};

inline constexpr Words<sky::hosek_wilkie::Fit, 3> kFitWords{
    {{"spectral", sky::hosek_wilkie::Fit::spectral},
     {"xyz", sky::hosek_wilkie::Fit::xyz},
     {"rgb", sky::hosek_wilkie::Fit::rgb}}};

inline constexpr Words<sky::hosek_wilkie::SolarFlux, 2> kSolarFluxWords{
    {{"reference", sky::hosek_wilkie::SolarFlux::reference},
     {"conserving", sky::hosek_wilkie::SolarFlux::conserving}}};

inline constexpr Words<astro::SunAlgorithm, 4> kSunAlgorithmWords{
    {{"erfa", astro::SunAlgorithm::erfa},
     {"sg2", astro::SunAlgorithm::sg2},
     {"preetham-atan2", astro::SunAlgorithm::preetham_atan2},
     {"preetham", astro::SunAlgorithm::preetham}}};

inline constexpr Words<image::Projection, 9> kProjectionWords{
    {{"perspective", image::Projection::perspective},
     {"fisheye", image::Projection::fisheye_equidistant},
     {"fisheye-equidistant", image::Projection::fisheye_equidistant},
     {"fisheye-equisolid", image::Projection::fisheye_equisolid},
     {"fisheye-stereographic", image::Projection::fisheye_stereographic},
     {"lat-long", image::Projection::lat_long},
     {"cube", image::Projection::cube},
     {"octahedral", image::Projection::octahedral},
     {"mirror-ball", image::Projection::mirror_ball}}};

/// How a cube is laid out; `faces` writes six files.
struct LayoutChoice {
  image::CubeLayout layout;
  bool faces_apart;
};
inline constexpr Words<LayoutChoice, 5> kLayoutWords{
    {{"vertical-strip", {image::CubeLayout::vertical_strip, false}},
     {"horizontal-strip", {image::CubeLayout::horizontal_strip, false}},
     {"cross", {image::CubeLayout::cross, false}},
     {"vertical-cross", {image::CubeLayout::vertical_cross, false}},
     {"faces", {image::CubeLayout::vertical_strip, true}}}};

inline constexpr Words<color::ExposureMode, 3> kExposureModeWords{
    {{"sun-curve", color::ExposureMode::sun_curve},
     {"fixed", color::ExposureMode::fixed},
     {"metered", color::ExposureMode::metered}}};

inline constexpr Words<output::SampleType, 4> kSampleTypeWords{
    {{"u8", output::SampleType::u8},
     {"u16", output::SampleType::u16},
     {"half", output::SampleType::half_float},
     {"float", output::SampleType::float32}}};

inline constexpr Words<ImageContent, 3> kImageContentWords{
    {{"radiance", ImageContent::radiance},
     {"sky", ImageContent::sky},
     {"standard-error", ImageContent::standard_error}}};

inline constexpr Words<output::SunPolicy, 5> kSunPolicyWords{
    {{"float", output::SunPolicy::float32},
     {"clip", output::SunPolicy::clip},
     {"scale", output::SunPolicy::scale},
     {"split", output::SunPolicy::split},
     {"refuse", output::SunPolicy::refuse}}};

inline constexpr Words<image::Orientation, 9> kOrientationWords{
    {{"openexr", image::Orientation::openexr},
     {"usd", image::Orientation::usd},
     {"blender", image::Orientation::blender},
     {"three", image::Orientation::three},
     {"gltf", image::Orientation::gltf},
     {"unreal", image::Orientation::unreal},
     {"unity", image::Orientation::unity},
     {"pbrt", image::Orientation::pbrt},
     {"mitsuba", image::Orientation::mitsuba}}};

inline constexpr Words<SunElevations::Half, 3> kHalfWords{
    {{"morning", SunElevations::Half::morning},
     {"afternoon", SunElevations::Half::afternoon},
     {"both", SunElevations::Half::both}}};

/// Compass points as azimuths in degrees.
inline constexpr Words<double, 8> kCompassWords{{{"north", 0},
                                                 {"north-east", 45},
                                                 {"east", 90},
                                                 {"south-east", 135},
                                                 {"south", 180},
                                                 {"south-west", 225},
                                                 {"west", 270},
                                                 {"north-west", 315}}};

template <class T, size_t N>
std::vector<std::string_view> words_of(const Words<T, N>& table) {
  std::vector<std::string_view> words;
  for (const auto& entry : table) words.push_back(entry.first);
  return words;
}

/// The first word of a value.
template <class T, size_t N>
std::string_view word_of(const Words<T, N>& table, const T& value) {
  for (const auto& entry : table)
    if (entry.second == value) return entry.first;
  return {};
}

template <class T, size_t N>
std::optional<T> value_of(const Words<T, N>& table, std::string_view word) {
  for (const auto& entry : table)
    if (entry.first == word) return entry.second;
  return std::nullopt;
}

}  // namespace skylapse::config
