#include "cli/probe_atmosphere.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <tuple>

#include "cli/arguments.h"
#include "cli/csv.h"
#include "cli/table.h"
#include "config/atmosphere_file.h"
#include "config/quantity_parser.h"
#include "core/parallel.h"
#include "sky/bruneton/gpu_model.h"
#include "sky/bruneton/table_cache.h"
#include "sky/bruneton/twin.h"
#include "sky/monte_carlo/reference.h"

namespace skylapse::cli {
namespace {

using sky::atmosphere::Medium;
using sky::bruneton::Query;
using sky::bruneton::Tables;
using sky::bruneton::Twin;

constexpr size_t kMostBands = 64;  // of one medium

struct Row {
  Query query;
  double wavelength_nm = 0;
};

/// Numbers that make two queries one.
using QueryKey = std::tuple<double, double, double, double>;
QueryKey key_of(const Query& q) {
  return {q.height.in(metre), q.sun_zenith.in(rad), q.view_zenith.in(rad), q.azimuth.in(rad)};
}

/// What is appended to a row.
struct Values {
  double radiance = 0, transmittance = 0, sun_transmittance = 0;
  double irradiance_sun = 0, irradiance_sky = 0;
  double standard_error = 0;
};

Result<Row> row_of(const CsvTable& table, size_t i) {
  const auto sun = csv_number(table, i, "sun_zenith_deg", 0, 180);
  if (!sun) return sun.error();
  const auto view = csv_number(table, i, "view_zenith_deg", 0, 180);
  if (!view) return view.error();
  const auto azimuth = csv_number(table, i, "relative_azimuth_deg");
  if (!azimuth) return azimuth.error();
  const auto altitude = csv_number(table, i, "altitude_m", 0, 4e8);
  if (!altitude) return altitude.error();
  const auto wavelength = csv_number(table, i, "wavelength_nm", 360, 830);
  if (!wavelength) return wavelength.error();
  return Row{{*altitude * metre, *sun * deg, *view * deg, *azimuth * deg}, *wavelength};
}

/// Answers of a model for one medium: all rows whose wavelengths it holds.
class Responder {
 public:
  virtual ~Responder() = default;
  /// Per query, per band.
  virtual Result<std::vector<std::vector<Values>>> answer(const std::vector<Query>& queries) = 0;
};

/// Irradiances of each height and sun, which many queries share.
template <class Compute>
void fill_irradiance(const std::vector<Query>& queries, std::vector<std::vector<Values>>& answers,
                     const Compute& compute) {
  std::map<std::pair<double, double>, Twin::Irradiance> known;
  for (size_t q = 0; q < queries.size(); ++q) {
    const std::pair key(queries[q].height.in(metre), queries[q].sun_zenith.in(rad));
    auto found = known.find(key);
    if (found == known.end())
      found = known.emplace(key, compute(queries[q].height, queries[q].sun_zenith)).first;
    for (size_t b = 0; b < answers[q].size(); ++b) {
      answers[q][b].irradiance_sun = found->second.sun[b];
      answers[q][b].irradiance_sky = found->second.sky[b];
    }
  }
}

std::vector<Values> values_of(const sky::bruneton::Answer& answer) {
  std::vector<Values> values(answer.radiance.size());
  for (size_t b = 0; b < values.size(); ++b) {
    values[b].radiance = answer.radiance[b];
    values[b].transmittance = answer.transmittance[b];
    values[b].sun_transmittance = answer.sun_transmittance[b];
  }
  return values;
}

/// Tables and twin in double, or both with tables and directions in float on GL. Irradiances are
/// integrated by the twin in either case.
class ModelResponder : public Responder {
 public:
  ModelResponder(Tables tables, std::optional<sky::bruneton::GpuModel> gpu, bool multiple)
      : twin_(std::make_shared<const Tables>(std::move(tables))),
        gpu_(std::move(gpu)),
        multiple_(multiple) {}

  Result<std::vector<std::vector<Values>>> answer(const std::vector<Query>& queries) override {
    std::vector<std::vector<Values>> answers(queries.size());
    if (gpu_) {
      const auto found = gpu_->answer(queries, {.multiple_scattering = multiple_, .ground = false});
      if (!found) return found.error();
      std::transform(found->begin(), found->end(), answers.begin(), values_of);
    } else {
      parallel_for_ranges(queries.size(), 4, [&](size_t begin, size_t end) {
        for (size_t q = begin; q < end; ++q)
          answers[q] = values_of(twin_.answer(queries[q], {.multiple_scattering = multiple_}));
      });
    }
    fill_irradiance(queries, answers,
                    [&](Length height, Angle sun) { return twin_.irradiance(height, sun); });
    return answers;
  }

 private:
  Twin twin_;
  std::optional<sky::bruneton::GpuModel> gpu_;
  bool multiple_;
};

class ReferenceResponder : public Responder {
 public:
  ReferenceResponder(Medium medium, const sky::monte_carlo::ReferenceOptions& options)
      : medium_(std::move(medium)), options_(options) {}

