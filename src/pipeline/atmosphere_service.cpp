#include "pipeline/atmosphere_service.h"

#include <algorithm>
#include <chrono>
#include <list>
#include <mutex>
#include <thread>

#include "core/sha256.h"
#include "plan/atmosphere_of_frame.h"
#include "sky/bruneton/gpu_model.h"
#include "sky/bruneton/slice_irradiance.h"
#include "sky/bruneton/slice_refine.h"
#include "sky/bruneton/twin.h"

namespace skylapse::pipeline {
namespace {

using sky::atmosphere::Medium;
using sky::bruneton::GpuModel;
using sky::bruneton::Settings;
using sky::bruneton::Tables;
using sky::bruneton::Twin;

/// A medium ready for frames: on the context, and in double for the transmittance of the disc.
struct Model {
  std::shared_ptr<const GpuModel> gpu;
  std::shared_ptr<const Twin> twin;
};

/// Tables without multiple scattering.
Tables bare_tables(const Medium& medium) {
  Tables tables;
  tables.medium = medium;
  return tables;
}

/// Sizes that suffice for both: tables that are mixed must be alike.
Settings larger(Settings a, const Settings& b) {
  for (int Settings::*size :
       {&Settings::heights, &Settings::suns, &Settings::sun_rows_per_interval,
        &Settings::directions_up, &Settings::directions_down, &Settings::azimuths,
        &Settings::harmonics, &Settings::table_azimuths, &Settings::table_zeniths,
        &Settings::samples, &Settings::first_order_samples, &Settings::max_orders})
    a.*size = std::max(a.*size, b.*size);
  a.stop_below = std::min(a.stop_below, b.stop_below);
  return a;
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

/// Transmittance over the disc's elevations above the horizon, in steps far below those in which it
/// changes: on the horizon it falls by a factor of e in about a degree.
std::optional<sky::AtmosphereDisc> disc_of(const Twin& twin, const plan::Frame& frame) {
  constexpr int kSteps = 32;
  const Angle centre = elevation(frame.sun.direction), radius = frame.sky.sun_radius;
  if (centre + radius <= frame.horizon) return {};
  const Angle lowest = std::max(frame.horizon, centre - radius);
  const Angle step = std::max((centre + radius - lowest) / kSteps, 1e-9 * rad);
  std::vector<std::vector<double>> transmittance;
  for (int i = 0; i <= kSteps; ++i)
    transmittance.push_back(
        twin.transmittance(frame.camera_height, 90 * deg - (lowest + double(i) * step)));
  return sky::AtmosphereDisc(twin.medium(), radius, lowest, step, transmittance);
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
  std::optional<sky::bruneton::TableCache> cache;
  std::shared_ptr<gpu::Context> context;
  Recent<std::shared_ptr<const Tables>> tables{2};  // of air that changes; others are on the GPU
  Recent<Model> models{2};                          // some 100 MB each
  AtmosphereRecord record;
  std::vector<std::string> notes;

  Status start();
  Result<Model> model_of(const plan::Frame& frame);  // with the mutex held
  Result<Model> single_scattering_model(const plan::Frame& frame);
  Result<std::shared_ptr<const Tables>> tables_of(const Medium& medium, const Settings& settings);
  Result<Model> upload(const Tables& tables);
  [[nodiscard]] bool air_changes() const {
    return std::any_of(plan.air.sites.begin(), plan.air.sites.end(),
                       [](const auto& nodes) { return !nodes.empty(); });
  }
};

Status AtmosphereService::State::start() {
  if (context) return Done{};
  auto made = gpu::Context::create(backend);
  if (!made) return made.error();
  context = *std::move(made);
  record.context = context->info();
  if (!cache) cache = sky::bruneton::TableCache::standard();
  if (!cache->note().empty()) notes.push_back(cache->note());
  return Done{};
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
    auto fresh = sky::bruneton::precompute(*context, medium, settings, progress);
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

Result<Model> AtmosphereService::State::upload(const Tables& from) {
  auto gpu = GpuModel::create(context, from);
  if (!gpu) return gpu.error();
  return Model{
      std::make_shared<const GpuModel>(*std::move(gpu)),
      std::make_shared<const Twin>(std::make_shared<const Tables>(bare_tables(from.medium)))};
}

Result<Model> AtmosphereService::State::single_scattering_model(const plan::Frame& frame) {
  const auto medium = plan::medium_of_frame(plan.job, plan.air, frame);
  if (!medium) return medium.error();
  const std::string name = canonical_text(*medium);
  if (auto found = models.find(name)) return *found;
  auto model = upload(bare_tables(*medium));
  if (model) models.keep(name, *model);
  return model;
}

Result<Model> AtmosphereService::State::model_of(const plan::Frame& frame) {
  return apart([&]() -> Result<Model> {
    const Status started = start();
    if (!started) return started.error();
    if (plan.model == config::SkyModel::single_scattering) return single_scattering_model(frame);
    const auto media = plan::tables_of_frame(plan.job, plan.air, frame);
    if (!media) return media.error();
    const auto level = plan.job.sky.level;
    Settings settings = settings_for(level, media->a);
    const bool mixed = media->weight > 0;
    if (mixed) settings = larger(settings, settings_for(level, media->b));
    const std::string name = canonical_text(media->a) + canonical_text(settings);
    if (!mixed)
      if (auto found = models.find(name)) return *found;
    const auto a = tables_of(media->a, settings);
    if (!a) return a.error();
    if (!mixed) {
      auto model = upload(**a);
      if (model) models.keep(name, *model);
      return model;
    }
    const auto b = tables_of(media->b, settings);
    if (!b) return b.error();
    const auto medium = plan::medium_of_frame(plan.job, plan.air, frame);
    if (!medium) return medium.error();
    return upload(sky::bruneton::blend(**a, **b, media->weight, *medium));
  });
}

AtmosphereService::AtmosphereService(const plan::Plan& plan, gpu::Backend backend,
                                     std::function<bool(double)> progress,
                                     std::optional<sky::bruneton::TableCache> cache)
    : state_(std::make_unique<State>(plan, backend, std::move(progress), std::move(cache))) {}

AtmosphereService::~AtmosphereService() = default;

Result<FrameAtmosphere> AtmosphereService::of_frame(const plan::Frame& frame) {
  // The context does one thing at a time. Held until the slice is there, so that of air that
  // changes one model exists and not one for each frame in flight.
  std::unique_lock lock(state_->mutex);
  const auto model = state_->model_of(frame);
  if (!model) return model.error();
  const bool multiple = state_->plan.model == config::SkyModel::bruneton;
  const auto grid = sky::bruneton::slice_grid(model->twin->medium(), frame.camera_height);
  auto slice = model->gpu->slice(frame.camera_height, 90 * deg - elevation(frame.sun.direction),
                                 grid, {.multiple_scattering = multiple, .ground = true});
  if (!slice) return slice.error();
  lock.unlock();
  FrameAtmosphere air{sky::bruneton::refined(*slice), {}, disc_of(*model->twin, frame)};
  air.sky_irradiance_xyz = horizontal_irradiance_xyz(air.slice);
  return air;
}

Result<std::shared_ptr<gpu::Context>> AtmosphereService::context() {
  const std::lock_guard lock(state_->mutex);
  const Status started = apart([&] { return state_->start(); });
  if (!started) return started.error();
  return state_->context;
}

std::optional<AtmosphereRecord> AtmosphereService::record() const {
  const std::lock_guard lock(state_->mutex);
  if (!state_->context) return {};
  return state_->record;
}

std::vector<std::string> AtmosphereService::notes() const {
  const std::lock_guard lock(state_->mutex);
  return state_->notes;
}

}  // namespace skylapse::pipeline
