#pragma once
// Tables of text in RFC 4180 form, read through libcsv.
#include <map>
#include <string>
#include <vector>

#include "core/result.h"

namespace skylapse::cli {

struct CsvTable {
  std::string file;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  // as long as `columns`
  std::vector<int> lines;                      // line of each row, from 1

  /// Index of a column, or -1.
  [[nodiscard]] int column(const std::string& name) const;
};

/// Reads a table from a file, or standard input for "-". Lines that start with '#' and empty
/// lines are passed over; the first other line names the columns. A row of another length is an
/// error with its line.
Result<CsvTable> read_csv(const std::string& file);

/// Columns that must be there; the error names the missing ones and the nearest present name.
Status require_columns(const CsvTable& table, const std::vector<std::string>& names);

/// A finite number in a cell; errors carry file, line and column name.
Result<double> csv_number(const CsvTable& table, size_t row, const std::string& column);

/// Quotes a field if it needs it.
std::string csv_field(const std::string& text);
std::string csv_line(const std::vector<std::string>& fields);

}  // namespace skylapse::cli
