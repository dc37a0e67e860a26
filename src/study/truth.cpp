#include "study/truth.h"

#include <fmt/format.h>

#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>

#include "core/parallel.h"
#include "core/sha256.h"
#include "core/version.h"
#include "output/atomic_file.h"
#include "sky/bruneton/twin.h"
#include "sky/monte_carlo/reference.h"

namespace skylapse::study {
namespace {

using sky::atmosphere::Medium;
using sky::bruneton::Query;
using sky::monte_carlo::ReferenceOptions;

/// Independent estimates of one XYZ. Their spread is its standard error, whatever the bands of a
/// path have in common.
constexpr int kBatches = 8;
/// Paths of a batch in the first round; the second has as many as the first says.
constexpr long kPilot = 256;
/// Gauss nodes on each piece of a view ray, four times those of a picture: single scattering to
/// some 1e-5.
constexpr int kSingleScatteringNodes = 64;

glm::dvec3 xyz_of(const Medium& medium, const std::vector<double>& radiance) {
  glm::dvec3 xyz(0);
  for (size_t b = 0; b < radiance.size(); ++b) xyz += radiance[b] * medium.bands[b].xyz_weight;
  return xyz;
}

struct Estimate {
  glm::dvec3 xyz{0}, error{0};
  long paths = 0;
};

/// Mean of kBatches estimates of `paths` paths each. `sample` takes the number of paths and a seed.
template <class Sample>
Estimate round_of(long paths, uint64_t seed, const Sample& sample) {
  glm::dvec3 sum(0), squares(0);
  for (int i = 0; i < kBatches; ++i) {
    const glm::dvec3 xyz = sample(paths, seed + uint64_t(i));
    sum += xyz, squares += xyz * xyz;
  }
  const glm::dvec3 mean = sum / double(kBatches);
  const glm::dvec3 variance = glm::max(squares / double(kBatches) - mean * mean, 0.0);
  return {mean, glm::sqrt(variance / double(kBatches - 1)), paths * kBatches};
}

/// A first round says how many paths the second needs for an error of `noise` times the length of
/// `known` plus the estimate; the second alone is the answer where it is there, so that no path was
/// chosen by its result.
template <class Sample>
Estimate estimate(const TruthSettings& settings, uint64_t seed, double noise,
                  const glm::dvec3& known, const Sample& sample) {
  const long pilot = std::clamp(settings.most_paths / kBatches, 2L, kPilot);
  Estimate first = round_of(pilot, seed, sample);
  const double wanted = noise * glm::length(known + first.xyz), reached = glm::length(first.error);
  if (!(reached > wanted)) return first;
  const double ratio = wanted > 0 ? reached / wanted : HUGE_VAL;
  const double needed = std::min(double(settings.most_paths), double(first.paths) * ratio * ratio);
  Estimate second = round_of(std::max(2L, std::lround(needed / kBatches)), seed + kBatches, sample);
  second.paths += first.paths;
  return second;
}

/// One frame's truth in the making.
class Tracer {
 public:
  Tracer(Medium medium, const plan::Frame& frame, const TruthSettings& settings)
      : medium_(std::move(medium)),
        frame_(frame),
        settings_(settings),
        sun_zenith_(90 * deg - elevation(frame.sky.sun_apparent)) {
    const double au = 1 * astronomical_unit / frame.sky.sun_distance;
    distance_factor_ = au * au;
    sky::bruneton::Tables bare;
    bare.medium = medium_;
    single_ = std::make_unique<sky::bruneton::Twin>(
        std::make_shared<const sky::bruneton::Tables>(std::move(bare)));
  }

  [[nodiscard]] TrueRadiance radiance(size_t index, const Direction<Enu>& toward,
                                      long& paths) const {
    const Query query{frame_.camera_height, sun_zenith_, 90 * deg - elevation(toward),
                      azimuth(toward) - azimuth(frame_.sky.sun_apparent)};
    const glm::dvec3 once = xyz_of(medium_, single_
                                                ->answer(query, {.samples = kSingleScatteringNodes,
                                                                 .multiple_scattering = false,
                                                                 .ground = false})
                                                .radiance);
    const Estimate more =
        estimate(settings_, seed_of(index), settings_.noise, once, [&](long n, uint64_t seed) {
          ReferenceOptions options;
          options.samples = n, options.seed = seed, options.min_order = 2;
          return xyz_of(medium_, reference_answer(medium_, query, options).radiance);
        });
    paths = more.paths;
    return {(once + more.xyz) * distance_factor_, more.error * distance_factor_};
  }

  /// Sky and sun on surfaces.
  void add_irradiance(Truth& truth) const {
    const Estimate sky = estimate(
        settings_, seed_of(1u << 30), settings_.noise / 3, glm::dvec3(0),
        [&](long n, uint64_t seed) {
          ReferenceOptions options;
          options.samples = n, options.seed = seed;
          return xyz_of(
              medium_,
              reference_irradiance(medium_, frame_.camera_height, sun_zenith_, options).sky);
        });
    truth.sky_irradiance_xyz = sky.xyz * distance_factor_;
    truth.sky_irradiance_error = sky.error * distance_factor_;
    truth.paths += sky.paths;
    if (elevation(frame_.sky.sun_apparent) + frame_.sky.sun_radius <= frame_.horizon) return;
    const auto through = single_->transmittance(frame_.camera_height, sun_zenith_);
    std::vector<double> light;
    for (size_t b = 0; b < through.size(); ++b)
      light.push_back(through[b] * medium_.bands[b].solar_irradiance);
    truth.sun_normal_irradiance = xyz_of(medium_, light) * distance_factor_;
  }

