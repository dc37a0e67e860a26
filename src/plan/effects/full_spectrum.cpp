#include <fmt/format.h>

#include "plan/effects/calibrated_bounds.h"
#include "plan/effects/rule.h"
#include "plan/plan.h"
#include "plan/rates.h"

namespace skylapse::plan {

Verdict judge_full_spectrum(const Plan& plan, const Frame&) {
  const config::Sky& sky = plan.job.sky;
  const double seconds = rates::full_spectrum_seconds(plan);
  if (sky.wavelengths_given || sky.accuracy || sky.time_budget)
    return {
        false, fmt::format("{} wavelengths are asked for", sky.wavelengths), {}, seconds, false};
  return {false,
          fmt::format("{} wavelengths stand for {}", config::Sky{}.wavelengths, kFullSpectrum),
          kSpectrumError, seconds};
}

}  // namespace skylapse::plan
