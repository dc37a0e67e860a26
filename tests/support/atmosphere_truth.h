#pragma once
// Reads the tables of tests/data.
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace skylapse {

/// One row: column name -> number.
using TruthRow = std::map<std::string, double>;

/// All rows of tests/data/<folder>/<name>. Throws when the file is missing, a row has not as many
/// numbers as there are columns, or there is no row: a truth that is not there must not pass.
inline std::vector<TruthRow> read_truth(const std::string& name,
                                        const std::string& folder = "atmosphere") {
  const std::string path = std::string(SKYLAPSE_TEST_DATA) + "/" + folder + "/" + name;
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::vector<std::string> columns;
  std::vector<TruthRow> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream cells(line);
    if (columns.empty()) {
      for (std::string cell; cells >> cell;) columns.push_back(cell);
      continue;
    }
    TruthRow row;
    for (const std::string& column : columns)
      if (!(cells >> row[column])) throw std::runtime_error("short row in " + path + ": " + line);
    rows.push_back(row);
  }
  if (rows.empty()) throw std::runtime_error("no rows in " + path);
  return rows;
}

}  // namespace skylapse
