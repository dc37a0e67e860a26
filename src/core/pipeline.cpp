#include "core/pipeline.h"

#include <tbb/parallel_pipeline.h>

#include "core/thread_order.h"

namespace skylapse::detail {
namespace {

struct Token {
  std::shared_ptr<void> item;
  Moment done;  // with the step before
};

struct Steps {
  const std::function<std::shared_ptr<void>()>& next;
  const std::function<void(void*)>& work;
  const std::function<void(void*)>& finish;
  Moment begun, ended;              // the whole
  Moment after_next, after_finish;  // one item of the steps that take one at a time
};

[[gnu::noinline]] Token* take_next(Steps& steps) {
  steps.begun.passed();
  steps.after_next.passed();
  auto item = steps.next();
  Token* token = item ? new Token{std::move(item), {}} : nullptr;
  if (token != nullptr) token->done.reached();
  steps.after_next.reached();
  if (token == nullptr) steps.ended.reached();
  return token;
}

[[gnu::noinline]] void work_on(Steps& steps, Token* token) {
  steps.begun.passed();
  token->done.passed();
  steps.work(token->item.get());
  token->done.reached();
}

[[gnu::noinline]] void finish_one(Steps& steps, Token* token) {
  steps.begun.passed();
  token->done.passed();
  steps.after_finish.passed();
  steps.finish(token->item.get());
  delete token;
  steps.after_finish.reached();
  steps.ended.reached();
}

}  // namespace

void run_pipeline(size_t in_flight, const std::function<std::shared_ptr<void>()>& next,
                  const std::function<void(void*)>& work, const std::function<void(void*)>& finish,
                  FinishOrder order) {
  Steps steps{next, work, finish, {}, {}, {}, {}};
  steps.begun.reached();
  const auto mode = order == FinishOrder::as_made ? tbb::filter_mode::serial_in_order
                                                  : tbb::filter_mode::serial_out_of_order;
  tbb::parallel_pipeline(
      in_flight,
      tbb::make_filter<void, Token*>(tbb::filter_mode::serial_in_order,
                                     [&steps](tbb::flow_control& control) SKYLAPSE_UNWATCHED {
                                       Token* token = take_next(steps);
                                       if (token == nullptr) control.stop();
                                       return token;
                                     }) &
          tbb::make_filter<Token*, Token*>(tbb::filter_mode::parallel,
                                           [&steps](Token* token) SKYLAPSE_UNWATCHED {
                                             work_on(steps, token);
                                             return token;
                                           }) &
          tbb::make_filter<Token*, void>(
              mode, [&steps](Token* token) SKYLAPSE_UNWATCHED { finish_one(steps, token); }));
  steps.ended.passed();
}

}  // namespace skylapse::detail
