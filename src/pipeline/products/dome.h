#pragma once
// A USD dome light that shows a lat-long map of the same frame.
#include "pipeline/products/product.h"

namespace skylapse::pipeline {

/// Whether the files of an output hold the sky without the sun's disc.
bool leaves_disc_out(const config::ImageOutput& map);

/// A layer with a DomeLight that names the frame's file of the image output `map_path`, turned so
/// that the map's north is the north of the output's orientation, whatever the map's heading. Maps
/// without the disc (content sky, sun: split) get a DistantLight beside it. A map whose values were
/// scaled (sun: scale) is scaled back by the dome's intensity, so that 1 is 683 cd/m^2 again.
/// Errors (invalid_input, at the map's path): no such output; not a lat-long map; display-referred.
Result<std::vector<ProductFile>> make_dome(const ProductRequest& request, StageTimes& times);

}  // namespace skylapse::pipeline
