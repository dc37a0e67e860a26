#include "solar_table.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace skylapse::astro::test {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, '\t');) cells.push_back(cell);
  return cells;
}

}  // namespace

Instant utc(const std::string& text) {
  const Result<Instant> parsed = parse_instant(text);
  if (!parsed) throw std::runtime_error(parsed.error().message);
  return *parsed;
}

Instant TableRow::instant(const std::string& column) const { return utc(text(column)); }

GeodeticPosition TableRow::position() const {
  return {angle("latitude"), angle("longitude"), number("height_m") * metre};
}

std::vector<TableRow> read_solar_table(const std::string& file) {
  std::ifstream in(std::string(SKYLAPSE_TEST_DATA) + "/solar/" + file);
  std::vector<std::string> columns;
  std::vector<TableRow> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.front() == '#') continue;
    const std::vector<std::string> cells = split(line);
    if (columns.empty()) {
      columns = cells;
      continue;
    }
    if (cells.size() != columns.size())
      throw std::runtime_error("bad row in " + file + ": " + line);
    std::map<std::string, std::string> row;
    for (size_t i = 0; i < cells.size(); ++i) row[columns[i]] = cells[i];
    rows.emplace_back(std::move(row));
  }
  if (rows.empty()) throw std::runtime_error("no rows in " + file);
  return rows;
}

}  // namespace skylapse::astro::test
