#include "pipeline/promise_json.h"

namespace skylapse::pipeline {
namespace {

using nlohmann::ordered_json;

ordered_json outlook_json(const plan::Outlook& outlook) {
  return {{"name", outlook.name},
          {"error_bound", outlook.error},
          {"core_seconds_per_frame", outlook.core_seconds}};
}

}  // namespace

ordered_json promise_json(const plan::Plan& plan) {
  if (!plan.promise) return nullptr;
  const plan::Promise& promise = *plan.promise;
  ordered_json json;
  if (promise.accuracy) json["accuracy"] = *promise.accuracy;
  if (promise.time_budget) json["time_budget_s"] = promise.time_budget->in(second);
  json["kept"] = promise.kept;
  json["taken"] = outlook_json(promise.taken);
  json["worst_picture"] = promise.worst_picture;
  json["next_better"] = promise.next_better ? outlook_json(*promise.next_better) : nullptr;
  json["ladder"] = ordered_json::array();
  for (const plan::Outlook& outlook : promise.ladder)
    json["ladder"].push_back(outlook_json(outlook));
  return json;
}

}  // namespace skylapse::pipeline
