#include "pipeline/frame_files.h"

#include <algorithm>

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

output::FrameMetadata metadata_of(const plan::Plan& plan, const plan::Frame& frame,
                                  const config::ImageOutput& output, bool display,
                                  const std::string& fingerprint, const RenderedFrame& rendered) {
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
  meta.encoding = display ? output::PixelEncoding::display : output::PixelEncoding::absolute;
  meta.display = output.display.value_or("");
  meta.view = output.view.value_or("");
  meta.environment = environment_of(job.cameras[frame.camera]);
  meta.exposure_ev100 = frame.ev;
  meta.model = plan::name_of(plan.model);
  meta.extrapolated = frame.sun.extrapolated;
  meta.fingerprint = fingerprint;
  meta.sun_illuminance = rendered.sun_normal_irradiance_xyz.y * kLuminousEfficacy * lux;
  return meta;
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

Result<Samples> samples_of(const plan::Frame& frame, const RenderedFrame& rendered,
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
    const bool errors = output.content == config::ImageContent::standard_error && rendered.noise;
    const image::FrameBuffer* pixels = errors ? &rendered.noise->standard_error : &rendered.scene;
    if (!errors && output.sample_type == SampleType::half_float) {
      s.linear = rendered.scene;
      const auto record = output::apply_sun_policy(
          s.linear, output.sun_policy,
          rendered.scene_without_disc ? &*rendered.scene_without_disc : nullptr);
      if (!record) return record.error();
      meta.sun_policy = *record;
      pixels = &s.linear;
    }
    s.data = reinterpret_cast<const std::byte*>(pixels->data().data());
    s.bytes_per_row = sizeof(float) * row_samples;
  }
  return s;
}

std::map<std::string, double> light_record(const RenderedFrame& rendered) {
  const auto lux_of = [](const glm::dvec3& xyz) { return xyz.y * kLuminousEfficacy; };
  return {{"sky_horizontal_lux", lux_of(rendered.sky_irradiance_xyz)},
          {"sun_horizontal_lux", lux_of(rendered.sun_irradiance_xyz)},
          {"sun_normal_lux", lux_of(rendered.sun_normal_irradiance_xyz)}};
}

std::map<std::string, double> noise_record(const RenderedFrame& rendered) {
  if (!rendered.noise) return {};
  const auto& record = rendered.noise->record;
  return {{"paths", double(record.paths)},
          {"mean_relative_error", record.mean_relative_error},
          {"max_relative_error", record.max_relative_error},
          {"share_of_pixels_reached", record.share_reached},
          {"sky_horizontal_relative_error", rendered.noise->sky_irradiance_error}};
}

std::map<std::string, double> encoding_record(const output::FrameMetadata& meta) {
  if (!meta.sun_policy) return {};
  return {{"scale", meta.sun_policy->scale},
          {"pixels_beyond_half", double(meta.sun_policy->pixels_beyond_half)},
          {"lost_fraction", meta.sun_policy->lost_fraction}};
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

Result<std::vector<LedgerEntry>> write_image_output(
    const output::ImageIo& io, const plan::Plan& plan, const plan::Frame& frame,
    const RenderedFrame& rendered, size_t index, const Displays& displays,
    const std::filesystem::path& folder, const std::string& fingerprint, StageTimes& times) {
  const auto& output = std::get<config::ImageOutput>(plan.job.outputs[index]);
  const output::DisplayTransform* display = displays.of(index);
  auto meta = metadata_of(plan, frame, output, display != nullptr, fingerprint, rendered);
  Result<Samples> samples = [&] {
    const StageTimer timer(times, Stage::display);
    return samples_of(frame, rendered, output, display, meta);
  }();
  if (!samples) {
    Error error = samples.error();
    error.span = output.sun_policy_span.line > 0 ? output.sun_policy_span : output.path.span;
    return error;
  }
  const auto files = plan::files_of(plan, frame, index);
  output::EncodeRequest request;
  request.format = output.format;
  request.width = rendered.scene.width();
  request.height = rendered.scene.height() / int(files.size());
  request.type = output.sample_type;
  request.compression = output.compression;
  request.quality = output.quality;
  request.attributes = output::frame_attributes(meta);

  std::vector<LedgerEntry> entries;
  for (size_t part = 0; part < files.size(); ++part) {
    request.pixels = samples->data + samples->bytes_per_row * size_t(request.height) * part;
    StageTimes file_times;
    Result<std::vector<std::byte>> bytes = [&] {
      const StageTimer timer(file_times, Stage::encode);
      return io.encode(request);
    }();
    if (!bytes) return bytes.error();
    {
      const StageTimer timer(file_times, Stage::write);
      const Status written = output::write_file_atomically(folder / files[part], *bytes);
      if (!written) return written.error();
    }
    times += file_times;
    entries.push_back({files[part],
                       fingerprint,
                       sha256_hex(*bytes),
                       bytes->size(),
                       {},
                       encoding_record(meta),
                       light_record(rendered),
                       noise_record(rendered)});
  }
  return entries;
}

}  // namespace skylapse::pipeline
