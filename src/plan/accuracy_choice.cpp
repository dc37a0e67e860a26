#include "plan/accuracy_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

#include "plan/output_cost.h"
#include "plan/picture_scenes.h"
#include "plan/plan.h"
#include "plan/rung_cost.h"

namespace skylapse::plan {
namespace {

using config::SkyModel;

/// An error that is smaller by less than this is not a better one.
constexpr double kBetter = 0.9;

/// Two digits, never as a power of ten.
std::string percent(double share) {
  return 100 * share < 9.95 ? fmt::format("{:.2g} %", 100 * share)
                            : fmt::format("{:.0f} %", 100 * share);
}

std::string seconds_text(double s) {
  if (s < 0.01) return fmt::format("{:.2g} ms", 1000 * s);
  if (s < 1) return fmt::format("{:.0f} ms", 1000 * s);
  if (s < 120) return fmt::format("{:.1f} s", s);
  if (s < 7200) return fmt::format("{:.0f} min", s / 60);
  return fmt::format("{:.3g} h", s / 3600);
}

struct Candidate {
  Rung rung;
  Outlook outlook;
  size_t worst = 0;  // picture
};

/// Every rung that the scene admits, cheapest first.
std::vector<Candidate> candidates_of(const PromiseInputs& in, const std::vector<Picture>& pictures,
                                     const ErrorTable& table) {
  config::JobConfig free = in.job;
  free.sky.model = SkyModel::automatic;
  const bool fit_holds = choose_model(free, in.schedule, in.suns).model == SkyModel::hosek_wilkie;
  const RungCost cost(in, pictures);
  std::vector<Candidate> all;
  for (const Rung& rung : ladder()) {
    if (is_fitted(rung.model) && !fit_holds) continue;
    Candidate c{rung, {name_of(rung), 0, cost.core_seconds(rung)}};
    for (size_t i = 0; i < pictures.size(); ++i) {
      const double error = error_bound(rung, pictures[i].scene, table);
      if (error > c.outlook.error) c.outlook.error = error, c.worst = i;
    }
    all.push_back(std::move(c));
  }
  std::ranges::stable_sort(all, {}, [](const Candidate& c) { return c.outlook.core_seconds; });
  return all;
}

std::string describe(const PromiseInputs& in, const Picture& picture) {
  const ScheduledTime& time = in.schedule.times[picture.time];
  return fmt::format("{}, {}, sun at {:.1f} deg", in.job.sites[time.site].name,
                     format_local(time.local),
                     elevation(in.suns[picture.time].sun_apparent).in(deg));
}

/// The path tracer for an accuracy: core seconds of a frame on average.
double reference_seconds(const PromiseInputs& in, const std::vector<Picture>& pictures,
                         double accuracy, const ErrorTable& table) {
  double seconds = 0;
  for (const Picture& picture : pictures) {
    const PathOutlook path = path_outlook(picture.scene, table);
    const double paths = std::max(1.0, std::pow(path.deviation / accuracy, 2));
    const double pixels = picture_pixels(in.job, in.job.cameras[picture.camera]);
    seconds += pixels * (kPixelSetupSeconds + paths * path.seconds) / double(pictures.size());
  }
  return seconds + picture_seconds_of(in.job, pictures);
}

Error unreachable(const PromiseInputs& in, const Promise& promise, double reference) {
  const Spanned<double>& asked = *in.job.sky.accuracy;
  const Outlook& best = *std::ranges::min_element(promise.ladder, {}, &Outlook::error);
  return {ErrorCode::invalid_input,
          fmt::format("sky.accuracy = {} is more than tables can promise in this job: the best, "
                      "{}, is good to {} ({})",
                      percent(asked.value), best.name, percent(best.error), promise.worst_picture),
          asked.span,
          fmt::format("allow {} or more, render these frames apart, or write model: reference with "
                      "relative_error: {}, which takes about {} of one core a frame",
                      percent(std::ceil(200 * best.error) / 200), percent(asked.value),
                      seconds_text(reference))};
}

void set_next_better(Promise& promise) {
  for (const Outlook& outlook : promise.ladder)
    if (outlook.error < kBetter * promise.taken.error &&
        (!promise.next_better || outlook.core_seconds < promise.next_better->core_seconds))
      promise.next_better = outlook;
}

/// The reference for an accuracy that no table keeps.
Result<PromiseChoice> take_reference(const PromiseInputs& in, PromiseChoice choice,
                                     double seconds) {
  const double accuracy = in.job.sky.accuracy->value;
  if (seconds > kLongestReference.in(second)) return unreachable(in, choice.promise, seconds);
  choice.promise.taken = {fmt::format("reference, relative error {}", percent(accuracy)), accuracy,
                          seconds};
  choice.sky.model = SkyModel::reference;
  choice.sky.wavelengths = 32;
  choice.sky.wavelengths_given = true;
  choice.sky.paths.relative_error = accuracy;
  choice.sky.paths.samples = 1'000'000'000;
  return choice;
}

}  // namespace

std::optional<size_t> cheapest_within(const std::vector<Outlook>& ladder, double accuracy) {
  for (size_t i = 0; i < ladder.size(); ++i)
    if (ladder[i].error <= accuracy) return i;
  return {};
}

std::optional<size_t> best_within(const std::vector<Outlook>& ladder, Duration budget) {
  std::optional<size_t> best;
  for (size_t i = 0; i < ladder.size(); ++i)
    if (ladder[i].core_seconds <= budget.in(second) &&
        (!best || ladder[i].error < ladder[*best].error))
      best = i;
  return best;
}

Result<PromiseChoice> choose_rung(const PromiseInputs& in, const ErrorTable& table) {
  assert(in.job.sky.accuracy || in.job.sky.time_budget);
  const std::vector<Picture> pictures = picture_scenes(in);
  const std::vector<Candidate> candidates = candidates_of(in, pictures, table);
  PromiseChoice choice{.promise = {}, .sky = in.job.sky};
  Promise& promise = choice.promise;
  for (const Candidate& c : candidates) promise.ladder.push_back(c.outlook);
  std::optional<size_t> index;
  if (in.job.sky.accuracy) {
    promise.accuracy = in.job.sky.accuracy->value;
    index = cheapest_within(promise.ladder, *promise.accuracy);
    if (!index && !candidates.empty())
      promise.worst_picture =
          describe(in, pictures[std::ranges::min_element(candidates, {}, [](const Candidate& c) {
                                  return c.outlook.error;
                                })->worst]);
    if (!index)
      return take_reference(in, std::move(choice),
                            reference_seconds(in, pictures, *promise.accuracy, table));
  } else {
    promise.time_budget = in.job.sky.time_budget->value;
    index = best_within(promise.ladder, *promise.time_budget);
    promise.kept = index.has_value();
  }
  const size_t chosen = index.value_or(0);
  promise.taken = promise.ladder[chosen];
  if (!pictures.empty()) promise.worst_picture = describe(in, pictures[candidates[chosen].worst]);
  set_next_better(promise);
  take(candidates[chosen].rung, choice.sky);
  return choice;
}

std::string promise_text(const Promise& promise) {
  const auto outlook = [](const Outlook& o) {
    return fmt::format("{}: error at most {}, {} of one core a frame", o.name, percent(o.error),
                       seconds_text(o.core_seconds));
  };
  std::string text = promise.accuracy
                         ? fmt::format("promise: accuracy {}", percent(*promise.accuracy))
                         : fmt::format("promise: {} of one core a frame",
                                       seconds_text(promise.time_budget->in(second)));
  if (!promise.kept) text += ", which nothing keeps; the cheapest is taken";
  text += "\n  taken        " + outlook(promise.taken) + "\n";
  if (!promise.worst_picture.empty() && promise.taken.error > 0)
    text += "               greatest in " + promise.worst_picture + "\n";
  text += "  next better  " +
          (promise.next_better
               ? outlook(*promise.next_better)
               : std::string(
                     "none; model: reference knows no bound but its noise, nor one on its time")) +
          "\n";
  return text;
}

}  // namespace skylapse::plan
