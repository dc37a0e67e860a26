#include <fmt/format.h>

#include <array>
#include <cmath>

#include "cli/csv.h"
#include "config/quantity_parser.h"
#include "config/time_expression.h"
#include "fuzz/require.h"
#include "fuzz/targets.h"

namespace skylapse::fuzz {
namespace {

using config::Dimension;
using config::Problem;

void require_problem(const Problem& problem, std::string_view text) {
  require(!problem.message.empty(), "a problem has words", text);
  require(problem.begin <= text.size() && problem.length <= text.size() - problem.begin,
          "a problem marks a part of the text", text);
  require(problem.message.size() < 400 && problem.hint.size() < 400, "problems are short", text);
  if (is_clean_text(text))
    require(is_clean_text(problem.message) && is_clean_text(problem.hint),
            "clean text gives clean problems", problem.message);
}

/// The value in a unit of its dimension, with every digit, reads back as itself within the
/// rounding of one division and one multiplication.
void require_round_trip(double value, Dimension dimension, const config::UnitName& unit) {
  const double in_unit = (value - unit.offset) / unit.factor;
  if (!std::isfinite(in_unit) || (in_unit != 0 && std::abs(in_unit) < 1e-300)) return;
  const std::string text = fmt::format("{:.17g} {}", in_unit, unit.symbol);
  const auto again = config::parse_quantity(text, dimension);
  require(again.ok(), "a written value can be read", text);
  // Offsets (temperatures) round in their own size as well.
  const double bound =
      4 * 2.3e-16 * (std::abs(value) + std::abs(in_unit * unit.factor) + std::abs(unit.offset));
  require(std::abs(*again - value) <= bound + 1e-300, "a written value keeps its size", text);
}

void require_good_time(const config::TimeExpression& time, std::string_view text) {
  using namespace std::chrono_literals;
  require(time.clock.has_value() != time.anchor.has_value(), "a clock or an anchor", text);
  if (time.clock)
    require(*time.clock >= 0us && *time.clock <= 24h + 1s, "clocks read 0 to 24 h", text);
  if (time.date) require(time.date->ok(), "dates are days", text);
  if (time.utc_offset) require(std::chrono::abs(*time.utc_offset) <= 19h, "offsets have a bound");
  require(std::abs(time.offset.in(second)) <= 400 * 86400.0, "shifts have a bound", text);
}

void require_same_date(const Result<std::chrono::year_month_day, Problem>& date,
                       std::string_view text) {
  if (!date) return require_problem(date.error(), text);
  const auto again = config::parse_date(config::date_text(*date));
  require(again.ok() && *again == *date, "a written day is the same day", text);
  require(int(date->year()) >= 1900 && int(date->year()) <= 2199, "years have a range", text);
}

/// Every way a command looks at a cell.
void read_cells(const cli::CsvTable& table) {
  for (size_t row = 0; row < table.rows.size(); ++row) {
    for (const std::string& column : table.columns) {
      const auto number = cli::csv_number(table, row, column);
      if (number) require(std::isfinite(*number), "numbers are finite");
      const Error error = cli::csv_error(table, row, column, "message", "hint");
      require(error.span.column >= 1 && size_t(error.span.column - 1) <= table.texts[row].size() &&
                  error.span.length >= 1,
              "a cell lies in its line", table.texts[row]);
    }
    if (require_columns(table, {"lat_deg", "lon_deg", "height_m"})) (void)csv_place(table, row);
  }
}

/// What csv_line writes is read back, but for what a line of a table cannot say.
void require_rows_read_back(const cli::CsvTable& table) {
  const auto writable = [](const std::vector<std::string>& fields) {
    for (const std::string& field : fields)
      if (field.find_first_of("\r\n") != std::string::npos) return false;
    return !fields[0].empty() && !fields[0].starts_with("\xef\xbb\xbf");
  };
  if (!writable(table.columns)) return;
  for (const auto& row : table.rows) {
    if (!writable(row)) continue;
    const auto again = cli::parse_csv(cli::csv_line(table.columns) + cli::csv_line(row), "again");
    require(again.ok() && again->rows.size() == 1, "a written row is a row", cli::csv_line(row));
    for (size_t i = 0; i < row.size(); ++i)
      require(again->rows[0][i] == row[i], "a written field reads back", row[i]);
  }
}

}  // namespace

void quantity(std::string_view bytes) {
  if (bytes.empty() || bytes.size() > 300) return;
  constexpr int kDimensions = int(Dimension::share);  // `none` has no units
  const auto dimension = Dimension(1 + static_cast<unsigned char>(bytes[0]) % kDimensions);
  const std::string_view text = bytes.substr(1);
  if (const auto number = config::parse_number(text))
    require(std::isfinite(*number), "numbers are finite", text);
  if (const auto integer = config::parse_integer(text); !integer)
    require_problem(integer.error(), text);
  const auto value = config::parse_quantity(text, dimension);
  if (!value) return require_problem(value.error(), text);
  require(std::isfinite(*value), "values are finite", text);
  for (const config::UnitName& unit : config::info_of(dimension).units)
    require_round_trip(*value, dimension, unit);
}

void time_expression(std::string_view bytes) {
  if (bytes.size() > 300) return;
  require_same_date(config::parse_date(bytes), bytes);
  if (const auto range = config::parse_date_range(bytes); range)
    require(range->first <= range->last, "ranges go forward", bytes);
  else
    require_problem(range.error(), bytes);
  const auto time = config::parse_time_expression(bytes);
  if (!time) return require_problem(time.error(), bytes);
  require_good_time(*time, bytes);
}

void batch_csv(std::string_view bytes) {
  if (bytes.size() > 1 << 14) return;
  const auto table = cli::parse_csv(std::string(bytes), "rows.csv");
  if (!table) return require_printable({table.error()});
  require(table->rows.size() == table->lines.size() && table->rows.size() == table->texts.size(),
          "every row has its line");
  for (const auto& row : table->rows)
    require(row.size() == table->columns.size(), "rows are as wide as the header");
  if (!table->bad_rows.empty()) require_printable(cli::batch_errors(*table, {}));
  if (table->rows.size() * table->columns.size() > 2000) return;
  read_cells(*table);
  require_rows_read_back(*table);
}

}  // namespace skylapse::fuzz
