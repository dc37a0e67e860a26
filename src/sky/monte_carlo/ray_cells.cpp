#include "sky/monte_carlo/ray_cells.h"

#include <algorithm>

namespace skylapse::sky::monte_carlo {

void RayCells::cut(const Shells& shells, const RayParabola& ray, const Trace& trace,
                   int cells_of_piece) {
  cells_.clear();
  Columns before;
  for (const Trace::Piece& piece : trace.pieces) {
    const double step = (piece.end - piece.begin) / cells_of_piece;
    for (int i = 0; i < cells_of_piece; ++i) {
      const double begin = piece.begin + i * step;
      const Columns columns = shell_columns(shells.shell(piece.shell), ray, begin, begin + step);
      cells_.push_back({begin, step, piece.shell, before, columns});
      before += columns;
    }
  }
}

bool RayCells::finish() {
  double total = 0;
  for (const Cell& cell : cells_) total += cell.weight;
  if (!(total > 0)) {
    cells_.clear();
    return false;
  }
  double cumulative = 0;
  for (Cell& cell : cells_) {
    cell.weight /= total;
    cell.cumulative = cumulative += cell.weight;
  }
  return true;
}

const RayCells::Cell& RayCells::draw(PathRandom& random) const {
  const double u = random.uniform() * cells_.back().cumulative;
  return *std::lower_bound(cells_.begin(), cells_.end() - 1, u,
                           [](const Cell& cell, double value) { return cell.cumulative < value; });
}

double RayCells::density(double distance) const {
  if (cells_.empty()) return 0;
  const auto after =
      std::upper_bound(cells_.begin() + 1, cells_.end(), distance,
                       [](double value, const Cell& cell) { return value < cell.begin; });
  const Cell& cell = *(after - 1);
  return cell.weight / cell.length;
}

}  // namespace skylapse::sky::monte_carlo
