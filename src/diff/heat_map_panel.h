#pragma once
// A map of errors in false colour with all that is needed to read it.
#include <vector>

#include "core/result.h"
#include "diff/diff_result.h"
#include "diff/evidence.h"
#include "image/frame_buffer.h"
#include "output/image_writer.h"

namespace skylapse::diff {

/// Place of an error on the scale, 0..1, for both kinds of pictures the same in every map:
/// logarithmic, from 0.01 % of the light to 100 %, or from 0.1 to 255 code values. Errors beyond
/// the ends count as the ends.
double place_on_scale(float error, bool display_referred);

/// Display values 0..1. Small pictures are magnified by a whole number, large ones shrunk to 4096
/// columns by taking the largest error. Black: equal. Cyan: no number in one of them. A green frame
/// stands around the largest error, a white ring around the sun; lat-long maps have azimuths and
/// elevations at their rim, other cameras the points of the compass on the horizon.
/// Errors: internal (text could not be drawn).
Result<image::FrameBuffer> heat_map_panel(const output::ImageIo& io, const PairResult& pair,
                                          const PairEvidence& evidence,
                                          const std::vector<float>& errors);

}  // namespace skylapse::diff
