#include <fmt/format.h>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/csv.h"
#include "core/frames.h"
#include "sky/hosek_wilkie/probe.h"

namespace skylapse::cli {
namespace {

namespace hw = sky::hosek_wilkie;

struct ProbeArguments {
  std::string model, batch;
};

Error at_row(const CsvTable& table, size_t row, Error error) {
  error.span = {table.file, table.lines[row], 1, 1, ""};
  return error;
}

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

Result<double> radiance_of(const CsvTable& table, size_t row) {
  hw::ProbeQuery query;
  const auto kind = hw::probe_kind_from_name(table.rows[row][table.column("kind")]);
  if (!kind) return at_row(table, row, kind.error());
  query.kind = *kind;
  query.band = table.rows[row][table.column("band")];
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

ExitCode run_probe(const ProbeArguments& arguments) {
  if (arguments.model != "hosek-wilkie")
    return report(option_error("--model", fmt::format("'{}' is unknown", arguments.model),
                               "allowed: hosek-wilkie"));
  const auto table = read_csv(arguments.batch);
  if (!table) return report(table.error());
  const Status complete =
      require_columns(*table, {"turbidity", "albedo", "sun_elevation_deg", "view_zenith_deg",
                               "relative_azimuth_deg", "band", "kind"});
  if (!complete) return report(complete.error());
  std::vector<std::string> fields = table->columns;
  fields.emplace_back("radiance");
  std::string text = csv_line(fields);
  for (size_t i = 0; i < table->rows.size(); ++i) {
    const auto radiance = radiance_of(*table, i);
    if (!radiance) return report(radiance.error());
    fields = table->rows[i];
    fields.push_back(fmt::format("{:.17g}", *radiance));
    text += csv_line(fields);
  }
  print(text);
  return ExitCode::done;
}

}  // namespace

void add_probe_command(CLI::App& app, Session& session) {
  auto* command = add_command(app, session, "probe", "Radiance of a sky model at directions",
                              "skylapse probe --model hosek-wilkie --batch queries.csv");
  auto arguments = std::make_shared<ProbeArguments>();
  command->add_option("--model", arguments->model, "hosek-wilkie")->required();
  command
      ->add_option("--batch", arguments->batch,
                   "CSV with turbidity,albedo,sun_elevation_deg,view_zenith_deg,"
                   "relative_azimuth_deg,band,kind[,gamma_deg]; - is standard input")
      ->required();
  command->callback(
      [&session, arguments] { session.action = [arguments] { return run_probe(*arguments); }; });
}

}  // namespace skylapse::cli
