#include "sky/monte_carlo/first_collision.h"

#include <numbers>
#include <vector>

namespace skylapse::sky::monte_carlo {
namespace {

constexpr int kCellsOfPiece = 32;
/// Shares of draws that follow single scattering, and the guide to multiply scattered light; the
/// others follow density times transmittance.
struct Shares {
  double sunlight, guide;
};
constexpr Shares kAllOrders{0.5, 0.3}, kHigherOrders{0, 0.6};
/// Sums below this are none: their reciprocals would overflow.
constexpr double kLeastSum = 1e-250;

}  // namespace

FirstCollision::FirstCollision(const Optics& optics, const Place& place,
                               const glm::dvec3& direction, const glm::dvec3& to_sun, int min_order)
    : optics_(optics),
      place_(place),
      direction_(direction),
      ray_(optics.shells.radius(), place.height, glm::dot(place.up, direction)) {
  optics.shells.follow(place.height, glm::dot(place.up, direction), trace_);
  optics.transmittances(trace_.total, through_);
  cells_.cut(optics.shells, ray_, trace_, kCellsOfPiece);
  weigh(to_sun, min_order);
}

/// Each band has an equal say in where the paths go.
void FirstCollision::weigh(const glm::dvec3& to_sun, int min_order) {
  const Shares share = min_order > 1 ? kHigherOrders : kAllOrders;
  const int bands = optics_.bands;
  std::vector<RayCells::Cell>& cells = cells_.cells();
  std::vector<PerBand> sunlit(cells.size()), natural(cells.size());
  std::vector<double> guide(cells.size());
  PerBand sunlit_sum{}, natural_sum{}, guided_sum{}, transmittance;
  SunView sun;
  const double nu = glm::dot(direction_, to_sun);
  const double molecules = optics_.rayleigh_phase.at(nu);
  const double particles = optics_.aerosol_phase.at(nu);
  for (size_t i = 0; i < cells.size(); ++i) {
    const RayCells::Cell& cell = cells[i];
    const double half = cell.length / 2;
    const Place middle = place_.moved(ray_.radius, direction_, cell.begin + half);
    const Columns density = optics_.shells.densities(middle.height);
    optics_.transmittances(cell.before + shell_columns(optics_.shells.shell(cell.shell), ray_,
                                                       cell.begin, cell.begin + half),
                           transmittance);
    const double mu_sun = glm::dot(middle.up, to_sun);
    optics_.view_sun(middle.height, mu_sun, SunVisibility::smooth_step, sun);
    guide[i] = optics_.guide.importance(middle.height, mu_sun);
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
      guided_sum[b] += natural[i][b] * guide[i];
    }
  }
  for (int b = 0; b < bands; ++b) {
    if (!(natural_sum[b] > kLeastSum)) continue;
    const double lit = sunlit_sum[b] > kLeastSum ? share.sunlight / sunlit_sum[b] : 0;
    const double guided = share.guide / guided_sum[b];
    const double rest = (1 - share.guide - (lit > 0 ? share.sunlight : 0)) / natural_sum[b];
    for (size_t i = 0; i < cells.size(); ++i)
      cells[i].weight += lit * sunlit[i][b] + (guided * guide[i] + rest) * natural[i][b];
  }
  cells_.finish();
}

Place FirstCollision::ground() const {
  Place ground = place_.moved(ray_.radius, direction_, trace_.length);
  ground.height = 0;
  return ground;
}

PerBand FirstCollision::sunlit_ground(const glm::dvec3& to_sun) const {
  PerBand light{};
  SunView sun;
  const double cosine =
      optics_.sun_on_ground(0, glm::dot(ground().up, to_sun), SunVisibility::smooth_step, sun);
  if (cosine > 0)
    for (int b = 0; b < optics_.bands; ++b)
      light[b] = optics_.albedo[b] * std::numbers::inv_pi * cosine * optics_.solar[b] *
                 sun.transmittance[b] * through_[b];
  return light;
}

Place FirstCollision::sample(PathRandom& random, PerBand& factor) const {
  const RayCells::Cell& cell = cells_.draw(random);
  const double t = cell.begin + random.uniform() * cell.length;
  const Columns columns =
      cell.before + shell_columns(optics_.shells.shell(cell.shell), ray_, cell.begin, t);
  optics_.transmittances(columns, factor);
  const double inverse_density = cell.length / cell.weight;
  for (int b = 0; b < optics_.bands; ++b) factor[b] *= inverse_density;
  return place_.moved(ray_.radius, direction_, t);
}

}  // namespace skylapse::sky::monte_carlo
