#include "cli/csv.h"

#include <csv.h>
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <sstream>

#include "config/quantity_parser.h"

namespace skylapse::cli {
namespace {

/// One line as libcsv reads it.
struct LineReader {
  std::vector<std::string> fields;
  bool complete = false;
};

void on_field(void* text, size_t length, void* data) {
  static_cast<LineReader*>(data)->fields.emplace_back(static_cast<const char*>(text), length);
}

void on_row(int, void* data) { static_cast<LineReader*>(data)->complete = true; }

/// A parser of its own for each line: after a faulty line the next is read afresh.
struct LineError {
  std::string message, hint;
};
Result<std::vector<std::string>, LineError> parse_line(std::string line) {
  if (line.find('\r') != std::string::npos)  // libcsv would begin a row there
    return LineError{"a carriage return stands inside the line", "lines end with LF or CR LF"};
  line += '\n';
  csv_parser parser;
  csv_init(&parser, CSV_STRICT | CSV_APPEND_NULL);
  LineReader reader;
  const size_t parsed = csv_parse(&parser, line.data(), line.size(), on_field, on_row, &reader);
  csv_free(&parser);
  if (parsed != line.size())
    return LineError{"a quote stands inside a field",
                     "quote the whole field, and write a quote in it twice"};
  if (!reader.complete)
    return LineError{"a quote is opened and not closed", "a field ends on the line it began on"};
  return std::move(reader.fields);
}

/// Read through stdio, which reports that a folder cannot be read (std::ifstream gives no text).
Result<std::string> read_all(const std::string& file) {
  const auto close = [](std::FILE* f) {
    if (f != stdin) std::fclose(f);
  };
  const std::unique_ptr<std::FILE, decltype(close)> in(
      file == "-" ? stdin : std::fopen(file.c_str(), "rb"), close);
  std::string text;
  std::vector<char> block(1 << 16);
  if (in)
    while (const size_t got = std::fread(block.data(), 1, block.size(), in.get()))
      text.append(block.data(), got);
  if (!in || std::ferror(in.get()))
    return Error{ErrorCode::missing_input,
                 fmt::format("'{}' cannot be read", file),
                 {},
                 "give a CSV file, or - for standard input"};
  return text;
}

/// Where field `index` of a line begins, and how long it is with its quotes.
std::pair<size_t, size_t> field_place(const std::string& line, int index) {
  size_t begin = 0;
  bool quoted = false;
  for (size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i < line.size() && (quoted || line[i] != ',')) continue;
    if (index-- == 0) return {begin, i - begin};
    begin = i + 1;
  }
  return {0, line.size()};
}

SourceSpan field_span(const std::string& file, int line, const std::string& text, int index) {
  const auto [begin, length] = field_place(text, index);
  return {file, line, int(begin) + 1, std::max(1, int(length)), text};
}

/// The header's columns; a name that stands twice is an error (empty names are no names).
Status take_header(CsvTable& table, std::vector<std::string> names, const std::string& line,
                   int number) {
  for (size_t i = 0; i < names.size(); ++i)
    if (!names[i].empty() &&
        std::find(names.begin(), names.begin() + int(i), names[i]) != names.begin() + int(i))
      return Error{ErrorCode::invalid_input, fmt::format("column '{}' is named twice", names[i]),
                   field_span(table.file, number, line, int(i)), "name each column once"};
  table.columns = std::move(names);
  return Done{};
}

void take_row(CsvTable& table, std::vector<std::string> fields, std::string line, int number) {
  if (fields.size() == table.columns.size()) {
    table.rows.push_back(std::move(fields));
    table.lines.push_back(number);
    table.texts.push_back(std::move(line));
  } else if (table.bad_rows.size() <= kMaxBatchErrors) {
    table.bad_rows.push_back({ErrorCode::invalid_input,
                              fmt::format("this row has {} fields", fields.size()),
                              {table.file, number, 1, int(line.size()), line},
                              fmt::format("the header names {} columns", table.columns.size())});
  }
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
  return parse_csv(*std::move(text), file == "-" ? "standard input" : file);
}

Result<CsvTable> parse_csv(std::string text, std::string name) {
  CsvTable table;
  table.file = std::move(name);
  std::istringstream lines(std::move(text));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (number == 1 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);
    if (line.find_first_not_of(" \t\r") == std::string::npos || line[0] == '#') continue;
    auto fields = parse_line(line);
    if (!fields) {
      Error error{ErrorCode::invalid_input,
                  fields.error().message,
                  {table.file, number, int(line.find_first_of("\"\r")) + 1, 1, line},
                  fields.error().hint};
      if (table.columns.empty()) return error;
      if (table.bad_rows.size() <= kMaxBatchErrors) table.bad_rows.push_back(std::move(error));
    } else if (table.columns.empty()) {
      const Status header = take_header(table, *std::move(fields), line, number);
      if (!header) return header.error();
    } else {
      take_row(table, *std::move(fields), line, number);
    }
  }
  if (table.columns.empty())
    return Error{ErrorCode::invalid_input, fmt::format("{}: there is no header line", table.file)};
  return table;
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

Error csv_error(const CsvTable& table, size_t row, const std::string& column,
                const std::string& message, const std::string& hint) {
  return {ErrorCode::invalid_input, message,
          field_span(table.file, table.lines[row], table.texts[row], table.column(column)), hint};
}

const std::string& csv_text(const CsvTable& table, size_t row, const std::string& column) {
  return table.rows[row][table.column(column)];
}

Result<double> csv_number(const CsvTable& table, size_t row, const std::string& column) {
  const std::string& text = csv_text(table, row, column);
  const auto value = config::parse_number(text);
  if (!value)
    return csv_error(table, row, column, fmt::format("{} = '{}' is no number", column, text),
                     "allowed: a finite decimal number");
  return *value;
}

Result<double> csv_number(const CsvTable& table, size_t row, const std::string& column,
                          double lowest, double highest) {
  const auto value = csv_number(table, row, column);
  if (!value) return value.error();
  if (*value < lowest || *value > highest)
    return csv_error(table, row, column, fmt::format("{} = {} is out of range", column, *value),
                     fmt::format("allowed: {} to {}", lowest, highest));
  return value;
}

Result<CsvPlace> csv_place(const CsvTable& table, size_t row) {
  const auto latitude = csv_number(table, row, "lat_deg", -90, 90);
  if (!latitude) return latitude.error();
  const auto longitude = csv_number(table, row, "lon_deg", -720, 720);
  if (!longitude) return longitude.error();
  const auto height = csv_number(table, row, "height_m", -500, 100'000);
  if (!height) return height.error();
  return CsvPlace{*latitude * deg, *longitude * deg, *height * metre};
}

Diagnostics batch_errors(const CsvTable& table, Diagnostics errors) {
  errors.insert(errors.end(), table.bad_rows.begin(), table.bad_rows.end());
  std::stable_sort(errors.begin(), errors.end(),
                   [](const Error& a, const Error& b) { return a.span.line < b.span.line; });
  if (errors.size() > kMaxBatchErrors) {
    errors.resize(kMaxBatchErrors);
    errors.push_back({ErrorCode::invalid_input, fmt::format("{}: more rows are wrong than these {}",
                                                            table.file, kMaxBatchErrors)});
  }
  return errors;
}

std::string csv_field(const std::string& text) {
  // Blanks at the ends are dropped by readers, and a line that begins with '#' is a remark.
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  const bool plain = text.find_first_of(",\"\n\r") == std::string::npos && !text.starts_with('#') &&
                     (text.empty() || (!blank(text.front()) && !blank(text.back())));
  if (plain) return text;
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
