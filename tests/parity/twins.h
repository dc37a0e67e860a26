#pragma once
// Media and tables that the parity tests share.
#include <memory>

#include "gpu/any_context.h"
#include "sky/bruneton/gpu_model.h"
#include "sky/bruneton/twin.h"

namespace skylapse::sky::bruneton {

/// Earth's standard air in `bands` bands.
atmosphere::Medium standard_medium(int bands);
/// Small tables of unusual sizes: none a multiple of a work group, more suns than one.
Settings odd_settings();
/// The twin's draft tables of the reference medium, made once for the whole program.
std::shared_ptr<const Tables> reference_tables();

/// The value, or a failed test and a default one.
template <class T>
T value_of(Result<T> result) {
  EXPECT_TRUE(result.ok()) << (result ? "" : result.error().message);
  return result ? std::move(result).value() : T{};
}

}  // namespace skylapse::sky::bruneton
