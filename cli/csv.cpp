#include "cli/csv.h"

#include <csv.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>

namespace skylapse::cli {
namespace {

struct Reader {
  CsvTable table;
  std::vector<std::string> row;
};

void on_field(void* text, size_t length, void* data) {
  static_cast<Reader*>(data)->row.emplace_back(static_cast<const char*>(text), length);
}

void on_row(int, void*) {}

Result<std::string> read_all(const std::string& file) {
  std::ostringstream text;
  if (file == "-") {
    text << std::cin.rdbuf();
    return text.str();
  }
  std::ifstream in(file, std::ios::binary);
  if (in) text << in.rdbuf();
  if (!in || in.bad())
    return Error{ErrorCode::missing_input,
                 fmt::format("'{}' cannot be read", file),
                 {},
                 "give a CSV file, or - for standard input"};
  return text.str();
}

Error row_error(const CsvTable& table, int line, std::string message, std::string hint) {
  return {
      ErrorCode::invalid_input, std::move(message), {table.file, line, 1, 1, ""}, std::move(hint)};
}

}  // namespace

int CsvTable::column(const std::string& name) const {
  for (size_t i = 0; i < columns.size(); ++i)
    if (columns[i] == name) return int(i);
  return -1;
}

Result<CsvTable> read_csv(const std::string& file) {
  auto text = read_all(file);
  if (!text) return text.error();
  Reader reader;
  reader.table.file = file == "-" ? "standard input" : file;
  csv_parser parser;
  csv_init(&parser, CSV_STRICT | CSV_APPEND_NULL);
  std::istringstream lines(*text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (number == 1 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);
    if (line.empty() || line[0] == '#') continue;
    line += '\n';
    reader.row.clear();
    if (csv_parse(&parser, line.data(), line.size(), on_field, on_row, &reader) != line.size()) {
      csv_free(&parser);
      return row_error(reader.table, number, "this line is no CSV", "check its quotes");
    }
    if (reader.table.columns.empty()) {
      reader.table.columns = reader.row;
    } else if (reader.row.size() != reader.table.columns.size()) {
      csv_free(&parser);
      return row_error(reader.table, number,
                       fmt::format("this row has {} fields", reader.row.size()),
                       fmt::format("the header names {} columns", reader.table.columns.size()));
    } else {
      reader.table.rows.push_back(reader.row);
      reader.table.lines.push_back(number);
    }
  }
  csv_free(&parser);
  if (reader.table.columns.empty())
    return Error{ErrorCode::invalid_input, fmt::format("{}: there is no header line", file)};
  return std::move(reader.table);
}

Status require_columns(const CsvTable& table, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (table.column(name) >= 0) continue;
    const auto near = nearest_name(name, table.columns);
    return Error{ErrorCode::invalid_input,
                 fmt::format("{}: column '{}' is missing", table.file, name),
                 {},
                 near ? fmt::format("did you mean to call '{}' so?", *near)
                      : fmt::format("needed: {}", fmt::join(names, ","))};
  }
  return Done{};
}

Result<double> csv_number(const CsvTable& table, size_t row, const std::string& column) {
  const std::string& text = table.rows[row][table.column(column)];
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value))
    return row_error(table, table.lines[row], fmt::format("{} = '{}' is no number", column, text),
                     "allowed: a finite number");
  return value;
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (size_t i = 0; i < fields.size(); ++i) line += (i ? "," : "") + csv_field(fields[i]);
  return line + "\n";
}

}  // namespace skylapse::cli
