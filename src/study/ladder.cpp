#include "study/ladder.h"

#include <fmt/format.h>

#include <algorithm>

namespace skylapse::study {
namespace {

/// A scene of no interest: the text that a rung's `sky` is read from.
constexpr const char* kBareScene = R"(location: {latitude: 0 deg, longitude: 0 deg}
time: {at: [2000-01-01T12:00Z]}
camera: {projection: lat-long, size: 4x2}
outputs: [{image: a.exr}]
)";

class Ladder {
 public:
  void add(const std::string& group, const std::string& id, const std::string& label,
           const std::vector<config::Override>& overrides, bool quick = false,
           bool small_picture = false) {
    std::string setting;
    for (const auto& o : overrides)
      setting += (setting.empty() ? "" : " ") + o.key_path + "=" + o.value;
    rungs_.push_back({id, group, label, setting, overrides, quick, small_picture});
  }
  /// A rung that differs from the base in one key of the sky.
  void vary(const std::string& group, const std::string& key, const std::string& value,
            const std::string& label, bool quick = false) {
    add(group, group + "-" + value, label, {{"sky.model", "bruneton"}, {"sky." + key, value}},
        quick);
  }
  std::vector<Rung> take() { return std::move(rungs_); }

 private:
  std::vector<Rung> rungs_;
};

void add_models(Ladder& l) {
  const std::string g = "model";
  l.add(g, "cie", "CIE clear sky", {{"sky.model", "cie"}}, true);
  l.add(g, "preetham", "Preetham", {{"sky.model", "preetham"}}, true);
  for (const char* fit : {"rgb", "xyz", "spectral"})
    l.add(g, fmt::format("hosek-wilkie-{}", fit), fmt::format("Hosek-Wilkie {}", fit),
          {{"sky.model", "hosek-wilkie"}, {"sky.fit", fit}}, std::string(fit) == "spectral");
  for (const int steps : {2, 4, 8, 16, 32})
    l.add(g, fmt::format("single-scattering-{}", steps),
          fmt::format("single scattering, {} steps", steps),
          {{"sky.model", "single-scattering"}, {"sky.steps", std::to_string(steps)}},
          steps == 4 || steps == 16);
  l.add(g, kBaseRung, "Bruneton", {{"sky.model", "bruneton"}}, true);
  for (const int samples : {4, 16, 64, 256})
    l.add(g, fmt::format("reference-{}", samples), fmt::format("reference, {} paths", samples),
          {{"sky.model", "reference"}, {"sky.samples", std::to_string(samples)}}, samples == 16,
          true);
}

void add_suns(Ladder& l) {
  for (const char* algorithm : {"preetham", "preetham-atan2", "sg2"})
    l.vary("sun", "sun_algorithm", algorithm, fmt::format("sun by {}", algorithm),
           std::string(algorithm) != "sg2");
}

void add_resolutions(Ladder& l) {
  for (const char* n : {"3", "8", "32"})
    l.vary("wavelengths", "wavelengths", n, fmt::format("{} wavelengths", n),
           std::string(n) != "32");
  for (const char* n : {"1", "2", "3", "4", "6"})
    l.vary("orders", "orders", n, fmt::format("{} order{}", n, *n == '1' ? "" : "s"), *n == '2');
  for (const char* level : {"draft", "low", "fine"})
    l.vary("level", "level", level, fmt::format("tables {}", level), *level == 'd');
  for (const char* precision : {"half", "double"})
    l.vary("precision", "precision", precision, fmt::format("{} precision", precision));
  for (const char* slice : {"16x32", "32x64", "128x256"})
    l.vary("slice", "slice", slice, fmt::format("slice {}", slice),
           *slice == '1' && slice[1] == '6');
  for (const char* steps : {"4", "8", "32"})
    l.vary("steps", "steps", steps, fmt::format("{} steps", steps));
}

void add_effects(Ladder& l) {
  l.add("refraction", "refraction-off", "refraction off",
        {{"sky.model", "bruneton"}, {"air.refraction", "off"}}, true);
  l.add("ozone", "ozone-off", "no ozone", {{"sky.model", "bruneton"}, {"air.ozone", "0 DU"}}, true);
}

/// Several keys at once, where one alone would be wasted.
void add_mixtures(Ladder& l) {
  const auto mix = [&](const char* id, const char* label, const char* level, const char* n,
                       const char* slice, bool quick) {
    l.add("mixture", id, label,
          {{"sky.model", "bruneton"},
           {"sky.level", level},
           {"sky.wavelengths", n},
           {"sky.slice", slice}},
          quick);
  };
  mix("mixture-quickest", "draft, 3 wavelengths, slice 32x64", "draft", "3", "32x64", true);
  mix("mixture-quick", "draft, 8 wavelengths", "draft", "8", "64x128", false);
  mix("mixture-medium", "low, 8 wavelengths", "low", "8", "64x128", false);
  mix("mixture-finest", "fine, 32 wavelengths, slice 128x256", "fine", "32", "128x256", false);
}

}  // namespace

const std::vector<RungGroup>& rung_groups() {
  static const std::vector<RungGroup> groups{
      {"model", "Sky models",
       "From a formula for the brightness of the sky to the tracing of single paths of light."},
      {"sun", "Where the sun is",
       "The formulas of the Preetham paper as a thesis printed them (arctan), the same with atan2, "
       "SG2, and ERFA (the base)."},
      {"wavelengths", "Wavelengths", "In how many bands of the spectrum light is followed.", "16",
       2},
      {"orders", "Orders of scattering",
       "How often light may be scattered before it reaches the eye; the base goes on until nothing "
       "more comes.",
       "all", 5},
      {"level", "Size of the tables", "How finely multiple scattering is tabulated.", "standard",
       2},
      {"precision", "Arithmetic", "Tables in half floats, floats (the base), or all in double.",
       "float", 1},
      {"slice", "Sky-view slice", "Azimuths x zenith angles from which a frame's pixels are made.",
       "64x128", 2},
      {"steps", "Steps", "Points on each piece of a view ray at which its light is gathered.", "16",
       2},
      {"refraction", "Refraction", "Whether the air lifts the sun.", "on", 1},
      {"ozone", "Ozone", "Whether it takes its share of the light.", "300 DU", 1},
      {"mixture", "Mixtures", "Several of these at once."},
  };
  return groups;
}

std::vector<Rung> ladder(bool quick) {
  Ladder l;
  add_models(l);
  add_suns(l);
  add_resolutions(l);
  add_effects(l);
  add_mixtures(l);
  std::vector<Rung> rungs = l.take();
  if (quick) std::erase_if(rungs, [](const Rung& rung) { return !rung.quick; });
  return rungs;
}

Result<config::JobConfig, Diagnostics> job_of_rung(
    const Rung& rung, const std::function<Result<config::JobConfig, Diagnostics>(
                          const std::vector<config::Override>&)>& load) {
  std::vector<config::Override> of_sky, of_scene;
  for (const auto& o : rung.overrides)
    (o.key_path.starts_with("sky.") ? of_sky : of_scene).push_back(o);
  const auto sky = config::parse_job(kBareScene, "rung " + rung.id, of_sky);
  if (!sky) return sky.error();
  auto job = load(of_scene);
  if (!job) return job.error();
  job->sky = sky->sky;
  if (config::is_fitted(job->sky.model) && job->air.needs_atmosphere)
    return Diagnostics{{ErrorCode::invalid_input,
                        fmt::format("{} needs a model that computes the atmosphere",
                                    job->air.needs_atmosphere->value),
                        job->air.needs_atmosphere->span,
                        {}}};
  return job;
}

}  // namespace skylapse::study
