#pragma once
// Reads the tables of tests/data/solar.
#include <map>
#include <string>
#include <vector>

#include "astro/sky_state.h"
#include "astro/time/instant.h"

namespace skylapse::astro::test {

/// One row; asking for a column that is not there fails the test loudly (throws).
class TableRow {
 public:
  explicit TableRow(std::map<std::string, std::string> cells) : cells_(std::move(cells)) {}
  [[nodiscard]] const std::string& text(const std::string& column) const {
    return cells_.at(column);
  }
  [[nodiscard]] double number(const std::string& column) const { return std::stod(text(column)); }
  [[nodiscard]] bool has(const std::string& column) const { return text(column) != "-"; }
  [[nodiscard]] Angle angle(const std::string& column) const { return number(column) * deg; }
  [[nodiscard]] Instant instant(const std::string& column) const;
  [[nodiscard]] GeodeticPosition position() const;
  /// "zenith 2010-04-16T21:43:02Z", to name a row in a message.
  [[nodiscard]] std::string label() const { return text("case") + " " + text("utc"); }

 private:
  std::map<std::string, std::string> cells_;
};

/// All rows of tests/data/solar/`file`; throws if there are none.
std::vector<TableRow> read_solar_table(const std::string& file);

/// A time that the test itself wrote correctly.
Instant utc(const std::string& text);

}  // namespace skylapse::astro::test
