#pragma once
// The atmosphere on a GL context: precomputation, slices and single directions in float.
#include <memory>
#include <optional>

#include "core/result.h"
#include "gpu/context.h"
#include "sky/bruneton/query.h"
#include "sky/bruneton/sky_slice.h"
#include "sky/bruneton/tables.h"
#include "sky/bruneton/twin.h"

namespace skylapse::sky::bruneton {

/// The tables by compute shaders. Deterministic for one driver. Error interrupted where `progress`
/// says no.
Result<Tables> precompute(gpu::Context& context, const atmosphere::Medium& medium,
                          const Settings& settings, const Progress& progress = {});

/// What a slice is to hold.
struct SliceContent {
  bool multiple_scattering = true;  // false: single scattering only
  bool ground = true;               // light that the ground reflects
  /// False: the ground as if no air lay before it; below the horizon nothing else shines.
  bool aerial_perspective = true;
  std::optional<SliceWindow> window{};  // the nodes that are wanted; nothing: all
};

/// How a model stores and marches.
struct ModelOptions {
  int samples = 16;  // Gauss nodes of each piece of a view ray, 1..64
  /// Tables in half floats: half the memory; error in half_source.h. The tables' own numbers are
  /// computed in float either way.
  bool half_source = false;
};

/// Tables on a context, ready for frames. Safe to use from several threads: calls queue.
class GpuModel {
 public:
  /// `tables` may be empty of source (single scattering only). The medium is that of the tables.
  static Result<GpuModel> create(std::shared_ptr<gpu::Context> context, const Tables& tables,
                                 ModelOptions options = {});

  Result<SkySlice> slice(Length camera_height, Angle sun_zenith, const SliceGrid& grid,
                         SliceContent content = {}) const;
  /// Radiance and transmittance of single directions, marched one by one. Of `content` the switches
  /// for multiple scattering and ground count.
  Result<std::vector<Answer>> answer(const std::vector<Query>& queries,
                                     SliceContent content = {}) const;

 private:
  struct State;
  explicit GpuModel(std::shared_ptr<State> state) : state_(std::move(state)) {}
  std::shared_ptr<State> state_;
};

}  // namespace skylapse::sky::bruneton
