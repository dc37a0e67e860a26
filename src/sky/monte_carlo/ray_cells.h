#pragma once
// A ray cut into cells with a weight each: a density from which distances are drawn where a sampler
// knows better than density times transmittance.
#include <vector>

#include "sky/monte_carlo/random.h"
#include "sky/monte_carlo/shells.h"

namespace skylapse::sky::monte_carlo {

class RayCells {
 public:
  struct Cell {
    double begin, length;  // km along the ray
    int shell;
    Columns before;   // from the ray's start to the cell
    Columns columns;  // of the cell
    double weight = 0, cumulative = 0;
  };

  /// Cuts each piece of `trace` into `cells_of_piece` equal cells; weights are to be set.
  void cut(const Shells& shells, const RayParabola& ray, const Trace& trace, int cells_of_piece);
  [[nodiscard]] std::vector<Cell>& cells() { return cells_; }
  /// Makes the weights sum to 1. False, and no cells, if they sum to 0.
  bool finish();
  [[nodiscard]] bool empty() const { return cells_.empty(); }

  /// A cell by its weight.
  [[nodiscard]] const Cell& draw(PathRandom& random) const;
  /// Probability density of a distance [1/km].
  [[nodiscard]] double density(double distance) const;

 private:
  std::vector<Cell> cells_;
};

}  // namespace skylapse::sky::monte_carlo
