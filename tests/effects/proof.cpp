#include "effects/proof.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "output/image_writer.h"
#include "pipeline/frame_files.h"
#include "plan/effects/light_bounds.h"

namespace skylapse::effects_proof {
namespace {

double core_seconds_now() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

/// Greatest mean difference of a channel over a quarter of the picture.
double greatest_mean(const Picture& a, const Picture& b) {
  const int w = a.scene.width(), h = a.scene.height();
  std::array<double, 12> sums{};
  std::array<int, 4> counts{};
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const int quarter = 2 * (2 * y >= h) + (2 * x >= w);
      ++counts[quarter];
      for (int c = 0; c < 3; ++c) {
        const size_t i = (size_t(y) * w + x) * 3 + c;
        sums[3 * quarter + c] += int(a.codes[i]) - int(b.codes[i]);
      }
    }
  double most = 0;
  for (int i = 0; i < 12; ++i)
    if (counts[i / 3] > 0) most = std::max(most, std::abs(sums[i]) / counts[i / 3]);
  return most;
}

}  // namespace

Result<Picture, Diagnostics> picture_of(const std::string& scene, const std::string& effects,
                                        const plan::EffectRules& rules) {
  std::string text = scene;
  text.replace(text.find('@'), 1, effects);
  auto job = config::parse_job(text, "drawn.yaml");
  if (!job) return job.error();
  const double start = core_seconds_now();
  const auto plan = plan::make_plan(*std::move(job), rules);
  if (!plan) return plan.error();
  const plan::Frame& frame = plan->frames.front();
  pipeline::AtmosphereService atmospheres(*plan, gpu::Backend::automatic, {},
                                          sky::bruneton::TableCache({}, 0));
  pipeline::StageTimes times;
  auto rendered = pipeline::render_frame(*plan, frame, atmospheres, false, times);
  if (!rendered) return Diagnostics{rendered.error()};
  const double seconds = core_seconds_now() - start;
  const auto io = output::open_image_io();
  if (!io) return Diagnostics{io.error()};
  static const auto kDisplays = pipeline::Displays::make(**io, plan->job);
  if (!kDisplays) return Diagnostics{kDisplays.error()};
  auto codes = display_picture(frame, *rendered, *kDisplays->of(0), times);
  return Picture{std::move(rendered->scene), std::move(codes), plan::darkest_step(frame),
                 plan::decide_effects(*plan, frame), seconds};
}

std::string Change::text() const {
  return fmt::format("error {:.2g} of at most {:.2g}, codes {} (mean {:.2f}), left: {}", error,
                     bound, codes, mean_codes, left);
}

Change change_of(const Picture& without, const Picture& all) {
  Change change;
  for (const plan::EffectDecision& decision : without.decisions)
    for (const plan::EffectDecision& other : all.decisions)
      if (other.effect == decision.effect && other.on && !decision.on) {
        change.bound += decision.error_bound.value_or(0);
        change.left += (change.left.empty() ? "" : " ") + name_of(decision.effect);
      }
  for (int y = 0; y < all.scene.height(); ++y)
    for (int x = 0; x < all.scene.width(); ++x) {
      const float *a = without.scene.pixel(x, y), *b = all.scene.pixel(x, y);
      double largest = without.darkest_step, difference = 0;
      for (int c = 0; c < 3; ++c) {
        largest = std::max(largest, double(b[c]));
        // A NaN on one side is the greatest difference there is.
        const double d = std::abs(double(a[c]) - double(b[c]));
        difference = std::isnan(d) ? HUGE_VAL : std::max(difference, d);
      }
      change.error = std::max(change.error, difference / largest);
    }
  for (size_t i = 0; i < all.codes.size(); ++i)
    change.codes = std::max(change.codes, std::abs(int(without.codes[i]) - int(all.codes[i])));
  change.mean_codes = greatest_mean(without, all);
  return change;
}

}  // namespace skylapse::effects_proof
