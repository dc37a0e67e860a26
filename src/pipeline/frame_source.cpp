#include "pipeline/frame_source.h"

#include <array>
#include <utility>

#include "color/rgb_space.h"
#include "core/constants.h"
#include "image/camera/camera_words.h"
#include "image/orientation.h"
#include "pipeline/image_file.h"
#include "pipeline/reference_sky.h"

namespace skylapse::pipeline {
namespace {

double lux_of(const glm::dvec3& xyz) { return xyz.y * kLuminousEfficacy; }

std::map<std::string, double> noise_record(const FrameLight& light) {
  if (!light.sky.noise) return {};
  const auto& record = light.sky.noise->record;
  return {{"paths", double(record.paths)},
          {"mean_relative_error", record.mean_relative_error},
          {"max_relative_error", record.max_relative_error},
          {"share_of_pixels_reached", record.share_reached},
          {"sky_horizontal_relative_error", light.sky.noise->sky_irradiance_error}};
}

output::PictureContent content_of(const FrameLight& light, const config::ImageOutput& output) {
  if (output.content == config::ImageContent::standard_error)
    return output::PictureContent::standard_error;
  // A disc that the job has switched off is missing too; one below the horizon is not.
  const bool hidden = !light.disc_shows && light.disc_energy.normal_irradiance.y > 0;
  return output.content == config::ImageContent::sky || leaves_disc_apart(output) || hidden
             ? output::PictureContent::sky_without_disc
             : output::PictureContent::radiance;
}

}  // namespace

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
  meta.sun_illuminance = lux_of(light.disc_energy.normal_irradiance) * lux;
  return meta;
}

void describe_picture(const FrameLight& light, const config::ImageOutput& output,
                      const config::CameraConfig& camera, output::FrameMetadata& meta) {
  meta.content = content_of(light, output);
  meta.disc_treated = output.content == config::ImageContent::radiance && light.disc_shows;
  const image::Projection projection = camera.camera.projection;
  meta.projection = image::name_of(projection);
  if (output.orientation) meta.orientation = image::name_of(*output.orientation);
  const image::Look look = image::look_of(camera.camera.camera_to_enu);
  if (image::stands_upright(projection))
    meta.heading = look.azimuth;
  else
    meta.look = look;
  if (!image::sees_whole_sphere(projection)) meta.field_of_view = camera.camera.field_of_view;
  // KTX 2 holds six images, whatever the layout.
  if (projection == image::Projection::cube && output.format != "ktx2")
    meta.cube_layout = std::string(camera.cube_faces_apart ? image::kFacesApart
                                                           : name_of(camera.camera.cube_layout));
}

LedgerEntry entry_for(const FrameSource& source, std::string file, std::string fingerprint) {
  LedgerEntry entry;
  entry.path = std::move(file);
  entry.fingerprint = std::move(fingerprint);
  const TrueLight light = true_light(source.light);
  entry.light = {{"sky_horizontal_lux", light.sky},
                 {"sun_horizontal_lux", light.sun},
                 {"sun_normal_lux", lux_of(source.light.disc_energy.normal_irradiance)}};
  entry.noise = noise_record(source.light);
  return entry;
}

TrueLight true_light(const FrameLight& light) {
  return {lux_of(light.sky.sky_irradiance_xyz), lux_of(light.disc_energy.horizontal_irradiance)};
}

}  // namespace skylapse::pipeline
