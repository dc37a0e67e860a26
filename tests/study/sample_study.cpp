#include "study/sample_study.h"

#include "color/rgb_space.h"

namespace skylapse::study {
namespace {

/// Bluer and darker towards the zenith.
glm::dvec3 sky_at(const Direction<Enu>& toward) {
  const double height = std::max(0.0, toward.z());
  return glm::dvec3(10, 11, 16) * (1.5 - height) + glm::dvec3(0, 0, 4 * height);
}

StudyScene sample_scene(const std::string& id, Angle sun_elevation) {
  StudyScene scene;
  scene.id = id, scene.title = "Scene " + id;
  scene.geometry = {enu_direction(200 * deg, sun_elevation), 0 * deg};
  scene.sun_elevation = sun_elevation;
  scene.instant = "2026-06-21T12:00:00Z";
  scene.points = sample_points(scene.geometry, Sampling::quick);
  scene.exposure_ev = 14;
  for (const SamplePoint& p : scene.points)
    scene.truth.radiance.push_back({sky_at(p.toward), 0.001 * sky_at(p.toward)});
  return scene;
}

}  // namespace

Measurement sample_rung(const StudyScene& scene, const std::string& id, double error, double ms) {
  Measurement m;
  m.rung.id = id, m.rung.label = "Rung " + id, m.rung.group = "model";
  m.rung.setting = "sky.model=" + id;
  const image::Camera camera = study_camera(scene.geometry.sun);
  m.picture = image::FrameBuffer(camera.width, camera.height);
  const glm::dmat3& to_rgb = color::xyz_to_rgb(color::RgbSpace::rec709);
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const auto toward = *image::direction_at(camera, {x + 0.5, y + 0.5});
      const glm::dvec3 rgb = to_rgb * sky_at(toward) * (1 + error);
      for (int c = 0; c < 3; ++c) m.picture.pixel(x, y)[c] = float(rgb[c]);
    }
  std::vector<TrueRadiance> truth = mirrored(scene.truth.radiance);
  m.errors = sky_errors(directions_of(scene.points, scene.geometry, MapSize::large),
                        pixels_of(scene.points, m.picture, MapSize::large,
                                  color::rgb_to_xyz(color::RgbSpace::rec709)),
                        truth, scene.geometry);
  m.timing.once_ms = {ms / 2, ms / 2, ms}, m.timing.pixels_ms = {ms / 2, ms / 2, ms};
  m.timing.core_ms = {ms, ms, 2 * ms}, m.timing.first_ms = 10 * ms;
  m.irradiance = error, m.ev = 14;
  return m;
}

StudyResult sample_study() {
  StudyResult study;
  study.machine = this_machine();
  study.date = "2026-06-21 12:00 UTC", study.command = "skylapse study --output <out> & more";
  for (const auto& [id, sun] : {std::pair("noon", 60 * deg), std::pair("dusk, low", 4 * deg)}) {
    SceneResult scene{sample_scene(id, sun), {}};
    scene.rungs.push_back(sample_rung(scene.scene, "coarse", 0.30, 2));
    scene.rungs.push_back(sample_rung(scene.scene, "bruneton", 0.01, 40));
    scene.rungs.push_back(sample_rung(scene.scene, "middle", 0.04, 10));
    scene.rungs.back().rung.group = "level";  // which has a panel beside the base
    scene.rungs.push_back(sample_rung(scene.scene, "wasteful", 0.05, 100));
    Measurement skipped;
    skipped.rung.id = skipped.rung.label = "absent", skipped.rung.group = "model";
    skipped.skipped = "needs \"another\" sky, really";
    scene.rungs.push_back(skipped);
    study.scenes.push_back(std::move(scene));
  }
  return study;
}

}  // namespace skylapse::study
