#pragma once
// Rows of a comma-separated test table, by column name.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace skylapse::test {

class CsvRow {
 public:
  explicit CsvRow(std::map<std::string, std::string> fields) : fields_(std::move(fields)) {}
  [[nodiscard]] const std::string& text(const std::string& column) const {
    return fields_.at(column);
  }
  [[nodiscard]] double number(const std::string& column) const {
    return std::strtod(fields_.at(column).c_str(), nullptr);
  }

 private:
  std::map<std::string, std::string> fields_;
};

inline std::vector<std::string> split_commas(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> fields;
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

/// All rows of tests/data/<path>; a missing file gives none, which callers assert against.
inline std::vector<CsvRow> csv_rows(const std::string& path) {
  std::ifstream in(std::string(SKYLAPSE_TEST_DATA) + "/" + path);
  std::string line;
  std::getline(in, line);
  const auto names = split_commas(line);
  std::vector<CsvRow> rows;
  while (std::getline(in, line)) {
    const auto values = split_commas(line);
    std::map<std::string, std::string> fields;
    for (size_t i = 0; i < names.size(); ++i) fields[names[i]] = values.at(i);
    rows.emplace_back(std::move(fields));
  }
  return rows;
}

}  // namespace skylapse::test
