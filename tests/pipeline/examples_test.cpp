// Every example of configs/ renders, small.
#include "image/camera/cube.h"
#include "pipeline/job_fixture.h"

using namespace skylapse;
using namespace skylapse::pipeline;
using namespace skylapse::pipeline::testing;

namespace {

std::vector<std::filesystem::path> examples() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(SKYLAPSE_SOURCE_DIR) / "configs"))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// The quickest tables, and of the frames that need them a few: the examples' own settings are for
/// pictures.
std::vector<long> quick_frames(plan::Plan& plan) {
  std::vector<long> frames(plan.frames.size());
  std::iota(frames.begin(), frames.end(), 1L);
  if (plan::is_fitted(plan.model)) return frames;
  plan.job.sky.level = sky::bruneton::Level::draft;
  plan.job.sky.wavelengths = 3;
  std::vector<long> few;
  for (size_t i = 0; i < 5; ++i) few.push_back(frames[(frames.size() - 1) * i / 4]);
  few.erase(std::unique(few.begin(), few.end()), few.end());
  return few;
}

/// About 64 pixels, shape kept.
void shrink(image::Camera& c) {
  const int divisor = std::max(1, std::max(c.width, c.height) / 96);
  if (c.projection == image::Projection::cube) {
    const int face = 16, now = image::cube_face_size(c);
    c.width = c.width / now * face, c.height = c.height / now * face;
  } else {
    c.width = std::max(2, c.width / divisor), c.height = std::max(2, c.height / divisor);
  }
}

/// Shrinks all that is looked at.
void shrink(plan::Plan& plan) {
  for (auto& camera : plan.job.cameras) shrink(camera.camera);
  for (config::Output& output : plan.job.outputs) {
    if (auto* image = std::get_if<config::ImageOutput>(&output); image && image->own_view)
      shrink(image->own_view->camera);
    auto* product = std::get_if<config::ProductOutput>(&output);
    if (product == nullptr || !product->view) continue;
    shrink(product->view->camera);
    product->levels = std::min(product->levels, 3);  // faces of 16, 8 and 4 pixels
  }
}

class Examples : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(Examples, RendersSmallFromFirstToLastFrame) {
  auto job = config::load_job(GetParam().string());
  if (!job)
    for (const auto& error : job.error()) ADD_FAILURE() << format_error(error);
  ASSERT_TRUE(job.ok());
  auto plan = plan::make_plan(*std::move(job));
  if (!plan)
    for (const auto& error : plan.error()) ADD_FAILURE() << format_error(error);
  ASSERT_TRUE(plan.ok());
  shrink(*plan);
  const TemporaryFolder folder;
  RunOptions options = options_for(*plan, folder.path());
  options.frames = quick_frames(*plan);
  const auto summary = run_job(*plan, options);
  ASSERT_TRUE(summary.ok()) << format_error(summary.error());
  EXPECT_EQ(summary->rendered, long(options.frames.size()));
  EXPECT_EQ(summary->complete, options.frames.size() == plan->frames.size());
}

INSTANTIATE_TEST_SUITE_P(Configs, Examples, ::testing::ValuesIn(examples()),
                         [](const auto& info) { return info.param.stem().string(); });

TEST(ExampleConfigs, AreAtLeastTheSevenThatTheReadmeNames) { EXPECT_GE(examples().size(), 7u); }

}  // namespace