  Result<std::vector<std::vector<Values>>> answer(const std::vector<Query>& queries) override {
    std::vector<std::vector<Values>> answers;
    for (const Query& query : queries) {
      const auto found = sky::monte_carlo::reference_answer(medium_, query, options_);
      answers.push_back(values_of(found.answer()));
      for (size_t b = 0; b < answers.back().size(); ++b)
        answers.back()[b].standard_error = found.standard_error[b];
    }
    fill_irradiance(queries, answers, [&](Length height, Angle sun) -> Twin::Irradiance {
      // Above the air there is nothing above to shine down, and the sun is as it is at the top.
      const Length top = medium_.top_height_km * km;
      const auto found =
          sky::monte_carlo::reference_irradiance(medium_, std::min(height, top), sun, options_);
      if (height <= top) return {found.sun, found.sky};
      return {sun_above_air(height, sun), std::vector<double>(medium_.bands.size(), 0.0)};
    });
    return answers;
  }

 private:
  [[nodiscard]] std::vector<double> sun_above_air(Length height, Angle sun) const {
    Tables bare;
    bare.medium = medium_;
    return Twin(std::make_shared<const Tables>(std::move(bare))).irradiance(height, sun).sun;
  }

  Medium medium_;
  sky::monte_carlo::ReferenceOptions options_;
};

/// The GL context of --precision float, and who computes on it.
struct Device {
  std::shared_ptr<gpu::Context> context;
  std::string maker = "twin";
};

Result<Tables> tables_of(const AtmosphereProbeArguments& arguments, const Medium& medium,
                         const Device& device) {
  Tables tables;
  tables.medium = medium;
  if (arguments.model == "single-scattering") return tables;
  const auto names = sky::bruneton::level_names();
  const auto level =
      sky::bruneton::Level(std::find(names.begin(), names.end(), arguments.level) - names.begin());
  const auto settings = settings_for(level, medium);
  const auto cache = sky::bruneton::TableCache::standard();
  if (auto found = cache.find(medium, settings, device.maker)) {
    found->medium = medium;
    return *std::move(found);
  }
  if (device.context) {
    auto computed = precompute(*device.context, medium, settings);
    if (!computed) return computed.error();
    tables = *std::move(computed);
  } else {
    tables = precompute_twin(medium, settings);
  }
  // A cache that cannot be written costs time at the next call, no more.
  const Status kept = cache.store(tables, device.maker);
  static_cast<void>(kept);
  return tables;
}

Result<std::unique_ptr<Responder>> responder_of(const AtmosphereProbeArguments& arguments,
                                                const Medium& medium, const Device& device) {
  if (arguments.model == "reference") {
    sky::monte_carlo::ReferenceOptions options;
    const bool until = arguments.relative_error.has_value();
    options.samples = arguments.samples.value_or(until ? 100'000'000 : 100'000);
    options.seed = uint64_t(arguments.seed);
    if (until) options.relative_error = arguments.relative_error;
    return std::unique_ptr<Responder>(std::make_unique<ReferenceResponder>(medium, options));
  }
  auto tables = tables_of(arguments, medium, device);
  if (!tables) return tables.error();
  std::optional<sky::bruneton::GpuModel> gpu;
  if (device.context) {
    auto made = sky::bruneton::GpuModel::create(device.context, *tables);
    if (!made) return made.error();
    gpu = *std::move(made);
  }
  return std::unique_ptr<Responder>(std::make_unique<ModelResponder>(
      *std::move(tables), std::move(gpu), arguments.model == "bruneton"));
}

/// The rows whose wavelengths lie in [first, last) of `wavelengths`, answered.
Status answer_group(const AtmosphereProbeArguments& arguments,
                    const sky::atmosphere::Atmosphere& air, const std::vector<double>& wavelengths,
                    const Device& device, const std::vector<Row>& rows,
                    std::vector<Values>& values) {
  std::vector<Wavelength> bands;
  for (const double w : wavelengths) bands.push_back(w * nm);
  const Medium medium = sky::atmosphere::medium_sampled(air, bands);
  const Status sane = check(medium);
  if (!sane) return sane;
  const auto responder = responder_of(arguments, medium, device);
  if (!responder) return responder.error();

  std::vector<Query> queries;
  std::map<QueryKey, size_t> place;
  std::vector<std::pair<size_t, size_t>> wanted;  // row and query
  for (size_t i = 0; i < rows.size(); ++i) {
    if (!std::binary_search(wavelengths.begin(), wavelengths.end(), rows[i].wavelength_nm))
      continue;
    const auto [known, fresh] = place.try_emplace(key_of(rows[i].query), queries.size());
    if (fresh) queries.push_back(rows[i].query);
    wanted.emplace_back(i, known->second);
  }
  const auto answers = (*responder)->answer(queries);
  if (!answers) return answers.error();
  for (const auto& [row, query] : wanted) {
    const auto band =
        std::lower_bound(wavelengths.begin(), wavelengths.end(), rows[row].wavelength_nm) -
        wavelengths.begin();
    values[row] = (*answers)[query][size_t(band)];
  }
  return Done{};
}

Result<std::vector<Values>> answer_all(const AtmosphereProbeArguments& arguments,
                                       const sky::atmosphere::Atmosphere& air, const Device& device,
                                       const std::vector<Row>& rows) {
  std::vector<double> wavelengths;
  for (const Row& row : rows) wavelengths.push_back(row.wavelength_nm);
  std::sort(wavelengths.begin(), wavelengths.end());
  wavelengths.erase(std::unique(wavelengths.begin(), wavelengths.end()), wavelengths.end());
  std::vector<Values> values(rows.size());
  for (size_t first = 0; first < wavelengths.size(); first += kMostBands) {
    const auto begin = wavelengths.begin() + long(first);
    const auto end = begin + long(std::min(kMostBands, wavelengths.size() - first));
    const Status done = answer_group(arguments, air, {begin, end}, device, rows, values);
    if (!done) return done.error();
  }
  return values;
}

Status check_options(const AtmosphereProbeArguments& arguments) {
  const auto& levels = sky::bruneton::level_names();
  if (std::find(levels.begin(), levels.end(), arguments.level) == levels.end())
    return option_error("--level", fmt::format("'{}' is unknown", arguments.level),
                        fmt::format("allowed: {}", fmt::join(levels, ", ")));
  if (arguments.precision != "float" && arguments.precision != "double")
    return option_error("--precision", fmt::format("'{}' is unknown", arguments.precision),
                        "allowed: float (GL), double (CPU)");
  if (arguments.samples.value_or(2) < 2)
    return option_error("--samples", fmt::format("{} is out of range", *arguments.samples),
                        "allowed: 2 and more, for a standard error");
  if (const auto e = arguments.relative_error; e && !(*e > 0 && *e < 1))
    return option_error("--relative-error", fmt::format("{} is out of range", *e),
                        "allowed: more than 0, less than 1");
  if (arguments.seed < 0)
    return option_error("--seed", fmt::format("{} is out of range", arguments.seed),
                        "allowed: 0 and more");
  return Done{};
}

Result<sky::atmosphere::Atmosphere, Diagnostics> air_of(const std::string& file) {
  if (!file.empty()) return config::load_atmosphere(file);
  auto air = sky::atmosphere::atmosphere_of(sky::atmosphere::AirDescription{});
  if (!air) return Diagnostics{air.error()};
  return *std::move(air);
}

Result<Device> device_of(const AtmosphereProbeArguments& arguments) {
  const auto backend = parse_backend(arguments.backend);
  if (!backend) return backend.error();
  if (arguments.model == "reference" || arguments.precision == "double") return Device{};
  auto context = gpu::Context::create(*backend);
  if (!context) return context.error();
  const std::string maker = (*context)->info().renderer + " " + (*context)->info().version;
  return Device{*std::move(context), maker};
}

/// 17 digits: each double is printed exactly.
Cell exact_cell(double value) { return {fmt::format("{:.17g}", value), true}; }

Table answered(const CsvTable& input, const std::vector<Values>& values, bool with_error) {
  Table table{input.columns, {}};
  for (const char* name :
       {"radiance", "transmittance", "sun_transmittance", "irradiance_sun", "irradiance_sky"})
    table.columns.emplace_back(name);
  if (with_error) table.columns.emplace_back("standard_error");
  for (size_t i = 0; i < values.size(); ++i) {
    std::vector<Cell> cells;
    for (const std::string& text : input.rows[i])
      cells.push_back({text, config::parse_number(text).ok()});
    const Values& v = values[i];
    for (const double value :
         {v.radiance, v.transmittance, v.sun_transmittance, v.irradiance_sun, v.irradiance_sky})
      cells.push_back(exact_cell(value));
    if (with_error) cells.push_back(exact_cell(v.standard_error));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

}  // namespace

bool is_atmosphere_model(const std::string& model) {
  return model == "bruneton" || model == "single-scattering" || model == "reference";
}

ExitCode run_atmosphere_probe(const AtmosphereProbeArguments& arguments,
                              const ConsoleOptions& console) {
  const Status options = check_options(arguments);
  if (!options) return report(options.error());
  const auto air = air_of(arguments.atmosphere);
  if (!air) return report(air.error());
  const auto input = read_csv(arguments.batch);
  if (!input) return report(input.error());
  const Status complete = require_columns(
      *input,
      {"sun_zenith_deg", "view_zenith_deg", "relative_azimuth_deg", "altitude_m", "wavelength_nm"});
  if (!complete) return report(complete.error());
  const auto rows = convert_rows<Row>(*input, [&](size_t i) { return row_of(*input, i); });
  if (!rows) return report(rows.error());
  const auto device = device_of(arguments);
  if (!device) return report(device.error());
  const auto values = answer_all(arguments, *air, *device, *rows);
  if (!values) return report(values.error());
  print(format_table(answered(*input, *values, arguments.model == "reference"),
                     console.json ? TableFormat::json : TableFormat::csv));
  return ExitCode::done;
}

}  // namespace skylapse::cli
