// The path tracer and the baselines as models of a job.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/parallel.h"
#include "job_fixture.h"
#include "output/image_writer.h"
#include "pipeline/render_frame.h"

namespace skylapse::pipeline {
namespace {

using testing::options_for;
using testing::plan_of_text;

std::string scene(const std::string& sky, const std::string& outputs,
                  const std::string& time = "at: [09:00, 21:30]") {
  return "location: {name: Prague, latitude: 50.0755, longitude: 14.4378, height: 235 m}\n"
         "time: {zone: Europe/Prague, date: 2026-06-21, " +
         time + "}\ncamera: {projection: fisheye, size: 8x8}\nsky: {" + sky + "}\noutputs: [" +
         outputs + "]\n";
}

const std::string kReference = "model: reference, samples: 24, wavelengths: 3";

image::FrameBuffer pixels(const std::filesystem::path& file) {
  const auto decoded = (*output::open_image_io())->decode(file.string());
  EXPECT_TRUE(decoded.ok());
  return decoded ? decoded->pixels : image::FrameBuffer(1, 1);
}

TEST(ReferenceJob, GivesTheSameBytesOnAnyNumberOfThreads) {
  const auto plan = plan_of_text(
      scene(kReference, "{image: a.####.exr}, {image: e.####.exr, content: standard-error}"));
  const TemporaryFolder one, two;
  for (const auto& [folder, jobs] : {std::pair{&one, 1}, {&two, 2}}) {
    RunOptions options = options_for(plan, folder->path());
    options.jobs = jobs;
    const auto done = run_job(plan, options);
    ASSERT_TRUE(done.ok());
    EXPECT_TRUE(done->complete);
  }
  EXPECT_EQ(testing::hashes(one.path()).size(), 4u);
  EXPECT_EQ(testing::hashes(one.path()), testing::hashes(two.path()));
}

TEST(ReferenceJob, WritesItsStandardErrorsAsAnImageAndInTheManifest) {
  const auto plan = plan_of_text(
      scene(kReference, "{image: a.exr}, {image: e.exr, content: standard-error}", "at: 09:00"));
  const TemporaryFolder folder;
  ASSERT_TRUE(run_job(plan, options_for(plan, folder.path())).ok());
  const auto value = pixels(folder.path() / "a.exr"), error = pixels(folder.path() / "e.exr");
  EXPECT_GT(error.pixel(4, 4)[1], 0);
  EXPECT_LT(error.pixel(4, 4)[1], 0.5 * value.pixel(4, 4)[1]);
  EXPECT_EQ(error.pixel(0, 0)[1], 0) << "outside the circle";
  const auto manifest = nlohmann::json::parse(std::ifstream(folder.path() / "manifest.json"));
  const auto& noise = manifest.at("frames").at(0).at("noise");
  EXPECT_GT(noise.at("paths").get<double>(), 24 * 40);
  EXPECT_GT(noise.at("mean_relative_error").get<double>(), 0.01);
  EXPECT_EQ(noise.at("share_of_pixels_reached"), 1);
  EXPECT_EQ(manifest.at("atmosphere").at("samples"), 24);
}

TEST(ReferenceJob, FramesHaveNoiseOfTheirOwnAndSeedsAreObeyed) {
  const auto plan = plan_of_text(scene(kReference, "{image: a.####.exr}"));
  EXPECT_NE(reference_options(plan, plan.frames[0]).seed,
            reference_options(plan, plan.frames[1]).seed);
  const auto other = plan_of_text(scene(kReference + ", seed: 2", "{image: a.####.exr}"));
  EXPECT_NE(reference_options(plan, plan.frames[0]).seed,
            reference_options(other, other.frames[0]).seed);
}

TEST(ReferenceJob, StopsInTheMiddleOfAFrame) {
  const auto plan = plan_of_text(scene(kReference, "{image: a.####.exr}"));
  AtmosphereService atmospheres(plan, gpu::Backend::automatic);
  StageTimes times;
  const auto rendered = render_frame(plan, plan.frames[0], atmospheres, false, times,
                                     [](double share) { return share < 0.2; });
  ASSERT_FALSE(rendered.ok());
  EXPECT_EQ(rendered.error().code, ErrorCode::interrupted);
}

TEST(BaselineJob, RendersSkySunAndGround) {
  for (const std::string model : {"preetham", "cie"}) {
    const auto plan = plan_of_text(scene("model: " + model, "{image: a.exr}", "at: 13:00"));
    AtmosphereService atmospheres(plan, gpu::Backend::automatic);
    StageTimes times;
    const auto rendered = render_frame(plan, plan.frames[0], atmospheres, false, times);
    ASSERT_TRUE(rendered.ok()) << model;
    EXPECT_FALSE(rendered->noise.has_value());
    const double sky = 683 * rendered->sky_irradiance_xyz.y;
    EXPECT_GT(sky, 5e3);
    EXPECT_LT(sky, 4e4);
    EXPECT_GT(683 * rendered->sun_normal_irradiance_xyz.y, 7e4);
    EXPECT_GT(rendered->scene.pixel(4, 4)[1], 0);
  }
}

}  // namespace
}  // namespace skylapse::pipeline
