#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/csv.h"
#include "cli/probe_atmosphere.h"
#include "cli/probe_baseline.h"
#include "cli/table.h"
#include "config/quantity_parser.h"
#include "core/frames.h"
#include "sky/hosek_wilkie/probe.h"

namespace skylapse::cli {
namespace {

namespace hw = sky::hosek_wilkie;

/// All options; the fitted models take the model and the batch alone.
using ProbeArguments = AtmosphereProbeArguments;

Result<Angle> angle_cell(const CsvTable& table, size_t row, const std::string& column) {
  const auto value = csv_number(table, row, column);
  if (!value) return value.error();
  return *value * deg;
}

/// Angle between the sun and the view, unless the row gives one.
Result<Angle> gamma_of(const CsvTable& table, size_t row, const hw::ProbeQuery& query) {
  const int given = table.column("gamma_deg");
  if (given >= 0 && !table.rows[row][given].empty()) return angle_cell(table, row, "gamma_deg");
  const auto relative_azimuth = angle_cell(table, row, "relative_azimuth_deg");
  if (!relative_azimuth) return relative_azimuth.error();
  return separation(enu_direction(0 * deg, query.sun_elevation),
                    enu_direction(*relative_azimuth, 90 * deg - query.view_zenith));
}

/// The model's own refusal names the value; the error points at the row.
Error at_row(const CsvTable& table, size_t row, const Error& error) {
  Error placed = csv_error(table, row, table.columns.front(), error.message, error.hint);
  placed.span.length = int(table.texts[row].size());
  return placed;
}

Result<double> radiance_of(const CsvTable& table, size_t row) {
  hw::ProbeQuery query;
  const auto kind = hw::probe_kind_from_name(csv_text(table, row, "kind"));
  if (!kind) return csv_error(table, row, "kind", kind.error().message, kind.error().hint);
  query.kind = *kind;
  query.band = csv_text(table, row, "band");
  const auto turbidity = csv_number(table, row, "turbidity");
  if (!turbidity) return turbidity.error();
  const auto albedo = csv_number(table, row, "albedo");
  if (!albedo) return albedo.error();
  const auto sun_elevation = angle_cell(table, row, "sun_elevation_deg");
  if (!sun_elevation) return sun_elevation.error();
  const auto view_zenith = angle_cell(table, row, "view_zenith_deg");
  if (!view_zenith) return view_zenith.error();
  query.turbidity = *turbidity;
  query.albedo = *albedo;
  query.sun_elevation = *sun_elevation;
  query.view_zenith = *view_zenith;
  const auto gamma = gamma_of(table, row, query);
  if (!gamma) return gamma.error();
  query.gamma = *gamma;
  const auto radiance = hw::probe(query);
  if (!radiance) return at_row(table, row, radiance.error());
  return radiance;
}

/// Whether a column holds numbers only; `band` may be a letter, `kind` and others are text.
bool is_number_column(const std::string& name) {
  return name == "turbidity" || name == "albedo" || name.ends_with("_deg");
}

/// The input row with its radiance: 17 digits, so that each double is printed exactly.
Result<std::vector<Cell>> answered_row(const CsvTable& table, size_t row) {
  const auto radiance = radiance_of(table, row);
  if (!radiance) return radiance.error();
  std::vector<Cell> cells;
  for (size_t c = 0; c < table.columns.size(); ++c) {
    const std::string& text = table.rows[row][c];
    cells.push_back({text, is_number_column(table.columns[c]) && config::parse_number(text).ok()});
  }
  cells.push_back({fmt::format("{:.17g}", *radiance), true});
  return cells;
}

/// The models that know an option.
struct OptionOwners {
  const char* option;
  std::vector<std::string_view> models;
};

const std::vector<OptionOwners>& option_owners() {
  static const std::vector<OptionOwners> owners{
      {"--atmosphere", {"bruneton", "single-scattering", "reference"}},
      {"--level", {"bruneton"}},
      {"--precision", {"bruneton", "single-scattering"}},
      {"--backend", {"bruneton", "single-scattering"}},
      {"--samples", {"reference"}},
      {"--relative-error", {"reference"}},
      {"--seed", {"reference"}},
  };
  return owners;
}

/// The first option that was written for another model.
std::optional<Error> option_without_effect(const CLI::App& command, const std::string& model) {
  for (const OptionOwners& owner : option_owners())
    if (command.count(owner.option) > 0 &&
        std::ranges::find(owner.models, model) == owner.models.end())
      return option_error(owner.option, fmt::format("has no effect on {}", model),
                          fmt::format("it belongs to {}", fmt::join(owner.models, ", ")));
  return {};
}

ExitCode run_probe(const CLI::App& command, const ProbeArguments& arguments,
                   const ConsoleOptions& console) {
  const bool known = is_atmosphere_model(arguments.model) || is_baseline_model(arguments.model) ||
                     arguments.model == "hosek-wilkie";
  if (known)
    if (const auto error = option_without_effect(command, arguments.model)) return report(*error);
  if (is_atmosphere_model(arguments.model)) return run_atmosphere_probe(arguments, console);
  if (is_baseline_model(arguments.model))
    return run_baseline_probe(arguments.model, arguments.batch, console);
  if (!known)
    return report(option_error("--model", fmt::format("'{}' is unknown", arguments.model),
                               "allowed: preetham, cie, hosek-wilkie, bruneton, single-scattering, "
                               "reference"));
  const auto input = read_csv(arguments.batch);
  if (!input) return report(input.error());
  const Status complete =
      require_columns(*input, {"turbidity", "albedo", "sun_elevation_deg", "view_zenith_deg",
                               "relative_azimuth_deg", "band", "kind"});
  if (!complete) return report(complete.error());
  auto rows = convert_rows<std::vector<Cell>>(
      *input, [&](size_t row) { return answered_row(*input, row); });
  if (!rows) return report(rows.error());
  Table table{input->columns, *std::move(rows)};
  table.columns.emplace_back("radiance");
  print(format_table(table, console.json ? TableFormat::json : TableFormat::csv));
  return ExitCode::done;
}

}  // namespace

void add_probe_command(CLI::App& app, Session& session) {
  auto* command = add_command(app, session, "probe", "Radiance of a sky model at directions",
                              "skylapse probe --model hosek-wilkie --batch queries.csv\n"
                              "  skylapse probe --model bruneton --precision double --batch -");
  auto arguments = std::make_shared<ProbeArguments>();
  command
      ->add_option("--model", arguments->model,
                   "preetham, cie, hosek-wilkie, bruneton, single-scattering, reference")
      ->required();
  command
      ->add_option("--batch", arguments->batch,
                   "CSV with turbidity,albedo,sun_elevation_deg,view_zenith_deg,"
                   "relative_azimuth_deg,band,kind[,gamma_deg|,cie_type]; of the atmospheres "
                   "sun_zenith_deg,view_zenith_deg,relative_azimuth_deg,altitude_m,wavelength_nm; "
                   "- is standard input")
      ->required();
  command->add_option("--atmosphere", arguments->atmosphere,
                      "Atmosphere file (YAML; default: the air of a config that says nothing)");
  command->add_option("--level", arguments->level,
                      "Tables of bruneton: draft, low, standard, fine (standard)");
  command->add_option("--precision", arguments->precision,
                      "float: OpenGL, double: CPU twin (float)");
  add_backend_option(*command, arguments->backend);
  command->add_option("--samples", arguments->samples,
                      "Paths of reference (100000; with --relative-error at most 100000000)");
  command->add_option("--relative-error", arguments->relative_error,
                      "Paths of reference until the standard error is this share of the radiance");
  command->add_option("--seed", arguments->seed, "Of reference (1)");
  command->callback([&session, arguments, command] {
    session.action = [&session, arguments, command] {
      return run_probe(*command, *arguments, session.console);
    };
  });
}

}  // namespace skylapse::cli
