#pragma once
#include <nlohmann/json.hpp>

#include "plan/plan.h"

namespace skylapse::pipeline {

/// What sky.accuracy or sky.time_budget led to, for the manifest and for `plan --json`; null where
/// the config asks for neither.
nlohmann::ordered_json promise_json(const plan::Plan& plan);

}  // namespace skylapse::pipeline
