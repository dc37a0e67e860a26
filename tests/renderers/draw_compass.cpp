// draw_compass ORIENTATION PROJECTION WIDTH FILE: the compass image as a map for a renderer; exr in
// float, png with linear values in 8 bits.
// lat-long: FILE is one map. cube: FILE holds {face}, six images in the program's own order.
#include <cstdio>
#include <cstring>
#include <string>

#include "image/compass_image.h"
#include "image/orientation.h"
#include "output/atomic_file.h"
#include "output/image_writer.h"

using namespace skylapse;

namespace {

int fail(const std::string& text) {
  std::fprintf(stderr, "draw_compass: %s\n", text.c_str());
  return 1;
}

Status write(const std::string& file, int width, int height, const float* pixels) {
  const auto io = output::open_image_io();
  if (!io) return io.error();
  output::EncodeRequest request;
  request.format = file.substr(file.rfind('.') + 1);
  request.width = width, request.height = height, request.pixels = pixels;
  std::vector<uint8_t> quantised;
  if (request.format == "png") {
    const size_t samples = size_t(3) * width * height;
    for (size_t i = 0; i < samples; ++i) quantised.push_back(uint8_t(pixels[i] * 255 + 0.5F));
    request.type = output::SampleType::u8;
    request.pixels = quantised.data();
  }
  const auto bytes = (*io)->encode(request);
  if (!bytes) return bytes.error();
  return output::write_file_atomically(file, *bytes);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) return fail("ORIENTATION lat-long|cube WIDTH FILE");
  const auto orientation = image::orientation_from_name(argv[1]);
  if (!orientation) return fail("no such orientation");
  const bool cube = std::strcmp(argv[2], "cube") == 0;
  const int size = std::stoi(argv[3]);
  const std::string file = argv[4];
  image::Camera camera;
  camera.projection = cube ? image::Projection::cube : image::Projection::lat_long;
  camera.width = size, camera.height = cube ? 6 * size : size / 2;
  camera.camera_to_enu =
      image::look_at(image::map_heading(camera.projection, *orientation), {}, {});
  const image::FrameBuffer picture = image::compass_image(camera);
  if (!cube) {
    const Status written = write(file, camera.width, camera.height, picture.data().data());
    return written ? 0 : fail(written.error().message);
  }
  constexpr std::array kNames{"px", "nx", "py", "ny", "pz", "nz"};
  const auto& faces = image::faces_in(image::convention_of(*orientation).cube_order);
  for (size_t i = 0; i < faces.size(); ++i) {
    std::string name = file;
    const size_t at = name.find("{face}");
    if (at == std::string::npos) return fail("the file of a cube holds {face}");
    name.replace(at, 6, kNames[i]);
    const auto origin = image::cube_face_origin(camera, faces[i]);
    const Status written = write(name, size, size, picture.pixel(0, origin.y));
    if (!written) return fail(written.error().message);
  }
}
