#include "plan/output_cost.h"

#include "plan/sight.h"

namespace skylapse::plan {
namespace {

using config::ProductKind;

/// Nanoseconds of one core per pixel, and bytes per pixel, of a step of the pipeline.
struct Rate {
  double nanoseconds;
  double bytes;
};

constexpr double kSkyNs = 7;       // Hosek-Wilkie, or a picture from a slice
constexpr double kDisplayNs = 51;  // exposure, display transform, dither
constexpr double kMovieNs = 58;    // reading back and x264

double pixels_of(const image::Camera& camera) { return double(camera.width) * camera.height; }

Rate encoding(const std::string& format, output::SampleType type) {
  const bool float32 = type == output::SampleType::float32;
  const bool u16 = type == output::SampleType::u16;
  if (format == "png") return u16 ? Rate{53, 1.8} : Rate{27, 0.9};
  if (format == "jpg") return {3, 0.05};
  if (format == "hdr") return {8, 0.6};
  if (format == "tif") return {float32 ? 120. : 40., float32 ? 7. : u16 ? 2. : 1.};
  if (format == "ktx2") return float32 ? Rate{8, 16. * 4 / 3} : Rate{8, 8. * 4 / 3};  // all mips
  return float32 ? Rate{215, 6.8} : Rate{39, 0.4};                                    // exr
}

OutputCost cost_of_image(const config::ImageOutput& image, const config::CameraConfig& camera) {
  Rate rate = encoding(image.format, image.sample_type);
  if (image.view || image.display) rate.nanoseconds += kDisplayNs;
  const double pixels = pixels_of(image.own_view ? image.own_view->camera : camera.camera);
  return {pixels * rate.nanoseconds * 1e-9, pixels * rate.bytes};
}

/// Of products, as bench_lighting and the milliseconds in manifests have them: gathering the light
/// of the whole sphere, filtering it for reflection, and a pixel of each.
constexpr double kGatherSeconds = 0.025, kSpecularSeconds = 0.1;
constexpr double kSpecularNs = 500, kIrradianceNs = 1300;
constexpr double kTextBytes = 2e3;

OutputCost cost_of_product(const config::ProductOutput& product) {
  switch (product.kind) {
    case ProductKind::specular:
    case ProductKind::irradiance: {
      const bool specular = product.kind == ProductKind::specular;
      const double levels = specular ? 4. / 3 : 1;  // each a quarter of the one before
      const double pixels = levels * pixels_of(product.view->camera);
      const double bytes = encoding(product.format, product.sample_type).bytes;
      const double mips = product.format == "ktx2" ? 3. / 4 : 1;  // counted in `levels`
      return {(specular ? kSpecularSeconds : kGatherSeconds) +
                  1e-9 * pixels * (specular ? kSpecularNs : kIrradianceNs),
              pixels * bytes * mips};
    }
    case ProductKind::harmonics:
      return {kGatherSeconds, kTextBytes};
    case ProductKind::sun:
    case ProductKind::dome:
      return {0, kTextBytes};
  }
  return {};
}

}  // namespace

OutputCost cost_of_output(const config::Output& output, const config::CameraConfig& camera) {
  if (const auto* image = std::get_if<config::ImageOutput>(&output))
    return cost_of_image(*image, camera);
  if (const auto* product = std::get_if<config::ProductOutput>(&output))
    return cost_of_product(*product);
  if (std::holds_alternative<config::MovieOutput>(output))
    return {1e-9 * kMovieNs * pixels_of(camera.camera), 0.005 * pixels_of(camera.camera)};
  return {};
}

double picture_pixels(const config::JobConfig& job, const config::CameraConfig& camera) {
  double pixels = 0;
  for (const image::Camera& picture : sight_of(job, camera).pictures) pixels += pixels_of(picture);
  return pixels;
}

double picture_seconds(const config::JobConfig& job, const config::CameraConfig& camera) {
  double seconds = 1e-9 * kSkyNs * picture_pixels(job, camera);
  for (const config::Output& output : job.outputs)
    seconds += cost_of_output(output, camera).core_seconds;
  return seconds;
}

}  // namespace skylapse::plan
