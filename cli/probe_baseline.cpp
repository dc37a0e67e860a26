#include "cli/probe_baseline.h"

#include <fmt/format.h>

#include "cli/arguments.h"
#include "cli/csv.h"
#include "cli/table.h"
#include "config/quantity_parser.h"
#include "core/constants.h"
#include "sky/cie/sky.h"
#include "sky/preetham/sky.h"

namespace skylapse::cli {
namespace {

/// A row's question.
struct Question {
  double turbidity = 0;
  int cie_type = 12;
  Direction<Enu> sun, view;
  bool disc = false;
  int band = 0;  // of XYZ
};

Error at_row(const CsvTable& table, size_t row, const Error& error) {
  Error placed = csv_error(table, row, table.columns.front(), error.message, error.hint);
  placed.span.length = int(table.texts[row].size());
  return placed;
}

Result<Question> question_of(const CsvTable& table, size_t row) {
  Question q;
  const auto turbidity = csv_number(table, row, "turbidity");
  if (!turbidity) return turbidity.error();
  q.turbidity = *turbidity;
  // Neither sky knows the ground, but a table that serves several models has it.
  const auto albedo = csv_number(table, row, "albedo", 0, 1);
  if (!albedo) return albedo.error();
  const auto sun = csv_number(table, row, "sun_elevation_deg", 0, 90);
  if (!sun) return sun.error();
  const auto zenith = csv_number(table, row, "view_zenith_deg", 0, 90);
  if (!zenith) return zenith.error();
  const auto azimuth = csv_number(table, row, "relative_azimuth_deg");
  if (!azimuth) return azimuth.error();
  q.sun = enu_direction(0 * deg, *sun * deg);
  q.view = enu_direction(*azimuth * deg, (90 - *zenith) * deg);
  const std::string kind = csv_text(table, row, "kind"), band = csv_text(table, row, "band");
  if (kind != "xyz" && kind != "solar_direct")
    return csv_error(table, row, "kind", fmt::format("kind = {} is not known to this model", kind),
                     "allowed: xyz, solar_direct");
  q.disc = kind == "solar_direct";
  if (band != "X" && band != "Y" && band != "Z")
    return csv_error(table, row, "band", fmt::format("band = {} is not known", band),
                     "allowed: X, Y, Z");
  q.band = band[0] - 'X';
  const int column = table.column("cie_type");
  if (column >= 0 && !table.rows[row][size_t(column)].empty()) {
    const auto type = csv_number(table, row, "cie_type", 1, sky::cie::kTypes);
    if (!type) return type.error();
    if (*type != double(int(*type)))
      return csv_error(table, row, "cie_type", "cie_type is a whole number", "allowed: 1 to 15");
    q.cie_type = int(*type);
  }
  return q;
}

Result<glm::dvec3> xyz_of(const std::string& model, const Question& q) {
  const auto sky = model == "preetham"
                       ? sky::preetham::make_sky(q.turbidity, q.sun, kSolarRadiusAt1Au)
                       : sky::cie::make_sky(q.cie_type, q.turbidity, q.sun, kSolarRadiusAt1Au);
  if (!sky) return sky.error();
  if (!q.disc) return sky->dome(q.view);
  const double share = sin(separation(q.view, q.sun)) / sin(kSolarRadiusAt1Au);
  if (separation(q.view, q.sun) > kSolarRadiusAt1Au) return glm::dvec3(0);
  return sky->disc.radiance(elevation(q.view), std::sqrt(std::max(0.0, 1 - share * share)));
}

Result<std::vector<Cell>> answered_row(const std::string& model, const CsvTable& table,
                                       size_t row) {
  const auto question = question_of(table, row);
  if (!question) return question.error();
  const auto xyz = xyz_of(model, *question);
  if (!xyz) return at_row(table, row, xyz.error());
  std::vector<Cell> cells;
  for (const std::string& text : table.rows[row])
    cells.push_back({text, config::parse_number(text).ok()});
  for (const double value : {(*xyz)[question->band], kLuminousEfficacy * xyz->y})
    cells.push_back({fmt::format("{:.17g}", value), true});
  return cells;
}

}  // namespace

bool is_baseline_model(const std::string& model) { return model == "preetham" || model == "cie"; }

ExitCode run_baseline_probe(const std::string& model, const std::string& batch,
                            const ConsoleOptions& console) {
  const auto input = read_csv(batch);
  if (!input) return report(input.error());
  const Status complete =
      require_columns(*input, {"turbidity", "albedo", "sun_elevation_deg", "view_zenith_deg",
                               "relative_azimuth_deg", "band", "kind"});
  if (!complete) return report(complete.error());
  auto rows = convert_rows<std::vector<Cell>>(
      *input, [&](size_t row) { return answered_row(model, *input, row); });
  if (!rows) return report(rows.error());
  Table table{input->columns, *std::move(rows)};
  table.columns.emplace_back("radiance");
  table.columns.emplace_back("luminance");
  print(format_table(table, console.json ? TableFormat::json : TableFormat::csv));
  return ExitCode::done;
}

}  // namespace skylapse::cli
