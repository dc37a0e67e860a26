#include "plan/baseline_of_frame.h"

#include <fmt/format.h>

#include <cassert>

#include "sky/cie/sky.h"
#include "sky/preetham/sky.h"

namespace skylapse::plan {
namespace {

constexpr std::string_view kOtherModel = "use sky.model bruneton or auto";

Error refusal(std::string message, const SourceSpan& span) {
  return {ErrorCode::invalid_input, std::move(message), span, std::string(kOtherModel)};
}

Status check_frame(const Plan& plan, const Frame& frame) {
  const config::JobConfig& job = plan.job;
  const std::string name = name_of(plan.model);
  const Angle up = elevation(frame.sky.sun_apparent);
  if (up < 0 * deg)
    return refusal(
        fmt::format("at {} ({}) the sun is at {:.2f} deg, and {} ends at the horizon",
                    format_local(frame.local), job.sites[frame.site].name, up.in(deg), name),
        job.time.span);
  const Spanned<double>& turbidity = job.air.turbidity[frame.turbidity];
  const auto place = [&](Error error) {
    error.span = turbidity.span;
    error.hint += fmt::format("; or {}", kOtherModel);
    return error;
  };
  if (plan.model == config::SkyModel::preetham) {
    const auto made = sky::preetham::Model::make(turbidity.value, frame.sun.elevation);
    if (!made) return place(made.error());
  } else {
    const Status known = sky::cie::check(job.sky.cie_type, turbidity.value, frame.sun.elevation);
    if (!known) return place(known.error());
  }
  return Done{};
}

}  // namespace

Result<sky::FittedSky> baseline_of_frame(const config::JobConfig& job, config::SkyModel model,
                                         const Frame& frame) {
  assert(is_baseline(model));
  const double turbidity = job.air.turbidity[frame.turbidity].value;
  if (model == config::SkyModel::preetham)
    return sky::preetham::make_sky(turbidity, frame.sun.direction, frame.sky.sun_radius);
  return sky::cie::make_sky(job.sky.cie_type, turbidity, frame.sun.direction, frame.sky.sun_radius);
}

Status check_baseline(const Plan& plan) {
  if (!is_baseline(plan.model)) return Done{};
  for (const config::Site& site : plan.job.sites)
    if (site.position.height > kNearGround)
      return refusal(fmt::format("site '{}' is {:.0f} m high, and {} stands on the ground",
                                 site.name, site.position.height.in(metre), name_of(plan.model)),
                     site.span);
  for (const Frame& frame : plan.frames) {
    const Status known = check_frame(plan, frame);
    if (!known) return known;
  }
  return Done{};
}

}  // namespace skylapse::plan
