#pragma once
// Cubes for renderers: KTX 2 with mips, or pictures of faces.
#include <optional>
#include <span>

#include "image/orientation.h"
#include "pipeline/products/product.h"

namespace skylapse::pipeline {

/// A KTX 2 file of a cube with the whole pyramid of box mips. `strip`: vertical, faces as
/// OpenEXR's, with all light in it, and within half floats where the type is that (else
/// invalid_input). `camera` is the strip's. The encoding has "horizontal_lux" of the first level as
/// stored.
Result<ProductFile> make_cube_texture(const image::FrameBuffer& strip, const image::Camera& camera,
                                      output::SampleType type, const output::FrameMetadata& meta,
                                      std::optional<image::Orientation> orientation,
                                      StageTimes& times);

using Notes = std::vector<std::pair<std::string, std::string>>;

/// The same for levels that are there already, with notes beside those of the frame: what the
/// frame's attributes say, and where the axes of a lookup vector are (`skylapse:axes`).
Result<ProductFile> cube_texture_of(std::span<const image::FrameBuffer> levels,
                                    const image::Camera& camera, output::SampleType type,
                                    const output::FrameMetadata& meta,
                                    std::optional<image::Orientation> orientation, Notes notes,
                                    StageTimes& times);

/// The camera of a product's cube or map: the view turned as its orientation asks.
image::Camera product_camera(const config::ProductOutput& output);

/// Numbers that a file of this format and type holds, in place.
void round_as_stored(const std::string& format, output::SampleType type, image::FrameBuffer& image);

/// The type in which a product is written: the one asked for, but 32-bit floats where halves end
/// above what is to be stored. (Half floats end at 6e-8, 4e-5 lux: a night without a moon.)
output::SampleType stored_type(const ProductRequest& request, const image::FrameBuffer& picture);

/// For the record of a file: 16 or 32.
constexpr double stored_bits(output::SampleType type) {
  return type == output::SampleType::half_float ? 16 : 32;
}

/// Illuminance of level ground by a picture in the frame's space.
double horizontal_lux(const FrameLight& light, const glm::dvec3& horizontal_rgb);
/// By the model's own light: the sky's and, if the product has it and it shows, the disc's.
double true_horizontal_lux(const ProductRequest& request);

/// The disc's light for a product that has it: none where it is left out, does not show or has set.
std::vector<image::PointLight> disc_lights(const ProductRequest& request);

/// A picture as files: one, or of a strip whose faces are apart one for each face, in the order of
/// the orientation. `notes` become attributes.
Result<std::vector<ProductFile>> picture_files(const ProductRequest& request,
                                               const image::FrameBuffer& picture,
                                               output::SampleType type, const Notes& notes,
                                               StageTimes& times);

}  // namespace skylapse::pipeline
