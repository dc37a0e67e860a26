#pragma once
// The computed atmosphere of a running job: the GL context, the tables of the air in use, and from
// them what one frame needs.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gpu/context.h"
#include "plan/plan.h"
#include "sky/atmosphere_disc.h"
#include "sky/bruneton/sky_slice.h"
#include "sky/bruneton/table_cache.h"

namespace skylapse::pipeline {

/// The light of one frame's air, at 1 au.
struct FrameAtmosphere {
  sky::bruneton::SkySlice slice;
  glm::dvec3 sky_irradiance_xyz{0};         // on a level surface at the camera, without the disc
  std::optional<sky::AtmosphereDisc> disc;  // nothing while the disc is below the horizon
};

/// What was used, for the manifest.
struct AtmosphereRecord {
  struct Tables {
    std::string id;       // hash of medium and settings
    bool cached = false;  // found on disk
    double seconds = 0;   // to compute them or to read them
    int orders = 0;
    size_t bytes = 0;
  };
  gpu::ContextInfo context;
  std::vector<Tables> tables;  // in the order they were needed
};

/// Costs nothing until the first frame asks: then the context is made, and tables are read from the
/// cache or computed when a frame with another air comes along. Air that changes during the job
/// passes between few tables: a frame has a mixture of two, and its own medium.
/// Safe to use from several threads.
class AtmosphereService {
 public:
  /// `progress`: told the share of a precomputation that is done, answers whether to go on; called
  /// from one thread at a time.
  /// `cache`: where tables are kept; the standard one if not given.
  /// `plan` must outlive the service.
  AtmosphereService(const plan::Plan& plan, gpu::Backend backend,
                    std::function<bool(double)> progress = {},
                    std::optional<sky::bruneton::TableCache> cache = {});
  ~AtmosphereService();
  AtmosphereService(const AtmosphereService&) = delete;
  AtmosphereService& operator=(const AtmosphereService&) = delete;

  /// Errors: missing_backend where no GL can be had; those of the medium; GL's own.
  Result<FrameAtmosphere> of_frame(const plan::Frame& frame);

  /// The context alone, for Hosek-Wilkie on GL.
  Result<std::shared_ptr<gpu::Context>> context();

  /// Nothing while no frame has asked.
  [[nodiscard]] std::optional<AtmosphereRecord> record() const;
  /// What a reader should know, such as a cache that cannot be written.
  [[nodiscard]] std::vector<std::string> notes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace skylapse::pipeline
