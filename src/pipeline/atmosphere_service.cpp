#include "pipeline/atmosphere_service.h"

#include <algorithm>
#include <chrono>
#include <list>
#include <mutex>
#include <thread>

#include "core/sha256.h"
#include "pipeline/disc_of_frame.h"
#include "plan/atmosphere_of_frame.h"
#include "plan/effect_planner.h"
#include "plan/table_settings.h"
#include "sky/bruneton/gpu_model.h"
#include "sky/bruneton/slice_irradiance.h"
#include "sky/bruneton/slice_refine.h"
#include "sky/bruneton/slice_window.h"
#include "sky/bruneton/twin.h"

namespace skylapse::pipeline {
namespace {

using sky::atmosphere::Medium;
using sky::bruneton::GpuModel;
using sky::bruneton::Settings;
using sky::bruneton::SkySlice;
using sky::bruneton::SliceContent;
using sky::bruneton::SliceGrid;
using sky::bruneton::Tables;
using sky::bruneton::Twin;

/// A medium ready for frames: on the context, or all on the processor; and in double for the
/// transmittance of the disc.
struct Model {
  std::shared_ptr<const GpuModel> gpu;  // null: `twin` makes the slices
  std::shared_ptr<const Twin> twin;
  int steps = 0;

  [[nodiscard]] Result<SkySlice> slice(Length height, Angle sun_zenith, const SliceGrid& grid,
                                       const SliceContent& content) const {
    if (gpu) return gpu->slice(height, sun_zenith, grid, content);
    return twin->slice(height, sun_zenith, grid,
                       {.samples = steps,
                        .multiple_scattering = content.multiple_scattering,
                        .ground = content.ground,
                        .aerial_perspective = content.aerial_perspective,
                        .window = content.window});
  }
};

/// Tables without multiple scattering.
Tables bare_tables(const Medium& medium) {
  Tables tables;
  tables.medium = medium;
  return tables;
}

/// The last few of a kind, by name.
template <class Value>
class Recent {
 public:
  explicit Recent(size_t capacity) : capacity_(capacity) {}

  /// Nothing if it is not there; else it counts as used now.
  std::optional<Value> find(const std::string& name) {
    for (auto i = entries_.begin(); i != entries_.end(); ++i)
      if (i->first == name) {
        entries_.splice(entries_.begin(), entries_, i);
        return i->second;
      }
    return {};
  }
  void keep(const std::string& name, const Value& value) {
    entries_.emplace_front(name, value);
    if (entries_.size() > capacity_) entries_.pop_back();
  }

 private:
  size_t capacity_;
  std::list<std::pair<std::string, Value>> entries_;
};

/// Runs `work` on a thread of its own and waits. The caller may be a worker of the pipeline that
/// holds a lock: while it waits for parallel work it must not pick up another frame, which would
/// wait for that lock.
template <class Work>
auto apart(const Work& work) {
  std::optional<decltype(work())> result;
  std::thread([&] { result.emplace(work()); }).join();
  return *std::move(result);
}

std::optional<sky::AtmosphereDisc> disc_of(const Twin& twin, const plan::Frame& frame) {
  return disc_of_frame(twin.medium(), frame, [&](Angle zenith) {
    return twin.transmittance(frame.camera_height, zenith);
  });
}

/// That of sky.slice, or the model's own for this height.
SliceGrid grid_of(const config::Sky& sky, const Medium& medium, Length height) {
  if (sky.slice_azimuths == 0) return sky::bruneton::slice_grid(medium, height);
  return sky::bruneton::slice_grid(medium, height, sky.slice_azimuths, sky.slice_zeniths);
}

}  // namespace

struct AtmosphereService::State {
  State(const plan::Plan& the_plan, gpu::Backend the_backend, std::function<bool(double)> report,
        std::optional<sky::bruneton::TableCache> the_cache)
      : plan(the_plan),
        backend(the_backend),
        progress(std::move(report)),
        cache(std::move(the_cache)) {}

  const plan::Plan& plan;
  gpu::Backend backend;
  std::function<bool(double)> progress;

