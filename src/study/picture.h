#pragma once
// Thumbnails of a report: the whole sky as a disc, zenith in the middle, the sun's azimuth at the
// top.
#include <string>
#include <vector>

#include "study/study_result.h"

namespace skylapse::study {

inline constexpr int kThumbnailSize = 128;

/// A scene's sky as it truly is, at every pixel of a thumbnail: the best measured rung of it,
/// multiplied by the ratio of truth to rung that is interpolated from the study's directions
/// (inverse squares of the distances to the nearest six). Exact to the truth's noise at those
/// directions, smooth between them. XYZ; black outside the disc.
std::vector<glm::dvec3> true_thumbnail(const SceneResult& scene);

/// The sky of a rung, likewise.
std::vector<glm::dvec3> rung_thumbnail(const SceneResult& scene, const Measurement& measured);

/// Display-encoded RGB of 8 bits with alpha left out: paper colour outside the disc.
std::vector<uint8_t> shown(const std::vector<glm::dvec3>& xyz, double ev,
                           const output::DisplayTransform& display);

/// Relative error at every pixel as a colour: 0.1 % black, 1 % violet, 10 % orange, 100 % white
/// (perceptually even in between, safe for the colour-blind).
std::vector<uint8_t> error_map(const std::vector<glm::dvec3>& xyz,
                               const std::vector<glm::dvec3>& truth);

/// "data:image/png;base64,...".
Result<std::string> png_url(const output::ImageIo& io, const std::vector<uint8_t>& rgb, int width,
                            int height);

}  // namespace skylapse::study
