#pragma once
#include <OpenColorIO/OpenColorIO.h>

namespace skylapse::output::imageio {

/// The config used when the user has none: ACES2065-1 as reference, the four scene spaces of
/// color/rgb_space.h, and OpenColorIO's own ACES 1.x output transforms. OpenColorIO 2.1 brings no
/// ready-made configs, so it is assembled here.
///   displays  sRGB, Rec.1886 Rec.709, P3-D65: "ACES SDR" (RRT and SDR-VIDEO output transform),
///             "Un-tone-mapped", "Log" (ACEScct), "Raw"
///             Rec.2100-PQ: "ACES HDR 1000 nits", "Un-tone-mapped", "Log", "Raw"
OCIO_NAMESPACE::ConstConfigRcPtr builtin_config();

}  // namespace skylapse::output::imageio
