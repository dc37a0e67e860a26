#pragma once
// What renderers want of a sky beside its picture: filtered cubes, harmonics, lights, dome files.
#include <map>
#include <string>
#include <vector>

#include "core/result.h"
#include "output/image_writer.h"
#include "output/metadata.h"
#include "pipeline/frame_light.h"

namespace skylapse::pipeline {

/// What a product of a frame is made from.
struct ProductRequest {
  const plan::Plan& plan;
  const plan::Frame& frame;
  const config::ProductOutput& output;
  const FrameLight& light;
  const output::ImageIo& io;
  output::FrameMetadata meta;      // for files that hold attributes
  std::vector<std::string> files;  // relative to the output folder: one, or six faces
};

/// One file, in memory: products are small whatever the size of the maps.
struct ProductFile {
  std::vector<std::byte> bytes;
  /// For the manifest: among others "horizontal_lux", the illuminance of level ground by what the
  /// file holds, after encoding; and "true_horizontal_lux", by the model's own light.
  std::map<std::string, double> encoding;
};

/// One file for each of `request.files`, in their order. The same request gives the same bytes.
Result<std::vector<ProductFile>> make_product(const ProductRequest& request, StageTimes& times);

}  // namespace skylapse::pipeline