  mutable std::mutex mutex;  // of all below
  bool started = false;
  std::optional<sky::bruneton::TableCache> cache;
  std::shared_ptr<gpu::Context> context;
  Recent<std::shared_ptr<const Tables>> tables{2};  // of air that changes; others are on the GPU
  Recent<Model> models{2};                          // some 100 MB each
  AtmosphereRecord record;
  std::vector<std::string> notes;

  Status start();
  Status start_context();
  // With the mutex held:
  Result<Model> model_of(const plan::Frame& frame, sky::EffectSet effects);
  Result<Model> model_without_tables(const plan::Frame& frame);
  Result<std::shared_ptr<const Tables>> tables_of(const Medium& medium, const Settings& settings);
  Result<Tables> compute(const Medium& medium, const Settings& settings) const;
  Result<Model> ready(const std::shared_ptr<const Tables>& tables);
  [[nodiscard]] bool on_processor() const {
    return plan.job.sky.precision == config::SkyPrecision::full;
  }
  [[nodiscard]] int steps() const {
    return plan.job.sky.steps > 0 ? plan.job.sky.steps : sky::bruneton::ModelOptions{}.samples;
  }
  [[nodiscard]] bool air_changes() const {
    return std::any_of(plan.air.sites.begin(), plan.air.sites.end(),
                       [](const auto& nodes) { return !nodes.empty(); });
  }
};

Status AtmosphereService::State::start_context() {
  if (context) return Done{};
  auto made = gpu::Context::create(backend);
  if (!made) return made.error();
  context = *std::move(made);
  record.context = context->info();
  return Done{};
}

Status AtmosphereService::State::start() {
  if (started) return Done{};
  if (on_processor())
    record.context.backend = "processor", record.context.renderer = "double precision";
  else if (Status made = start_context(); !made)
    return made;
  if (!cache) cache = sky::bruneton::TableCache::standard();
  if (!cache->note().empty()) notes.push_back(cache->note());
  started = true;
  return Done{};
}

Result<Tables> AtmosphereService::State::compute(const Medium& medium,
                                                 const Settings& settings) const {
  if (on_processor()) return sky::bruneton::precompute_twin(medium, settings, progress);
  return sky::bruneton::precompute(*context, medium, settings, progress);
}

Result<std::shared_ptr<const Tables>> AtmosphereService::State::tables_of(
    const Medium& medium, const Settings& settings) {
  const std::string id = sha256_hex(canonical_text(medium) + canonical_text(settings));
  if (auto found = tables.find(id)) return *found;
  const std::string maker = record.context.renderer + " " + record.context.version;
  const auto start_time = std::chrono::steady_clock::now();
  auto computed = cache->find(medium, settings, maker);
  const bool cached = computed.has_value();
  if (!cached) {
    auto fresh = compute(medium, settings);
    if (!fresh) return fresh.error();
    computed = *std::move(fresh);
    const Status stored = cache->store(*computed, maker);
    if (!stored) notes.push_back(stored.error().message);
  }
  computed->medium = medium;  // the cache does not tell media by their weights for XYZ
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start_time;
  record.tables.push_back({id, cached, taken.count(), computed->orders, computed->bytes()});
  auto shared = std::make_shared<const Tables>(*std::move(computed));
  if (air_changes()) tables.keep(id, shared);
  return shared;
}

Result<Model> AtmosphereService::State::ready(const std::shared_ptr<const Tables>& from) {
  if (on_processor()) return Model{nullptr, std::make_shared<const Twin>(from), steps()};
  auto gpu = GpuModel::create(
      context, *from,
      {.samples = steps(), .half_source = plan.job.sky.precision == config::SkyPrecision::half});
  if (!gpu) return gpu.error();
  return Model{
      std::make_shared<const GpuModel>(*std::move(gpu)),
      std::make_shared<const Twin>(std::make_shared<const Tables>(bare_tables(from->medium))),
      steps()};
}

Result<Model> AtmosphereService::State::model_without_tables(const plan::Frame& frame) {
  const auto medium = plan::medium_of_frame(plan.job, plan.air, frame);
  if (!medium) return medium.error();
  const std::string name = "no tables " + canonical_text(*medium);
  if (auto found = models.find(name)) return *found;
  auto model = ready(std::make_shared<const Tables>(bare_tables(*medium)));
  if (model) models.keep(name, *model);
  return model;
}

Result<Model> AtmosphereService::State::model_of(const plan::Frame& frame, sky::EffectSet effects) {
  return apart([&]() -> Result<Model> {
    const Status ok = start();
    if (!ok) return ok.error();
    if (!plan::reads_tables(plan, effects)) return model_without_tables(frame);
    const auto media = plan::tables_of_frame(plan.job, plan.air, frame);
    if (!media) return media.error();
    const Settings settings = plan::table_settings(plan, *media, effects);
    const bool mixed = media->weight > 0;
    const std::string name = canonical_text(media->a) + canonical_text(settings);
    if (!mixed)
      if (auto found = models.find(name)) return *found;
    const auto a = tables_of(media->a, settings);
    if (!a) return a.error();
    if (!mixed) {
      auto model = ready(*a);
      if (model) models.keep(name, *model);
      return model;
    }
    const auto b = tables_of(media->b, settings);
    if (!b) return b.error();
    const auto medium = plan::medium_of_frame(plan.job, plan.air, frame);
    if (!medium) return medium.error();
    return ready(
        std::make_shared<const Tables>(sky::bruneton::blend(**a, **b, media->weight, *medium)));
  });
}

AtmosphereService::AtmosphereService(const plan::Plan& plan, gpu::Backend backend,
                                     std::function<bool(double)> progress,
                                     std::optional<sky::bruneton::TableCache> cache)
    : state_(std::make_unique<State>(plan, backend, std::move(progress), std::move(cache))) {}

AtmosphereService::~AtmosphereService() = default;

Result<FrameAtmosphere> AtmosphereService::of_frame(const plan::Frame& frame) {
  const plan::Plan& plan = state_->plan;
  const sky::EffectSet effects = plan::effects_of(plan, frame);
  const auto medium = plan::medium_of_frame(plan.job, plan.air, frame);
  if (!medium) return medium.error();
  const SliceGrid grid = grid_of(plan.job.sky, *medium, frame.camera_height);
  const Angle sun_zenith = 90 * deg - elevation(frame.sun.direction);
  SliceContent content{.multiple_scattering = true,
                       .ground = effects.has(sky::Effect::ground),
                       .aerial_perspective = effects.has(sky::Effect::aerial_perspective)};
  const image::Camera* picture = plan.sights[frame.camera].only_picture();
  if (!effects.has(sky::Effect::unseen_sky) && picture != nullptr)
    content.window = sky::bruneton::window_of(*picture, grid, frame.sun.direction);
  if (content.window && content.window->empty()) {
    // Above the air and looking away from it: nothing shines but the sun, and none of the sky's
    // light falls on a level surface.
    const Twin twin(std::make_shared<const Tables>(bare_tables(*medium)));
    return FrameAtmosphere{
        dark_slice(*medium, sun_zenith, grid, content.window), {}, disc_of(twin, frame)};
  }
  // The context does one thing at a time. Held until the slice is there, so that of air that
  // changes one model exists and not one for each frame in flight.
  std::unique_lock lock(state_->mutex);
  auto model = state_->model_of(frame, effects);
  if (!model) return model.error();
  auto slice = model->slice(frame.camera_height, sun_zenith, grid, content);
  if (!slice) return slice.error();
  const SliceGrid dome = sky::bruneton::irradiance_grid(*medium, frame.camera_height);
  auto lit = model->slice(frame.camera_height, sun_zenith, dome,
                          {.ground = false, .window = sky::bruneton::irradiance_window(dome)});
  if (!lit) return lit.error();
  model->gpu.reset();  // before another frame of changing air makes its own
  lock.unlock();
  return FrameAtmosphere{refined(*slice), horizontal_irradiance_xyz(refined(*lit)),
                         disc_of(*model->twin, frame)};
}

Result<std::shared_ptr<gpu::Context>> AtmosphereService::context() {
  const std::lock_guard lock(state_->mutex);
  const Status started = apart([&] { return state_->start_context(); });
  if (!started) return started.error();
  return state_->context;
}

std::optional<AtmosphereRecord> AtmosphereService::record() const {
  const std::lock_guard lock(state_->mutex);
  if (!state_->started && !state_->context) return {};
  return state_->record;
}

std::vector<std::string> AtmosphereService::notes() const {
  const std::lock_guard lock(state_->mutex);
  return state_->notes;
}

}  // namespace skylapse::pipeline
