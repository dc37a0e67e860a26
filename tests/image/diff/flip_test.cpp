// FLIP against what the program of its authors answers (tests/data/flip/SOURCE.md).
#include "image/diff/flip.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "image/diff/flip_pairs.h"
#include "image/diff/flip_tiles.h"

namespace skylapse::image {
namespace {

using flip_internal::InstructionSet;
using flip_internal::kernels_of;

/// Rows of a table, without comments and the names of its columns.
std::vector<std::string> rows_of(const std::string& name) {
  std::ifstream file(std::string(SKYLAPSE_TEST_DATA) + "/flip/" + name);
  std::vector<std::string> rows;
  for (std::string line; std::getline(file, line);)
    if (!line.empty() && line[0] != '#') rows.push_back(line);
  if (rows.size() < 2) throw std::runtime_error("no rows in " + name);
  rows.erase(rows.begin());
  return rows;
}

struct PublishedValue {
  std::string quantity;
  int x = -1, y = -1;
  double published = 0, in_double = 0;
};

std::map<std::string, std::vector<PublishedValue>> published_values() {
  std::map<std::string, std::vector<PublishedValue>> values;
  for (const std::string& row : rows_of("values.tsv")) {
    std::istringstream in(row);
    std::string pair, x, y;
    PublishedValue value;
    in >> pair >> value.quantity >> x >> y >> value.published >> value.in_double;
    if (!in) throw std::runtime_error("short row: " + row);
    if (x != "-") value.x = std::stoi(x), value.y = std::stoi(y);
    values[pair].push_back(value);
  }
  return values;
}

double quantity_of(const FlipResult& result, int width, const PublishedValue& value) {
  if (value.quantity == "pixel")
    return result.map[size_t(value.y) * size_t(width) + size_t(value.x)];
  const std::map<std::string, double> pooled{{"mean", result.mean},
                                             {"min", result.minimum},
                                             {"max", result.maximum},
                                             {"weighted_quartile_1", result.weighted_quartile_1},
                                             {"weighted_median", result.weighted_median},
                                             {"weighted_quartile_3", result.weighted_quartile_3},
                                             {"start_exposure", result.start},
                                             {"stop_exposure", result.stop},
                                             {"num_exposures", result.exposures}};
  return pooled.at(value.quantity);
}

TEST(FlipPairs, AreTheBytesThatThePublishedProgramSaw) {
  for (const std::string& row : rows_of("pairs.tsv")) {
    const FlipPair pair = flip_pair(row);
    // A maths library may differ in the last bit of floats, which changes no value by 1e-4.
    if (!pair.reference.display_referred) continue;
    EXPECT_EQ(fnv1a_of(pair.reference), pair.reference_fnv1a) << pair.name;
    EXPECT_EQ(fnv1a_of(pair.test), pair.test_fnv1a) << pair.name;
  }
}

/// The two columns differ by up to 6e-5 themselves; 1e-4 from either is asked for, both are
/// checked.
TEST(Flip, IsWithinATenThousandthOfThePublishedProgramOnAllInstructionSets) {
  const auto values = published_values();
  size_t checked = 0;
  for (const std::string& row : rows_of("pairs.tsv")) {
    const FlipPair pair = flip_pair(row);
    for (const auto set : {InstructionSet::baseline, InstructionSet::v3, InstructionSet::v4}) {
      const auto* kernels = kernels_of(set);
      if (kernels == nullptr) continue;
      const FlipResult result =
          flip_internal::flip_with(*kernels, pair.reference, pair.test, pair.options);
      for (const PublishedValue& value : values.at(pair.name)) {
        const double ours = quantity_of(result, pair.reference.width, value);
        const double tolerance = value.quantity == "num_exposures" ? 0 : 1e-4;
        EXPECT_NEAR(ours, value.published, tolerance)
            << pair.name << " " << value.quantity << " " << value.x << " " << value.y;
        EXPECT_NEAR(ours, value.in_double, tolerance)
            << pair.name << " " << value.quantity << " " << value.x << " " << value.y;
        ++checked;
      }
    }
  }
  EXPECT_GE(checked, 250u);
}

TEST(Flip, IsTheSameToTheLastBitOnAllInstructionSets) {
  for (const std::string& row : rows_of("pairs.tsv")) {
    const FlipPair pair = flip_pair(row);
    const auto baseline = flip_internal::flip_with(*kernels_of(InstructionSet::baseline),
                                                   pair.reference, pair.test, pair.options);
    for (const auto set : {InstructionSet::v3, InstructionSet::v4}) {
      const auto* kernels = kernels_of(set);
      if (kernels == nullptr) continue;
      const auto wide = flip_internal::flip_with(*kernels, pair.reference, pair.test, pair.options);
      EXPECT_EQ(wide.map, baseline.map) << pair.name;
    }
  }
}

}  // namespace
}  // namespace skylapse::image
