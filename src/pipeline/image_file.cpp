#include "pipeline/image_file.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "color/dither.h"
#include "color/exposure.h"
#include "color/rgb_space.h"
#include "core/constants.h"
#include "core/parallel.h"
#include "image/camera/camera_words.h"
#include "output/stored_numbers.h"
#include "pipeline/frame_files.h"

namespace skylapse::pipeline {
namespace {

using output::SampleType;
using output::SunPolicy;

output::EnvironmentMap environment_of(const config::CameraConfig& camera) {
  if (camera.camera.projection == image::Projection::lat_long)
    return output::EnvironmentMap::lat_long;
  const bool openexr_cube = camera.camera.projection == image::Projection::cube &&
                            !camera.cube_faces_apart &&
                            camera.camera.cube_layout == image::CubeLayout::vertical_strip;
  return openexr_cube ? output::EnvironmentMap::cube : output::EnvironmentMap::none;
}

size_t bytes_of(SampleType type) {
  switch (type) {
    case SampleType::u8:
      return 1;
    case SampleType::u16:
      return 2;
    case SampleType::half_float:  // handed over as floats
    case SampleType::float32:
      break;
  }
  return sizeof(float);
}

/// Formats that cannot hold every disc, where the policy says what becomes of it.
bool obeys_sun_policy(const config::ImageOutput& output) {
  if (output.display || output.view || output.content == config::ImageContent::standard_error)
    return false;
  return output.sample_type == SampleType::half_float ||
         (output.format == "hdr" && output.sun_policy != SunPolicy::float32);
}

}  // namespace

bool leaves_disc_apart(const config::ImageOutput& output) {
  return output.content == config::ImageContent::radiance && obeys_sun_policy(output) &&
         output.sun_policy == SunPolicy::split;
}

Error at_sun_policy(const config::ImageOutput& output, Error error) {
  error.span = output.sun_policy_span.line > 0 ? output.sun_policy_span : output.path.span;
  return error;
}

std::map<std::string, double> policy_record(const output::SunPolicyRecord& policy) {
  std::map<std::string, double> record{{"scale", policy.scale},
                                       {"pixels_beyond_half", double(policy.pixels_beyond_half)},
                                       {"lost_fraction", policy.lost_fraction}};
  if (policy.policy == SunPolicy::clip && policy.pixels_beyond_half > 0)
    record["clipped_fraction"] = policy.lost_fraction;
  return record;
}

void add_light_record(const FrameSource& source, const config::ImageOutput& output, double held,
                      std::map<std::string, double>& record) {
  const TrueLight light = true_light(source.light);
  const bool has_sun = output.content == config::ImageContent::radiance && source.light.disc_shows;
  const double whole = light.sky + (has_sun ? light.sun : 0.0);
  const double apart = has_sun && leaves_disc_apart(output) ? light.sun : 0.0;
  record["horizontal_lux"] = held;
  record["true_horizontal_lux"] = whole;
  if (apart > 0) record["sun_apart_horizontal_lux"] = apart;
  if (whole > 0) record["error_percent"] = 100 * ((held + apart) / whole - 1);
}

ImageFile::ImageFile(const FrameSource& source, size_t output, const OutputView& view,
                     std::string fingerprint)
    : source_(source),
      output_(std::get<config::ImageOutput>(source.plan.job.outputs[output])),
      display_(source.displays.of(output)),
      view_(view),
      fingerprint_(std::move(fingerprint)),
      files_(plan::files_of(source.plan, source.frame, output)),
      type_(output_.sample_type) {}

bool ImageFile::needs_survey() const { return obeys_sun_policy(output_); }

bool ImageFile::needs_sky() const {
  return output_.content == config::ImageContent::sky || leaves_disc_apart(output_);
}

bool ImageFile::is_weighed() const {
  return display_ == nullptr && output_.content != config::ImageContent::standard_error;
}

const image::FrameBuffer& ImageFile::shown(const PictureStrip& strip) const {
  if (output_.content == config::ImageContent::standard_error && strip.standard_error != nullptr)
    return *strip.standard_error;
  return needs_sky() ? strip.sky : strip.scene;
}

void ImageFile::survey(const PictureStrip& strip) {
  const StageTimer timer(times_, Stage::encode);
  const image::FrameBuffer& kept = shown(strip);
  const bool whole = output_.content == config::ImageContent::radiance;
  survey_.add((whole ? strip.scene : kept).data(), kept.data(), kept.width());
}

output::FrameMetadata ImageFile::metadata() const {
  auto meta = metadata_of(source_.plan, source_.frame, source_.light, fingerprint_);
  meta.encoding =
      display_ != nullptr ? output::PixelEncoding::display : output::PixelEncoding::absolute;
  meta.display = output_.display.value_or("");
  meta.view = output_.view.value_or("");
  meta.environment = environment_of(view_.camera);
  describe_picture(source_.light, output_, view_.camera, meta);
  meta.sun_policy = policy_;
  return meta;
}

Status ImageFile::open() {
  if (needs_survey()) {
    auto decided =
        output::decide_sun_policy(survey_, output_.sun_policy, type_ == SampleType::half_float);
    if (!decided) {
      return at_sun_policy(output_, decided.error());
    }
    policy_ = *decided;
    if (policy_->policy == SunPolicy::float32 &&
        (policy_->pixels_beyond_half > 0 || survey_.underflows_half()))
      type_ = SampleType::float32;
  }
  output::EncodeRequest request;
  request.format = output_.format;
  request.width = view_.camera.camera.width;
  request.height = view_.camera.camera.height / int(files_.size());
  request.type = type_;
  request.compression = output_.compression;
  request.quality = output_.quality;
  request.attributes = output::frame_attributes(metadata());
  const auto common = request.attributes.size();
  for (size_t i = 0; i < files_.size(); ++i) {
    Part part;
    request.attributes.resize(common);
    if (files_.size() == image::kCubeFaces.size()) {
      const auto face = static_cast<image::CubeFace>(view_.faces[i]);
      request.attributes.push_back({"skylapse:cubeFace", std::string(name_of(face))});
    }
    auto file = output::StreamedFile::create(source_.folder / files_[i]);
    if (!file) return file.error();
    part.file = *std::move(file);
    const StageTimer timer(times_, Stage::encode);
    auto rows = source_.io.open_rows(request, *part.file);
    if (!rows) return failed(part, rows.error());
    part.rows = *std::move(rows);
    parts_.push_back(std::move(part));
  }
  return Done{};
}

/// The system's reason, where that is what stopped the library.
Error ImageFile::failed(const Part& part, const Error& error) const {
  const Status written = part.file->status();
  return written ? error : written.error();
}

/// Exposure and display transform, then the integers of the file.
const void* ImageFile::display_samples(const PictureStrip& strip) {
  const StageTimer timer(times_, Stage::display);
  const image::FrameBuffer& scene = shown(strip);
  values_.resize(scene.data().size());
  display_values(source_.frame, scene, *display_, values_);
  const auto width = size_t(scene.width()), rows = size_t(scene.height());
  const uint64_t seed = dither_seed(source_.frame);
  if (type_ == SampleType::u8) {
    u8_.resize(values_.size());
    color::quantise_u8(values_.data(), width, rows, seed, u8_.data(), size_t(strip.first_row));
    return u8_.data();
  }
  if (type_ != SampleType::u16) return values_.data();
  u16_.resize(values_.size());
  color::quantise_u16(values_.data(), width, rows, seed, u16_.data(), size_t(strip.first_row));
  return u16_.data();
}

/// The numbers that the file will hold, as floats, and the light they are.
const void* ImageFile::linear_samples(const PictureStrip& strip) {
  const StageTimer timer(times_, Stage::encode);
  const image::FrameBuffer& picture = shown(strip);
  const float* samples = picture.data().data();
  const bool rgbe = output_.format == "hdr";
  if (policy_ || rgbe) {
    values_ = picture.data();
    if (policy_) output::apply_sun_policy(values_, *policy_);
    if (rgbe) output::round_to_rgbe(values_);
    if (type_ == SampleType::half_float) output::round_to_half(values_);
    samples = values_.data();
  }
  if (strip.weights && is_weighed())
    strip.weights->add_irradiance(samples, 0, picture.height(), irradiance_);
  return samples;
}

Status ImageFile::write_rows(const void* samples, int first_row, int rows) {
  const StageTimer timer(times_, Stage::encode);
  const int of_part = view_.camera.camera.height / int(files_.size());
  const auto* bytes = static_cast<const std::byte*>(samples);
  const size_t row_bytes = size_t{3} * size_t(view_.camera.camera.width) * bytes_of(type_);
  for (int done = 0; done < rows;) {
    const int row = first_row + done;
    Part& part = parts_[size_t(row / of_part)];
    const int here = std::min(rows - done, of_part - row % of_part);
    if (const Status added = part.rows->add(bytes + row_bytes * size_t(done), here); !added)
      return failed(part, added.error());
    done += here;
  }
  return Done{};
}

Status ImageFile::add(const PictureStrip& strip) {
  const void* samples = display_ != nullptr ? display_samples(strip) : linear_samples(strip);
  return write_rows(samples, strip.first_row, strip.scene.height());
}

std::map<std::string, double> ImageFile::encoding_record() const {
  std::map<std::string, double> record;
  if (policy_) record = policy_record(*policy_);
  if (output_.sample_type == SampleType::half_float && display_ == nullptr)
    record["stored_bits"] = type_ == SampleType::half_float ? 16 : 32;
  if (!is_weighed() || !image::sees_upper_hemisphere(view_.camera.camera)) return record;
  const auto space = color::rgb_space_from_name(source_.plan.job.color.space);
  const glm::dvec3 xyz = color::rgb_to_xyz(*space) * irradiance_;
  const double held = xyz.y * kLuminousEfficacy / (policy_ ? policy_->scale : 1.0);
  add_light_record(source_, output_, held, record);
  return record;
}

Result<std::vector<LedgerEntry>> ImageFile::finish() {
  std::vector<LedgerEntry> entries;
  for (size_t i = 0; i < parts_.size(); ++i) {
    Part& part = parts_[i];
    {
      const StageTimer timer(times_, Stage::encode);
      if (const Status finished = part.rows->finish(); !finished)
        return failed(part, finished.error());
    }
    // What the library handed to the system meanwhile counted as encoding.
    const double written_ms = part.file->milliseconds();
    times_[Stage::encode] -= written_ms;
    const auto published = part.file->publish();
    times_[Stage::write] += part.file->milliseconds();
    if (!published) return published.error();
    LedgerEntry entry = entry_for(source_, files_[i], fingerprint_);
    entry.sha256 = published->sha256;
    entry.bytes = published->bytes;
    entry.encoding = encoding_record();
    entries.push_back(std::move(entry));
  }
  return entries;
}

}  // namespace skylapse::pipeline
