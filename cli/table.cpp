#include "cli/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "cli/csv.h"

namespace skylapse::cli {
namespace {

/// Numbers to the right, text to the left.
std::string padded(const std::string& text, size_t width, bool number) {
  const std::string blanks(width > text.size() ? width - text.size() : 0, ' ');
  return number ? blanks + text : text + blanks;
}

std::string aligned(const Table& table) {
  std::vector<std::vector<Cell>> lines{{}};
  for (size_t c = 0; c < table.columns.size(); ++c)
    lines[0].push_back({table.columns[c], !table.rows.empty() && table.rows[0][c].number});
  lines.insert(lines.end(), table.rows.begin(), table.rows.end());
  std::vector<size_t> widths(table.columns.size());
  for (const auto& line : lines)
    for (size_t c = 0; c < widths.size(); ++c) widths[c] = std::max(widths[c], line[c].text.size());
  std::string text;
  for (const auto& line : lines) {
    std::string row;
    for (size_t c = 0; c < widths.size(); ++c)
      row += (c ? "  " : "") + padded(line[c].text, widths[c], line[c].number);
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + "\n";
  }
  return text;
}

std::string as_csv(const Table& table) {
  std::string text = csv_line(table.columns);
  for (const auto& row : table.rows) {
    std::vector<std::string> fields;
    for (const Cell& cell : row) fields.push_back(cell.text);
    text += csv_line(fields);
  }
  return text;
}

std::string as_json(const Table& table) {
  auto rows = nlohmann::ordered_json::array();
  for (const auto& row : table.rows) {
    nlohmann::ordered_json object;
    for (size_t c = 0; c < row.size(); ++c) {
      const double value = row[c].number ? std::strtod(row[c].text.c_str(), nullptr) : 0;
      if (!row[c].number)
        object[table.columns[c]] = row[c].text;
      else if (std::isfinite(value))
        object[table.columns[c]] = value;
      else
        object[table.columns[c]] = nullptr;
    }
    rows.push_back(std::move(object));
  }
  // Names in another encoding than UTF-8 lose those bytes; JSON cannot carry them.
  return rows.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

Result<TableFormat> table_format_from_name(const std::string& name) {
  if (name == "table") return TableFormat::table;
  if (name == "csv") return TableFormat::csv;
  if (name == "json") return TableFormat::json;
  return Error{ErrorCode::invalid_input,
               fmt::format("--format: '{}' is unknown", name),
               {},
               "allowed: table, csv, json"};
}

Cell number_cell(double value, int decimals) {
  return {std::isnan(value) ? "nan" : fmt::format("{:.{}f}", value, decimals), true};
}

Cell text_cell(std::string text) { return {std::move(text), false}; }

std::string format_table(const Table& table, TableFormat format) {
  switch (format) {
    case TableFormat::csv:
      return as_csv(table);
    case TableFormat::json:
      return as_json(table);
    case TableFormat::table:
      break;
  }
  return aligned(table);
}

}  // namespace skylapse::cli
