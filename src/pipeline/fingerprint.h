#pragma once
// What a file depends on, as one hash: same fingerprint, same bytes.
#include <string>

#include "plan/plan.h"

namespace skylapse::pipeline {

/// Everything that shapes the scene-linear pixels of a frame: source, place, moment, air, sky
/// options, camera, colour space; and its exposure.
std::string scene_fingerprint(const plan::Plan& plan, const plan::Frame& frame);

/// Of the file that an image output writes for a frame. `color_config` is the hash of the colour
/// configuration in use (see color_config_hash).
std::string image_fingerprint(const plan::Plan& plan, const plan::Frame& frame,
                              const config::ImageOutput& output, const std::string& color_config);

/// Of the file or files that a product output writes for a frame.
std::string product_fingerprint(const plan::Plan& plan, const plan::Frame& frame,
                                const config::ProductOutput& output);

/// Of a movie: its settings and the fingerprints of its frames in order.
std::string movie_fingerprint(const config::MovieOutput& output,
                              const std::vector<std::string>& frame_fingerprints);

/// Hash of the OpenColorIO configuration that displays go through: the job's file or $OCIO by
/// content, or "built-in". Errors: the file cannot be read.
Result<std::string> color_config_hash(const config::JobConfig& job);

/// Path of that configuration; empty for the built-in one.
std::string color_config_file(const config::JobConfig& job);

}  // namespace skylapse::pipeline
