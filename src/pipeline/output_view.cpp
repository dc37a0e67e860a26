#include "pipeline/output_view.h"

#include "image/orientation.h"

namespace skylapse::pipeline {

image::Camera oriented(image::Camera camera, std::optional<image::Orientation> orientation) {
  if (orientation && image::stands_upright(camera.projection))
    camera.camera_to_enu =
        image::look_at(image::map_heading(camera.projection, *orientation), Angle{}, Angle{});
  return camera;
}

OutputView view_of_output(const plan::Plan& plan, const plan::Frame& frame,
                          const config::ImageOutput& output) {
  OutputView view{output.own_view ? *output.own_view : plan.job.cameras[frame.camera]};
  image::Camera& camera = view.camera.camera;
  camera = oriented(camera, output.orientation);
  if (!output.orientation) return view;
  const bool strip = camera.cube_layout == image::CubeLayout::vertical_strip ||
                     camera.cube_layout == image::CubeLayout::horizontal_strip;
  if (camera.projection != image::Projection::cube || !strip) return view;
  const auto& faces = image::faces_in(image::convention_of(*output.orientation).cube_order);
  for (size_t i = 0; i < faces.size(); ++i) view.faces[i] = int(faces[i]);
  return view;
}

}  // namespace skylapse::pipeline
