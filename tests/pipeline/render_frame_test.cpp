#include "pipeline/render_frame.h"

#include <cmath>

#include "core/constants.h"
#include "image/irradiance.h"
#include "pipeline/job_fixture.h"

using namespace skylapse;
using namespace skylapse::pipeline;
using namespace skylapse::pipeline::testing;

namespace {

std::string scene(const std::string& time, const std::string& camera,
                  const std::string& more = "") {
  const bool has_sky = more.find("sky:") != std::string::npos;
  return "location: {name: Prague, latitude: 50.0755, longitude: 14.4378, height: 235 m}\n"
         "time: {zone: Europe/Prague, date: 2026-06-21, " +
         time + "}\ncamera: {" + camera + "}\n" + (has_sky ? "" : "sky: {model: hosek-wilkie}\n") +
         more + "\noutputs: [{image: \"p.####.exr\"}]\n";
}

RenderedFrame render(const plan::Plan& plan, size_t frame) {
  StageTimes times;
  AtmosphereService atmospheres(plan, gpu::Backend::automatic);
  auto rendered = render_frame(plan, plan.frames[frame], atmospheres, false, times);
  EXPECT_FALSE(atmospheres.record()) << "Hosek-Wilkie needs no GL";
  EXPECT_TRUE(rendered.ok());
  return *std::move(rendered);
}

double luminance(const float* rgb) {  // Rec. 709 weights (ITU-R BT.709-6)
  return kLuminousEfficacy * (0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]);
}

TEST(RenderFrame, TheSunsPixelIsWhereTheEphemerisPutsTheSun) {
  const auto plan = plan_of_text(
      scene("at: ['09:00', solar_noon, '17:00']", "projection: lat-long, size: 720x360"));
  for (size_t f = 0; f < plan.frames.size(); ++f) {
    const auto frame = render(plan, f);
    int best_x = 0, best_y = 0;
    for (int y = 0; y < 360; ++y)
      for (int x = 0; x < 720; ++x)
        if (luminance(frame.scene.pixel(x, y)) > luminance(frame.scene.pixel(best_x, best_y)))
          best_x = x, best_y = y;
    const auto seen = image::direction_at(plan.job.cameras[0].camera, {best_x + 0.5, best_y + 0.5});
    // A half-degree pixel: the centre is at most 0.36 deg away.
    EXPECT_LT(separation(*seen, plan.frames[f].sky.sun_apparent).in(deg), 0.36);
  }
}

TEST(RenderFrame, TheImageHoldsTheModelsIrradiance) {
  const auto plan =
      plan_of_text(scene("at: ['09:00', solar_noon]", "projection: lat-long, size: 1024x512"));
  for (size_t f = 0; f < plan.frames.size(); ++f) {
    const auto frame = render(plan, f);
    const glm::dvec3 rgb = image::image_irradiance(plan.job.cameras[0].camera, frame.scene);
    const double seen = 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z;
    const double expected = frame.sky_irradiance_xyz.y + frame.sun_irradiance_xyz.y;
    EXPECT_NEAR(seen / expected, 1, 0.005);
  }
}

TEST(RenderFrame, NoPixelOfAWholeDayIsNegativeOrNan) {
  const auto plan = plan_of_text(
      scene("from: '00:00', to: '24:00', step: 30 min",
            "projection: fisheye, look_at: {azimuth: 0 deg, elevation: 90 deg}, fov: 200 deg, "
            "size: 64x64",
            "air: {turbidity: [1, 10], ground_albedo: [0, 1]}"));
  for (size_t f = 0; f < plan.frames.size(); ++f) {
    const auto frame = render(plan, f);
    for (const float v : frame.scene.data()) {
      ASSERT_TRUE(std::isfinite(v)) << "frame " << f;
      ASSERT_GE(v, 0) << "frame " << f;
    }
  }
}

TEST(RenderFrame, BrightnessNeverJumpsFromMinuteToMinute) {
  // The zenith through sunset: twilight loses at most 1.8 stops a degree, a minute is 0.2 deg.
  const auto plan = plan_of_text(
      scene("from: sunset - 30 min, to: sunset + 90 min, step: 1 min",
            "projection: fisheye, look_at: {azimuth: 0 deg, elevation: 90 deg}, fov: 90 deg, "
            "size: 9x9",
            "sky: {model: hosek-wilkie, sun_disc: off}"));
  double last = 0;
  for (size_t f = 0; f < plan.frames.size(); ++f) {
    const auto frame = render(plan, f);
    const double now = luminance(frame.scene.pixel(4, 4));
    ASSERT_GT(now, 0);
    if (f > 0) {
      EXPECT_LT(std::abs(std::log2(now / last)), 0.4) << "frame " << f;
    }
    last = now;
  }
}

TEST(RenderFrame, OnePixelWillDo) {
  const auto plan = plan_of_text(
      scene("at: [solar_noon]",
            "projection: perspective, look_at: {azimuth: 180 deg, elevation: 45 deg}, fov: 60 deg, "
            "size: 1x1"));
  const auto frame = render(plan, 0);
  EXPECT_GT(luminance(frame.scene.pixel(0, 0)), 100);
}

}  // namespace
