// Turns a number table of data/ into a C++ array, so that nothing is parsed at run time.
//   embed_table TABLE HEADER SOURCE
// data/README.md describes the table format. Every row carries its key values; a row that is
// missing, out of order or of the wrong width stops the build with file and line.
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace {

struct Axis {
  std::string name;
  std::vector<std::string> values;  // as printed in the rows
};

struct Table {
  std::string file;
  std::string name, title, source, licence, unit, note;
  std::vector<Axis> axes;  // outermost first
  std::vector<std::string> columns;
  std::vector<std::string> numbers;  // last axis, then column, vary fastest
};

[[noreturn]] void fail(const std::string& file, int line, const std::string& message) {
  std::cerr << file << ":" << line << ": error: " << message << "\n";
  std::exit(1);
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> result;
  for (std::string word; in >> word;) result.push_back(word);
  return result;
}

bool is_number(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(std::strtod(text.c_str(), nullptr));
}

/// "320 to 720 by 40", several such parts joined by commas, or plain words.
std::vector<std::string> axis_values(const std::string& text) {
  if (text.find(" to ") == std::string::npos) return words(text);
  std::vector<std::string> values;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    double first = 0, last = 0, step = 0;
    if (std::sscanf(part.c_str(), "%lf to %lf by %lf", &first, &last, &step) != 3 || step <= 0)
      return {};
    for (int i = 0; first + i * step <= last + step / 2; ++i) {
      std::ostringstream value;
      value << first + i * step;
      values.push_back(value.str());
    }
  }
  return values;
}

bool same_key(const std::string& a, const std::string& b) {
  return a == b || (is_number(a) && is_number(b) &&
                    std::strtod(a.c_str(), nullptr) == std::strtod(b.c_str(), nullptr));
}

void read_header_line(Table& table, const std::string& line, int number) {
  const size_t colon = line.find(": ");
  if (colon == std::string::npos) fail(table.file, number, "expected 'key: value'");
  const std::string key = line.substr(0, colon);
  const std::string value = line.substr(colon + 2);
  if (key == "name")
    table.name = value;
  else if (key == "title")
    table.title = value;
  else if (key == "source")
    table.source = value;
  else if (key == "licence")
    table.licence = value;
  else if (key == "unit")
    table.unit = value;
  else if (key == "note")
    table.note = value;
  else if (key == "columns")
    table.columns = words(value);
  else if (key == "axis") {
    const size_t equals = value.find(" = ");
    if (equals == std::string::npos) fail(table.file, number, "expected 'axis: name = values'");
    table.axes.push_back({value.substr(0, equals), axis_values(value.substr(equals + 3))});
    if (table.axes.back().values.empty()) fail(table.file, number, "axis without values");
  } else {
    fail(table.file, number, "unknown key '" + key + "'");
  }
}

void read_row(Table& table, const std::string& line, int number, size_t row) {
  const std::vector<std::string> fields = words(line);
  if (fields.size() != table.axes.size() + 1 + table.columns.size() ||
      fields[table.axes.size()] != "|")
    fail(table.file, number, "expected one key per axis, '|', one number per column");
  for (size_t a = table.axes.size(); a-- > 0;) {
    const auto& values = table.axes[a].values;
    if (!same_key(fields[a], values[row % values.size()]))
      fail(table.file, number, table.axes[a].name + " should be " + values[row % values.size()]);
    row /= values.size();
  }
  for (size_t i = table.axes.size() + 1; i < fields.size(); ++i) {
    if (!is_number(fields[i])) fail(table.file, number, "not a number: " + fields[i]);
    table.numbers.push_back(fields[i]);
  }
}

Table read_table(const std::string& path) {
  std::ifstream in(path);
  Table table;
  table.file = path;
  std::string line;
  int number = 1;
  if (!std::getline(in, line) || line != "skylapse-table 1")
    fail(path, number, "expected 'skylapse-table 1'");
  while (++number, std::getline(in, line) && line != "rows:") read_header_line(table, line, number);
  for (const std::string* text :
       {&table.name, &table.title, &table.source, &table.licence, &table.unit})
    if (text->empty()) fail(path, number, "name, title, source, licence and unit are needed");
  if (table.axes.empty() || table.columns.empty()) fail(path, number, "axis and columns missing");
  size_t expected = 1;
  for (const Axis& axis : table.axes) expected *= axis.values.size();
  size_t row = 0;
  while (++number, std::getline(in, line)) {
    if (row == expected) fail(path, number, "more rows than the axes allow");
    read_row(table, line, number, row++);
  }
  if (row != expected) fail(path, number, "rows missing: " + std::to_string(expected - row));
  return table;
}

std::string pascal_case(const std::string& text) {
  std::string result;
  bool upper = true;
  for (const char c : text) {
    if (c == '_')
      upper = true;
    else
      result += upper ? static_cast<char>(std::toupper(c)) : c, upper = false;
  }
  return result;
}

std::string array_type(const Table& table) {
  std::string type = "double";
  auto wrap = [&](size_t n) { type = "std::array<" + type + ", " + std::to_string(n) + ">"; };
  wrap(table.columns.size());
  for (size_t a = table.axes.size(); a-- > 0;) wrap(table.axes[a].values.size());
  return type;
}

void write_names(std::ostream& out, const std::string& name, const std::vector<std::string>& values,
                 bool numeric) {
  out << "inline constexpr std::array<" << (numeric ? "double" : "std::string_view") << ", "
      << values.size() << "> " << name << "{";
  for (const std::string& v : values) out << (numeric ? v : "\"" + v + "\"") << ", ";
  out << "};\n";
}

void write_header(std::ostream& out, const Table& table) {
  const std::string constant = "k" + pascal_case(table.name);
  out << "#pragma once\n// Made from " << table.file.substr(table.file.find_last_of('/') + 1)
      << " by tools/embed_table; edit the table, not this file.\n"
      << "#include <array>\n#include <string_view>\n\nnamespace skylapse::data {\n\n";
  for (const Axis& axis : table.axes)
    write_names(out, constant + pascal_case(axis.name), axis.values, is_number(axis.values[0]));
  write_names(out, constant + "Columns", table.columns, false);
  out << "\n/// " << table.title << ".\n/// Unit     " << table.unit << "\n";
  if (!table.note.empty()) out << "/// Note     " << table.note << "\n";
  out << "/// Source   " << table.source << "\n/// Licence  " << table.licence << "\n/// Indices  ";
  for (const Axis& axis : table.axes) out << "[" << axis.name << "]";
  out << "[column]\nextern const " << array_type(table) << " " << constant << ";\n\n"
      << "}  // namespace skylapse::data\n";
}

void write_source(std::ostream& out, const Table& table) {
  const std::string constant = "k" + pascal_case(table.name);
  out << "#include \"data/" << table.name << ".h\"\n\nnamespace skylapse::data {\n"
      << "constexpr " << array_type(table) << " " << constant << " = {\n";
  for (size_t i = 0; i < table.numbers.size(); ++i)
    out << table.numbers[i] << ((i + 1) % table.columns.size() == 0 ? ",\n" : ", ");
  out << "};\n}  // namespace skylapse::data\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: embed_table TABLE HEADER SOURCE\n";
    return 3;
  }
  const Table table = read_table(argv[1]);
  std::ofstream header(argv[2]), source(argv[3]);
  write_header(header, table);
  write_source(source, table);
  header.close();
  source.close();
  if (!header || !source) fail(argv[1], 0, "cannot write the generated files");
}
