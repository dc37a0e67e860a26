#pragma once
// Items on their way through three steps, several at once, through oneTBB.
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>

namespace skylapse {

enum class FinishOrder { as_made, as_done };

namespace detail {
/// run_pipeline for items whose type is not known; null ends the items.
void run_pipeline(size_t in_flight, const std::function<std::shared_ptr<void>()>& next,
                  const std::function<void(void*)>& work, const std::function<void(void*)>& finish,
                  FinishOrder order);
}  // namespace detail

/// `next` makes items one after another until it has none, `work` runs on any number of threads,
/// `finish` on one at a time, in the order of `next` if asked. At most `in_flight` items exist at
/// once. None of the three may throw.
template <class Item>
void run_pipeline(size_t in_flight, const std::function<std::optional<Item>()>& next,
                  const std::function<void(Item&)>& work, const std::function<void(Item&)>& finish,
                  FinishOrder order) {
  detail::run_pipeline(
      in_flight,
      [&]() -> std::shared_ptr<void> {
        auto item = next();
        return item ? std::make_shared<Item>(*std::move(item)) : nullptr;
      },
      [&](void* item) { work(*static_cast<Item*>(item)); },
      [&](void* item) { finish(*static_cast<Item*>(item)); }, order);
}

}  // namespace skylapse
