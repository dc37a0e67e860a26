#pragma once
// Tables of text in RFC 4180 form, read through libcsv.
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "core/quantity.h"
#include "core/result.h"

namespace skylapse::cli {

struct CsvTable {
  std::string file;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  // as long as `columns`
  std::vector<int> lines;                      // line of each row, from 1
  std::vector<std::string> texts;              // each row as it stands in the file
  Diagnostics bad_rows;                        // lines that are no row of this table

  /// Index of a column, or -1.
  [[nodiscard]] int column(const std::string& name) const;
};

/// Most errors that one batch reports.
inline constexpr size_t kMaxBatchErrors = 20;

/// Reads a table from a file, or standard input for "-". Lines that start with '#' and lines
/// that are empty or blank are passed over; the first other line names the columns, each once. A
/// row is one line. Rows of another length and unclosed quotes are collected in `bad_rows`. Errors:
/// missing_input (cannot be read, is a folder), invalid_input (no header, a column named twice).
Result<CsvTable> read_csv(const std::string& file);
/// The same for text; `name` is used in messages.
Result<CsvTable> parse_csv(std::string text, std::string name);

/// Columns that must be there; the error names the missing ones and the nearest present name.
Status require_columns(const CsvTable& table, const std::vector<std::string>& names);

/// An invalid_input error that points at a cell.
Error csv_error(const CsvTable& table, size_t row, const std::string& column,
                const std::string& message, const std::string& hint);

/// The text of a cell of a column that is there.
const std::string& csv_text(const CsvTable& table, size_t row, const std::string& column);

/// A finite decimal number in a cell, inside [lowest, highest]; errors point at the cell.
Result<double> csv_number(const CsvTable& table, size_t row, const std::string& column);
Result<double> csv_number(const CsvTable& table, size_t row, const std::string& column,
                          double lowest, double highest);

/// A place on the Earth.
struct CsvPlace {
  Angle latitude, longitude;
  Length height;
};
/// From lat_deg (-90 to 90), lon_deg (-720 to 720, so that tables that count on past a turn can be
/// read) and height_m (-500 to 100000).
Result<CsvPlace> csv_place(const CsvTable& table, size_t row);

/// The errors in the order of their lines; after kMaxBatchErrors one line says that there are more.
Diagnostics batch_errors(const CsvTable& table, Diagnostics errors);

/// `convert` applied to each row: all its values, or the errors of all bad rows, one a row.
template <class T>
Result<std::vector<T>, Diagnostics> convert_rows(const CsvTable& table,
                                                 const std::function<Result<T>(size_t)>& convert) {
  std::vector<T> values;
  Diagnostics errors;
  for (size_t i = 0; i < table.rows.size() && errors.size() <= kMaxBatchErrors; ++i) {
    auto value = convert(i);
    if (!value)
      errors.push_back(std::move(value).error());
    else if (errors.empty())
      values.push_back(*std::move(value));
  }
  if (!errors.empty() || !table.bad_rows.empty()) return batch_errors(table, std::move(errors));
  return values;
}

/// Quotes a field if it needs it.
std::string csv_field(const std::string& text);
std::string csv_line(const std::vector<std::string>& fields);

}  // namespace skylapse::cli
