#include "sky/hosek_wilkie/sky_image_gpu.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "gpu/buffer.h"
#include "gpu/functions.h"
#include "gpu/program.h"

namespace skylapse::sky::hosek_wilkie {
namespace {

constexpr int kGroupSize = 64;  // local_size_x of the shader

// As in shaders/entry/hosek_wilkie.comp (std140).
struct Band {
  float a, b, c, d;
  float e, f, g, h;
  float i, unused[3];
  float colour[4];  // scale and weight, in the image's space
};
struct Block {
  float ground[4];
  int band_count, pixels, unused[2];
  Band bands[kBandCount];
};
static_assert(sizeof(Band) == 64 && sizeof(Block) == 32 + kBandCount * 64, "the layout of std140");

/// One pixel's place, from double: float keeps the digits of each.
struct Place {
  float cos_theta;            // of the view's zenith angle
  float one_minus_cos_gamma;  // 2 sin^2 of half the angle to the sun
  float share;                // of the pixel above the horizon; negative: not in the picture
  float unused;
};

Block block_of(const ImageInputs& inputs) {
  Block block{};
  const Patterns& patterns = inputs.sky->patterns();
  block.band_count = patterns.count;
  for (int c = 0; c < 3; ++c) block.ground[c] = float(inputs.ground_rgb[c]);
  for (int n = 0; n < patterns.count; ++n) {
    const Pattern& p = patterns.items[n];
    const glm::dvec3 colour =
        inputs.scale * p.scale * (inputs.xyz_to_rgb * inputs.sky->xyz_weights()[n]);
    block.bands[n] = {float(p.a),
                      float(p.b),
                      float(p.c),
                      float(p.d),
                      float(p.e),
                      float(p.f),
                      float(p.g),
                      float(p.h),
                      float(p.i),
                      {},
                      {float(colour.x), float(colour.y), float(colour.z), 0}};
  }
  return block;
}

/// Upper bound of a pixel's half side at the horizon [rad]: only nearer pixels straddle it.
double straddling_sine(const image::Camera& camera) {
  double largest = 0;
  constexpr int kSteps = 64;  // along both axes; pixel sizes change little from one to the next
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j)
      largest = std::max(largest, image::pixel_solid_angle(camera, (camera.width - 1) * i / kSteps,
                                                           (camera.height - 1) * j / kSteps)
                                      .in(sr));
  return std::sqrt(largest);
}

class Places {
 public:
  Places(const image::Camera& camera, const Direction<Enu>& sun)
      : camera_(camera), sun_(sun.vec()), straddle_(straddling_sine(camera)) {}

  /// Of the pixels [first, first + count) in reading order.
  std::vector<Place> make(size_t first, size_t count) const {
    std::vector<Place> places(count);
    parallel_for_ranges(count, 4096, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i)
        places[i] = make_one(int((first + i) % size_t(camera_.width)),
                             int((first + i) / size_t(camera_.width)));
    });
    return places;
  }

 private:
  [[nodiscard]] Place make_one(int x, int y) const {
    const auto view = image::direction_at(camera_, {x + 0.5, y + 0.5});
    if (!view) return {0, 0, -1, 0};
    const glm::dvec3 chord = view->vec() - sun_;
    const double z = view->z();
    double share = z >= 0 ? 1 : 0;
    if (std::abs(z) < straddle_)
      share = image::horizon_coverage(elevation(*view), image::pixel_solid_angle(camera_, x, y));
    return {float(z), float(0.5 * glm::dot(chord, chord)), float(share), 0};
  }

  const image::Camera& camera_;
  glm::dvec3 sun_;
  double straddle_;
};

}  // namespace

Status render_sky_gpu(gpu::Context& context, const image::Camera& camera, const ImageInputs& inputs,
                      image::FrameBuffer& out) {
  assert(out.height() == camera.height);
  return render_sky_gpu_rows(context, camera, inputs, 0, out);
}

Status render_sky_gpu_rows(gpu::Context& context, const image::Camera& camera,
                           const ImageInputs& inputs, int first_row, image::FrameBuffer& out) {
  assert(inputs.sky != nullptr && out.width() == camera.width);
  assert(first_row >= 0 && first_row + out.height() <= camera.height);
  const size_t before = size_t(first_row) * size_t(camera.width);
  Block block = block_of(inputs);
  const Places places(camera, inputs.sun);
  return context.run([&](const gpu::Functions& gl) -> Status {
    const auto program =
        gpu::Program::create(gl, "entry/hosek_wilkie.comp", {{"MAX_BANDS", kBandCount}});
    if (!program) return program.error();
    for (size_t first = 0; first < out.pixel_count(); first += kPixelsAtOnce) {
      const size_t count = std::min<size_t>(kPixelsAtOnce, out.pixel_count() - first);
      block.pixels = int(count);
      const gpu::Buffer uniforms = gpu::Buffer::of_block(gl, block);
      const gpu::Buffer input = gpu::Buffer::of(gl, places.make(before + first, count));
      const gpu::Buffer pixels = gpu::Buffer::create(gl, 3 * sizeof(float) * count);
      uniforms.bind_uniform(gl, 0);
      input.bind_storage(gl, 0);
      pixels.bind_storage(gl, 1);
      program->dispatch(gl, {gpu::groups_for(int(count), kGroupSize)});
      pixels.read(gl, 0, pixels.bytes(), out.data().data() + 3 * first);
    }
    return Done{};
  });
}

}  // namespace skylapse::sky::hosek_wilkie
