#include "sky/monte_carlo/first_collision.h"

#include <algorithm>

namespace skylapse::sky::monte_carlo {
namespace {

constexpr int kCellsOfPiece = 32;
/// Share of draws that follow single scattering; the others follow density times transmittance, so
/// that multiply scattered light in the planet's shadow is found too.
constexpr double kShareOfSunlight = 0.6;

}  // namespace

FirstCollision::FirstCollision(const Optics& optics, const Place& place,
                               const glm::dvec3& direction, const glm::dvec3& to_sun)
    : optics_(optics),
      place_(place),
      direction_(direction),
      ray_(optics.shells.radius(), place.height, glm::dot(place.up, direction)) {
  optics.shells.follow(place.height, glm::dot(place.up, direction), trace_);
  optics.transmittances(trace_.total, through_);
  Columns before;
  for (const Trace::Piece& piece : trace_.pieces) {
    const double step = (piece.end - piece.begin) / kCellsOfPiece;
    for (int i = 0; i < kCellsOfPiece; ++i) {
      const double begin = piece.begin + i * step;
      cells_.push_back({begin, step, piece.shell, before, 0, 0});
      before += shell_columns(optics.shells.shell(piece.shell), ray_, begin, begin + step);
    }
  }
  weigh(to_sun);
}

/// Each band has an equal say in where the paths go.
void FirstCollision::weigh(const glm::dvec3& to_sun) {
  const int bands = optics_.bands;
  std::vector<PerBand> sunlit(cells_.size()), natural(cells_.size());
  PerBand sunlit_sum{}, natural_sum{}, transmittance;
  SunView sun;
  for (size_t i = 0; i < cells_.size(); ++i) {
    const Cell& cell = cells_[i];
    const double half = cell.length / 2;
    const Place middle = place_.moved(ray_.radius, direction_, cell.begin + half);
    const Columns density = optics_.shells.densities(middle.height);
    const Columns to_middle = cell.before + shell_columns(optics_.shells.shell(cell.shell), ray_,
                                                          cell.begin, cell.begin + half);
    optics_.transmittances(to_middle, transmittance);
    optics_.view_sun(middle.height, glm::dot(middle.up, to_sun), SunVisibility::smooth_step, sun);
    const double nu = glm::dot(direction_, to_sun);
    const double molecules = optics_.rayleigh_phase.at(nu);
    const double particles = optics_.aerosol_phase.at(nu);
    for (int b = 0; b < bands; ++b) {
      const double r = optics_.rayleigh[b] * density.rayleigh;
      const double a = optics_.aerosol[b] * density.aerosol;
      const double seen = transmittance[b] * cell.length;
      natural[i][b] = (r + a) * seen;
      sunlit[i][b] = sun.visible > 0 ? (r * molecules + a * particles) * seen * sun.visible *
                                           sun.transmittance[b]
                                     : 0;
      natural_sum[b] += natural[i][b];
      sunlit_sum[b] += sunlit[i][b];
    }
  }
  double total = 0;
  for (size_t i = 0; i < cells_.size(); ++i) {
    for (int b = 0; b < bands; ++b) {
      if (!(natural_sum[b] > 0)) continue;
      const bool lit = sunlit_sum[b] > 0;
      const double share = lit ? kShareOfSunlight : 0;
      cells_[i].weight += (1 - share) * natural[i][b] / natural_sum[b];
      if (lit) cells_[i].weight += share * sunlit[i][b] / sunlit_sum[b];
    }
    total += cells_[i].weight;
  }
  if (!(total > 0)) return cells_.clear();
  double cumulative = 0;
  for (Cell& cell : cells_) {
    cell.weight /= total;
    cell.cumulative = cumulative += cell.weight;
  }
}

Place FirstCollision::ground() const {
  Place ground = place_.moved(ray_.radius, direction_, trace_.length);
  ground.height = 0;
  return ground;
}

Place FirstCollision::sample(PathRandom& random, PerBand& factor) const {
  const double u = random.uniform() * cells_.back().cumulative;
  const auto found =
      std::lower_bound(cells_.begin(), cells_.end(), u,
                       [](const Cell& cell, double value) { return cell.cumulative < value; });
  const Cell& cell = found != cells_.end() ? *found : cells_.back();
  const double t = cell.begin + random.uniform() * cell.length;
  const Columns columns =
      cell.before + shell_columns(optics_.shells.shell(cell.shell), ray_, cell.begin, t);
  optics_.transmittances(columns, factor);
  const double inverse_density = cell.length / cell.weight;
  for (int b = 0; b < optics_.bands; ++b) factor[b] *= inverse_density;
  return place_.moved(ray_.radius, direction_, t);
}

}  // namespace skylapse::sky::monte_carlo