  /// Everything that shapes the truth but the directions.
  [[nodiscard]] std::string name() const {
    return fmt::format("{}\n{}\n{:a} {:a} {:a} {:a}\n{} {:a} {} {}", kSourceHash,
                       canonical_text(medium_), frame_.camera_height.in(km), sun_zenith_.in(rad),
                       distance_factor_, frame_.sky.sun_radius.in(rad), settings_.wavelengths,
                       settings_.noise, settings_.most_paths, settings_.seed);
  }

 private:
  /// Seeds of directions do not meet: each uses fewer than 64.
  [[nodiscard]] uint64_t seed_of(size_t index) const {
    return (settings_.seed << 40) + 64 * uint64_t(index);
  }

  Medium medium_;
  const plan::Frame& frame_;
  TruthSettings settings_;
  Angle sun_zenith_;
  double distance_factor_ = 1;
  std::unique_ptr<sky::bruneton::Twin> single_;
};

std::string key_of(const Tracer& tracer, const std::vector<Direction<Enu>>& directions,
                   const plan::Frame& frame) {
  std::string text = tracer.name();
  const Angle from = azimuth(frame.sky.sun_apparent);
  for (const auto& d : directions)
    text += fmt::format("\n{:a} {:a}", elevation(d).in(rad), (azimuth(d) - from).in(rad));
  return sha256_hex(text);
}

using nlohmann::json;

json to_json(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
glm::dvec3 vector_from(const json& j) {
  return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

json to_json(const Truth& truth) {
  json radiance = json::array();
  for (const TrueRadiance& r : truth.radiance)
    radiance.push_back({to_json(r.xyz), to_json(r.standard_error)});
  return {{"radiance", radiance},
          {"sky_irradiance", to_json(truth.sky_irradiance_xyz)},
          {"sky_irradiance_error", to_json(truth.sky_irradiance_error)},
          {"sun_normal_irradiance", to_json(truth.sun_normal_irradiance)},
          {"paths", truth.paths},
          {"seconds", truth.seconds}};
}

/// Nothing where there is no file, or one that is damaged.
std::optional<Truth> read_truth(const std::filesystem::path& path, size_t directions) {
  const auto bytes = output::read_file(path);
  if (!bytes) return {};
  try {
    const json j = json::parse(reinterpret_cast<const char*>(bytes->data()),
                               reinterpret_cast<const char*>(bytes->data()) + bytes->size());
    Truth truth;
    for (const json& r : j.at("radiance"))
      truth.radiance.push_back({vector_from(r.at(0)), vector_from(r.at(1))});
    truth.sky_irradiance_xyz = vector_from(j.at("sky_irradiance"));
    truth.sky_irradiance_error = vector_from(j.at("sky_irradiance_error"));
    truth.sun_normal_irradiance = vector_from(j.at("sun_normal_irradiance"));
    truth.paths = j.at("paths").get<long>();
    truth.seconds = j.at("seconds").get<double>();
    truth.from_cache = true;
    if (truth.radiance.size() == directions) return truth;
  } catch (const json::exception&) {
    // Damaged: as if it were not there; it is written anew.
  }
  return {};
}

Error interrupted() {
  return {ErrorCode::interrupted, "interrupted: scenes that were finished are kept", {}, {}};
}

}  // namespace

Result<Truth> truth_of(const plan::Plan& plan, const plan::Frame& frame,
                       const std::vector<Direction<Enu>>& directions, const TruthSettings& settings,
                       const std::optional<std::filesystem::path>& cache_folder,
                       const std::atomic<int>* stop_signal,
                       const std::function<void(double)>& progress) {
  config::JobConfig job = plan.job;
  job.sky.wavelengths = settings.wavelengths;
  job.sky.effects = {config::EffectChoice::Rule::all, {}};
  auto medium = plan::medium_of_frame(job, plan.air, frame);
  if (!medium) return medium.error();
  const Status sane = check(*medium);
  if (!sane) return sane.error();
  const Tracer tracer(*std::move(medium), frame, settings);
  std::filesystem::path file;
  if (cache_folder) {
    file = *cache_folder / (key_of(tracer, directions, frame) + ".json");
    if (auto known = read_truth(file, directions.size())) return *std::move(known);
  }

  const auto stopped = [&] { return stop_signal != nullptr && stop_signal->load() != 0; };
  const auto start = std::chrono::steady_clock::now();
  Truth truth;
  truth.radiance.resize(directions.size());
  std::mutex mutex;
  size_t done = 0;
  parallel_for_ranges(directions.size(), 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end && !stopped(); ++i) {
      long paths = 0;
      truth.radiance[i] = tracer.radiance(i, directions[i], paths);
      const std::lock_guard lock(mutex);
      truth.paths += paths;
      if (progress) progress(double(++done) / double(directions.size()));
    }
  });
  if (stopped()) return interrupted();
  tracer.add_irradiance(truth);
  truth.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (cache_folder) {
    const std::string text = to_json(truth).dump();
    const Status kept = output::write_file_atomically(file, std::as_bytes(std::span(text)));
    if (!kept) return kept.error();
  }
  return truth;
}

}  // namespace skylapse::study
