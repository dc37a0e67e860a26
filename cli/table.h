#pragma once
// One table of results in the three formats that commands offer.
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"

namespace skylapse::cli {

enum class TableFormat { table, csv, json };
Result<TableFormat> table_format_from_name(const std::string& name);

/// A cell: its text, and whether it is a number (JSON then carries it unquoted; nan becomes null).
struct Cell {
  std::string text;
  bool number = false;
};
Cell number_cell(double value, int decimals);
Cell text_cell(std::string text);

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;
};

/// table: aligned for reading; csv: a header and lines; json: an array of objects.
std::string format_table(const Table& table, TableFormat format);

}  // namespace skylapse::cli
