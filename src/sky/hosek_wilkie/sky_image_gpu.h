#pragma once
// The Hosek-Wilkie sky on OpenGL: the published formula, evaluated band by band in every pixel. For
// comparison with the tabulated path of sky_image.h, which is the faster one.
#include "core/result.h"
#include "gpu/context.h"
#include "image/camera/camera.h"
#include "image/frame_buffer.h"
#include "sky/hosek_wilkie/sky_image.h"

namespace skylapse::sky::hosek_wilkie {

/// The same picture as render_sky, whose contract this has too. Directions come from the camera in
/// double, in pieces of kPixelsAtOnce, so an image of any size has no seams.
/// Error against Sky::radiance_xyz, relative to max(value, 1e-3 of the sky's scale): below 1e-4 on
/// llvmpipe (tested).
Status render_sky_gpu(gpu::Context& context, const image::Camera& camera, const ImageInputs& inputs,
                      image::FrameBuffer& out);

/// The same for the rows [first_row, first_row + out.height()) of the camera's image; out.width()
/// is the camera's.
Status render_sky_gpu_rows(gpu::Context& context, const image::Camera& camera,
                           const ImageInputs& inputs, int first_row, image::FrameBuffer& out);

inline constexpr int kPixelsAtOnce = 1 << 18;

}  // namespace skylapse::sky::hosek_wilkie
