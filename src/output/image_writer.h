#pragma once
// Image files and display transforms behind one interface. The libraries behind it are heavy to
// load, so they live in a shared module that is opened at first use (open_image_io).
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/result.h"
#include "image/diff/picture.h"
#include "image/frame_buffer.h"

namespace skylapse::output {

enum class SampleType { u8, u16, half_float, float32 };

/// What a half-float or RGBE file does with radiance beyond 65504 (the sun's disc).
enum class SunPolicy {
  float32,  // nothing is given up: a half file that does not fit is written in 32-bit floats
  refuse,   // an error before anything is rendered
  clip,     // limited to 65504; the loss of irradiance is recorded
  scale,    // the whole image scaled by a power of two that is recorded (whiteLuminance follows)
  split,    // the disc left out; its direction, radius and irradiance recorded
};

struct Attribute {
  std::string name;
  std::variant<int, float, double, std::string, std::vector<float>> value;
};

/// An image ready to be encoded, interleaved, row 0 at the top.
struct EncodeRequest {
  std::string format;  // "exr", "hdr", "png", "jpg", "tif"
  int width = 0, height = 0;
  SampleType type = SampleType::float32;  // of both `pixels` and the file
  const void* pixels = nullptr;           // half_float: pass float32 pixels, converted inside
  std::string compression = "zip";        // exr, tif
  int quality = 92;                       // jpg
  std::vector<Attribute> attributes{};    // names as OpenEXR spells them
  std::vector<std::string> channels = {"R", "G", "B"};  // others in exr alone
};

/// Where the bytes of a file go; writers may come back to what they have written.
class ByteSink {
 public:
  virtual ~ByteSink() = default;
  /// False if that failed; the sink knows why, and fails from then on.
  virtual bool write_at(uint64_t offset, std::span<const std::byte> bytes) = 0;
};

/// Rows of one image on their way into a file.
class RowWriter {
 public:
  virtual ~RowWriter() = default;
  /// The next `rows` rows, samples as of EncodeRequest::pixels. Errors: as of encode; `internal` if
  /// the library or the sink failed.
  virtual Status add(const void* pixels, int rows) = 0;
  /// To be called once, after the last row.
  virtual Status finish() = 0;
};

struct DecodedImage {
  image::FrameBuffer pixels;  // as stored, integers scaled to 0..1
  std::vector<Attribute> attributes;
  int stored_bits = 0;
  bool floating_point = false;  // half or float samples: scene-linear by custom
};

/// Bounds on what one picture may take, checked in its header before anything is allocated.
struct ReadLimits {
  uint64_t pixels = 1ull << 28;  // 16384 x 16384
  uint64_t bytes = 4ull << 30;   // of its samples as floats
  int channels = 64;
};

/// One part (OpenEXR's word; page, layer, frame of others) of an image file, whole.
struct ReadImage {
  std::string format;       // OpenImageIO's name: "openexr", "png"
  std::string compression;  // its word: "zip", "dwaa"; empty: none, or the format knows one alone
  std::string part_name;    // of OpenEXR; may be empty
  int parts = 1;            // of the file
  int width = 0, height = 0;
  std::vector<std::string> channels;          // in the order of the file
  std::vector<image::SampleStorage> storage;  // of each channel
  std::vector<float> samples;                 // interleaved, row 0 at the top
  std::vector<Attribute> attributes;          // of the part
};

/// Scene-linear to display, through an OpenColorIO display and view. Safe for use by many threads.
class DisplayTransform {
 public:
  virtual ~DisplayTransform() = default;
  /// In place, interleaved RGB, `pixels` of them.
  virtual void apply(float* rgb, size_t pixels) const = 0;
};

struct DisplayRequest {
  std::string config_file;  // empty: $OCIO, else the built-in ACES config
  std::string scene_space;  // "rec709", "rec2020", "acescg", "aces2065-1" (linear)
  std::string display;      // empty: the config's default
  std::string view;         // empty: the default view of that display
};

class ImageIo {
 public:
  virtual ~ImageIo() = default;
  /// The whole file in memory. Same request, same bytes. Refused: half samples beyond 65504; in
  /// .hdr what is not finite or beyond kLargestRgbe.
  virtual Result<std::vector<std::byte>> encode(const EncodeRequest& request) const = 0;
  /// For images larger than memory: the rows of `request`, whose `pixels` is not used, follow one
  /// after the other, in any portions. The same bytes as of encode. `sink` outlives the writer.
  virtual Result<std::unique_ptr<RowWriter>> open_rows(const EncodeRequest& request,
                                                       ByteSink& sink) const = 0;
  virtual Result<DecodedImage> decode(const std::string& path) const = 0;
  /// All channels of one part, counted from 0; what a file without that part says is an error.
  /// Which reader is asked follows from the first bytes of the file, and from its name only where
  /// those tell nothing. Integers are scaled to 0..1 (of OpenEXR: kept), colours are not multiplied
  /// by alpha, palettes and CMYK become RGB as OpenImageIO converts them, pictures lie as their
  /// Orientation says. OpenEXR: the display window, with 0 where the data window ends before it.
  /// Errors: missing_input with the reason: not a file, no image, cut short or corrupt, deep or
  /// three-dimensional pixels, subsampled channels (OpenEXR's Y RY BY), beyond `limits`.
  virtual Result<ReadImage> read(const std::string& path, int part,
                                 const ReadLimits& limits) const = 0;
  virtual Result<std::unique_ptr<DisplayTransform>> display(
      const DisplayRequest& request) const = 0;
  /// Displays and their views of a config, "display/view" each, default first.
  virtual Result<std::vector<std::string>> views(const std::string& config_file) const = 0;
  /// Scaled by a filter that averages over the pixels it shrinks.
  virtual Result<image::FrameBuffer> resized(const image::FrameBuffer& image, int width,
                                             int height) const = 0;
  /// White text with its baseline at row `y`, `height` pixels high. Needs a font on the machine;
  /// without one the picture stays as it is.
  virtual Status draw_text(image::FrameBuffer& image, int x, int y, int height,
                           const std::string& text) const = 0;
  /// The same without the samples: what the header says.
  virtual Result<ReadImage> read_header(const std::string& path, int part,
                                        const ReadLimits& limits) const = 0;
  /// Extensions of the files that can be read, in lower case without the dot.
  virtual std::vector<std::string> readable_extensions() const = 0;
  virtual std::string versions() const = 0;  // "OpenImageIO 2.4.7, OpenColorIO 2.1.2"
};

/// Loads the module (once per process). Missing module: ErrorCode::missing_backend.
Result<const ImageIo*> open_image_io();

}  // namespace skylapse::output
