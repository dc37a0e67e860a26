#include "pipeline/frame_files.h"

#include <algorithm>
#include <cassert>

#include "color/dither.h"
#include "color/exposure.h"
#include "color/rgb_space.h"
#include "core/constants.h"
#include "core/parallel.h"
#include "core/sha256.h"
#include "output/atomic_file.h"
#include "output/metadata.h"
#include "output/sun_policy.h"
#include "pipeline/fingerprint.h"
#include "pipeline/output_view.h"
#include "pipeline/products/product.h"
#include "pipeline/reference_sky.h"

namespace skylapse::pipeline {
namespace {

using output::SampleType;

/// Seed of the dither: the frame's moment, so that grain moves in time and repeats on resume.
uint64_t dither_seed(const plan::Frame& frame) {
  return uint64_t(frame.instant.utc.time_since_epoch().count()) * 2 + frame.instant.leap_second;
}

/// Exposure and display transform, all cores.
std::vector<float> display_values(const plan::Frame& frame, const image::FrameBuffer& scene,
                                  const output::DisplayTransform& display) {
  const float scale = float(color::exposure_scale_per_cd_m2(frame.ev) * kLuminousEfficacy);
  std::vector<float> values(scene.data().size());
  parallel_for_ranges(scene.pixel_count(), 1 << 14, [&](size_t begin, size_t end) {
    for (size_t i = 3 * begin; i < 3 * end; ++i) values[i] = scene.data()[i] * scale;
    display.apply(values.data() + 3 * begin, end - begin);
  });
  return values;
}

std::vector<uint8_t> quantised_u8(const plan::Frame& frame, const image::FrameBuffer& scene,
                                  const output::DisplayTransform& display) {
  const auto values = display_values(frame, scene, display);
  std::vector<uint8_t> picture(values.size());
  color::quantise_u8(values.data(), size_t(scene.width()), size_t(scene.height()),
                     dither_seed(frame), picture.data());
  return picture;
}

std::vector<uint16_t> quantised_u16(const plan::Frame& frame, const image::FrameBuffer& scene,
                                    const output::DisplayTransform& display) {
  const auto values = display_values(frame, scene, display);
  std::vector<uint16_t> picture(values.size());
  color::quantise_u16(values.data(), size_t(scene.width()), size_t(scene.height()),
                      dither_seed(frame), picture.data());
  return picture;
}

/// Where the config names the view; the output's path if it names none.
SourceSpan view_span_of(const config::Output& output) {
  const auto written_in = [](const auto& o) {
    return o.view_span.line > 0 ? o.view_span : o.path.span;
  };
  if (const auto* image = std::get_if<config::ImageOutput>(&output)) return written_in(*image);
  if (const auto* movie = std::get_if<config::MovieOutput>(&output)) return written_in(*movie);
  return config::path_of(output).span;
}

output::EnvironmentMap environment_of(const config::CameraConfig& camera) {
  if (camera.camera.projection == image::Projection::lat_long)
    return output::EnvironmentMap::lat_long;
  const bool openexr_cube = camera.camera.projection == image::Projection::cube &&
                            !camera.cube_faces_apart &&
                            camera.camera.cube_layout == image::CubeLayout::vertical_strip;
  return openexr_cube ? output::EnvironmentMap::cube : output::EnvironmentMap::none;
}

/// What every file of a frame says about itself.
output::FrameMetadata metadata_of(const plan::Plan& plan, const plan::Frame& frame,
                                  const FrameLight& light, const std::string& fingerprint) {
  const config::JobConfig& job = plan.job;
  output::FrameMetadata meta;
  meta.utc = frame.instant.utc;
  meta.utc_offset = frame.local.utc_offset;
  const auto& zone = job.sites[frame.site].zone ? job.sites[frame.site].zone : job.time.zone;
  if (zone) meta.zone = zone->value;
  meta.position = job.sites[frame.site].position;
  meta.site = job.sites[frame.site].name;
  meta.sun = frame.sky.sun_apparent;
  meta.moon = frame.sky.moon_apparent;
  meta.sun_radius = frame.sky.sun_radius;
  if (const auto space = color::rgb_space_from_name(job.color.space)) meta.space = *space;
  meta.exposure_ev100 = frame.ev;
  meta.model = plan::name_of(plan.model);
  meta.extrapolated = frame.sun.extrapolated;
  meta.fingerprint = fingerprint;
  meta.sun_illuminance = light.disc_energy.normal_irradiance.y * kLuminousEfficacy * lux;
  return meta;
}

output::FrameMetadata metadata_of_image(const FrameSource& source,
                                        const config::ImageOutput& output, bool display,
                                        const config::CameraConfig& camera,
                                        const std::string& fingerprint) {
  auto meta = metadata_of(source.plan, source.frame, source.light, fingerprint);
  meta.encoding = display ? output::PixelEncoding::display : output::PixelEncoding::absolute;
  meta.display = output.display.value_or("");
  meta.view = output.view.value_or("");
  meta.environment = environment_of(camera);
  return meta;
}

/// The pixels of one image output, before anything is given up for a file format.
struct Picture {
  image::FrameBuffer scene;
  std::optional<image::FrameBuffer> without_disc;  // for the sun policy `split`
};

Result<Picture> picture_of(const FrameLight& light, const image::Camera& camera,
                           const config::ImageOutput& output, StageTimes& times) {
  auto sky = light.picture(camera, Disc::without, times);
  if (!sky) return sky.error();
  Picture picture{*std::move(sky), {}};
  if (output.content == config::ImageContent::standard_error) {
    if (light.sky.noise) picture.scene = light.sky.noise->standard_error;
    return picture;
  }
  if (output.content == config::ImageContent::sky || !light.disc_shows) return picture;
  if (output.sun_policy == output::SunPolicy::split) picture.without_disc = picture.scene;
  const StageTimer timer(times, Stage::disc);
  sky::add_sun_disc(camera, light.disc, picture.scene);
  return picture;
}

/// The samples of an output in the type its file holds, owned here.
struct Samples {
  std::vector<uint8_t> u8;
  std::vector<uint16_t> u16;
  image::FrameBuffer linear;
  std::vector<float> display;
  const std::byte* data = nullptr;
  size_t bytes_per_row = 0;
};

Result<Samples> samples_of(const plan::Frame& frame, const Picture& rendered,
                           const config::ImageOutput& output,
                           const output::DisplayTransform* display, output::FrameMetadata& meta) {
  Samples s;
  const size_t row_samples = size_t(3) * rendered.scene.width();
  if (display != nullptr && output.sample_type == SampleType::u8) {
    s.u8 = quantised_u8(frame, rendered.scene, *display);
    s.data = reinterpret_cast<const std::byte*>(s.u8.data());
    s.bytes_per_row = row_samples;
  } else if (display != nullptr && output.sample_type == SampleType::u16) {
    s.u16 = quantised_u16(frame, rendered.scene, *display);
    s.data = reinterpret_cast<const std::byte*>(s.u16.data());
    s.bytes_per_row = 2 * row_samples;
  } else if (display != nullptr) {
    s.display = display_values(frame, rendered.scene, *display);
    s.data = reinterpret_cast<const std::byte*>(s.display.data());
    s.bytes_per_row = sizeof(float) * row_samples;
  } else {
    const image::FrameBuffer* pixels = &rendered.scene;
    if (output.sample_type == SampleType::half_float) {
      s.linear = rendered.scene;
      const auto record = output::apply_sun_policy(
          s.linear, output.sun_policy,
          rendered.without_disc ? &*rendered.without_disc : &rendered.scene);
      if (!record) return record.error();
      meta.sun_policy = *record;
      pixels = &s.linear;
    }
    s.data = reinterpret_cast<const std::byte*>(pixels->data().data());
    s.bytes_per_row = sizeof(float) * row_samples;
  }
  return s;
}

std::map<std::string, double> light_record(const FrameLight& light) {
  const auto lux_of = [](const glm::dvec3& xyz) { return xyz.y * kLuminousEfficacy; };
  return {{"sky_horizontal_lux", lux_of(light.sky.sky_irradiance_xyz)},
          {"sun_horizontal_lux", lux_of(light.disc_energy.horizontal_irradiance)},
          {"sun_normal_lux", lux_of(light.disc_energy.normal_irradiance)}};
}

std::map<std::string, double> noise_record(const FrameLight& light) {
  if (!light.sky.noise) return {};
  const auto& record = light.sky.noise->record;
  return {{"paths", double(record.paths)},
          {"mean_relative_error", record.mean_relative_error},
          {"max_relative_error", record.max_relative_error},
          {"share_of_pixels_reached", record.share_reached},
          {"sky_horizontal_relative_error", light.sky.noise->sky_irradiance_error}};
}

std::map<std::string, double> encoding_record(const output::FrameMetadata& meta) {
  if (!meta.sun_policy) return {};
  return {{"scale", meta.sun_policy->scale},
          {"pixels_beyond_half", double(meta.sun_policy->pixels_beyond_half)},
          {"lost_fraction", meta.sun_policy->lost_fraction}};
}

/// Writes a finished file and describes it for the ledger.
Result<LedgerEntry> write_and_describe(const FrameSource& source, const std::string& file,
                                       const std::string& fingerprint,
                                       std::span<const std::byte> bytes, StageTimes& times) {
  const StageTimer timer(times, Stage::write);
  const Status written = output::write_file_atomically(source.folder / file, bytes);
  if (!written) return written.error();
  LedgerEntry entry;
  entry.path = file;
  entry.fingerprint = fingerprint;
  entry.sha256 = sha256_hex(bytes);
  entry.bytes = bytes.size();
  entry.light = light_record(source.light);
  entry.noise = noise_record(source.light);
  return entry;
}

}  // namespace

Result<Displays> Displays::make(const output::ImageIo& io, const config::JobConfig& job) {
  Displays displays;
  std::map<std::pair<std::string, std::string>, std::shared_ptr<const output::DisplayTransform>>
      made;
  for (const auto& output : job.outputs) {
    const auto* image = std::get_if<config::ImageOutput>(&output);
    const auto* movie = std::get_if<config::MovieOutput>(&output);
    std::pair<std::optional<std::string>, std::optional<std::string>> names;
    if (image != nullptr) names = {image->display, image->view};
    if (movie != nullptr) names = {movie->display, movie->view};
    if (movie == nullptr && !names.first && !names.second) {
      displays.by_output_.push_back(nullptr);
      continue;
    }
    const auto key = std::pair(names.first.value_or(""), names.second.value_or(""));
    auto& transform = made[key];
    if (!transform) {
      auto fresh = io.display({color_config_file(job), job.color.space, key.first, key.second});
      if (!fresh) {
        Error error = fresh.error();
        error.span = view_span_of(output);
        return error;
      }
      transform = std::move(*fresh);
    }
    displays.by_output_.push_back(transform);
  }
  return displays;
}

const output::DisplayTransform* Displays::of(size_t output) const {
  return by_output_[output].get();
}

std::vector<uint8_t> display_picture(const plan::Frame& frame, const RenderedFrame& rendered,
                                     const output::DisplayTransform& display, StageTimes& times) {
  const StageTimer timer(times, Stage::display);
  return quantised_u8(frame, rendered.scene, display);
}

Result<std::vector<LedgerEntry>> write_image_output(const FrameSource& source, size_t index,
                                                    const std::string& fingerprint,
                                                    StageTimes& times) {
  const auto& output = std::get<config::ImageOutput>(source.plan.job.outputs[index]);
  const output::DisplayTransform* display = source.displays.of(index);
  const OutputView view = view_of_output(source.plan, source.frame, output);
  auto meta = metadata_of_image(source, output, display != nullptr, view.camera, fingerprint);
  const auto picture = picture_of(source.light, view.camera.camera, output, times);
  if (!picture) return picture.error();
  Result<Samples> samples = [&] {
    const StageTimer timer(times, Stage::display);
    return samples_of(source.frame, *picture, output, display, meta);
  }();
  if (!samples) {
    Error error = samples.error();
    error.span = output.sun_policy_span.line > 0 ? output.sun_policy_span : output.path.span;
    return error;
  }
  const auto files = plan::files_of(source.plan, source.frame, index);
  output::EncodeRequest request;
  request.format = output.format;
  request.width = picture->scene.width();
  request.height = picture->scene.height() / int(files.size());
  request.type = output.sample_type;
  request.compression = output.compression;
  request.quality = output.quality;
  request.attributes = output::frame_attributes(meta);

  std::vector<LedgerEntry> entries;
  for (size_t part = 0; part < files.size(); ++part) {
    const size_t face = files.size() == 1 ? 0 : size_t(view.faces[part]);
    request.pixels = samples->data + samples->bytes_per_row * size_t(request.height) * face;
    Result<std::vector<std::byte>> bytes = [&] {
      const StageTimer timer(times, Stage::encode);
      return source.io.encode(request);
    }();
    if (!bytes) return bytes.error();
    auto entry = write_and_describe(source, files[part], fingerprint, *bytes, times);
    if (!entry) return entry.error();
    entry->encoding = encoding_record(meta);
    entries.push_back(*std::move(entry));
  }
  return entries;
}

Result<std::vector<LedgerEntry>> write_product(const FrameSource& source, size_t index,
                                               const std::string& fingerprint, StageTimes& times) {
  const auto& output = std::get<config::ProductOutput>(source.plan.job.outputs[index]);
  const auto files = plan::files_of(source.plan, source.frame, index);
  const ProductRequest request{
      source.plan,  source.frame, output,
      source.light, source.io,    metadata_of(source.plan, source.frame, source.light, fingerprint),
      files};
  const auto made = make_product(request, times);
  if (!made) {
    Error error = made.error();
    if (error.span.line == 0) error.span = output.path.span;
    return error;
  }
  assert(made->size() == files.size());
  std::vector<LedgerEntry> entries;
  for (size_t i = 0; i < files.size(); ++i) {
    auto entry = write_and_describe(source, files[i], fingerprint, (*made)[i].bytes, times);
    if (!entry) return entry.error();
    entry->encoding = (*made)[i].encoding;
    entries.push_back(*std::move(entry));
  }
  return entries;
}

}  // namespace skylapse::pipeline
