#pragma once
// The atmosphere on a GL context: precomputation, slices and single directions in float.
#include <functional>
#include <memory>

#include "core/result.h"
#include "gpu/context.h"
#include "sky/bruneton/query.h"
#include "sky/bruneton/sky_slice.h"
#include "sky/bruneton/tables.h"

namespace skylapse::sky::bruneton {

/// Told the share of the work that is done, 0..1, from the thread that computes; answers whether to
/// go on.
using Progress = std::function<bool(double)>;

/// The tables by compute shaders. Deterministic for one driver. Error interrupted where `progress`
/// says no.
Result<Tables> precompute(gpu::Context& context, const atmosphere::Medium& medium,
                          const Settings& settings, const Progress& progress = {});

/// What a slice is to hold.
struct SliceContent {
  bool multiple_scattering = true;  // false: single scattering only
  bool ground = true;               // light that the ground reflects
};

/// Tables on a context, ready for frames. Safe to use from several threads: calls queue.
class GpuModel {
 public:
  /// `tables` may be empty of source (single scattering only). The medium is that of the tables.
  static Result<GpuModel> create(std::shared_ptr<gpu::Context> context, const Tables& tables);

  Result<SkySlice> slice(Length camera_height, Angle sun_zenith, const SliceGrid& grid,
                         SliceContent content = {}) const;
  /// Radiance and transmittance of single directions, marched one by one.
  Result<std::vector<Answer>> answer(const std::vector<Query>& queries,
                                     SliceContent content = {}) const;

 private:
  struct State;
  explicit GpuModel(std::shared_ptr<State> state) : state_(std::move(state)) {}
  std::shared_ptr<State> state_;
};

}  // namespace skylapse::sky::bruneton
