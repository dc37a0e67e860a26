#pragma once
// The medium cut into spherical shells, in each of which every density is smooth, and the columns
// of Rayleigh scatterers, aerosol and ozone along rays through them: Gauss quadrature shell by
// shell. No tables, so the reference stands apart from what it judges.
#include <array>
#include <vector>

#include "sky/atmosphere/medium.h"

namespace skylapse::sky::monte_carlo {

/// Integrals of the relative densities along a path [km], or the densities at a point [1].
struct Columns {
  double rayleigh = 0, aerosol = 0, ozone = 0;
  Columns& operator+=(const Columns& o) {
    rayleigh += o.rayleigh, aerosol += o.aerosol, ozone += o.ozone;
    return *this;
  }
  friend Columns operator+(Columns a, const Columns& b) { return a += b; }
};

/// One smooth term of a component inside one shell.
struct ShellTerm {
  int component;  // 0 Rayleigh, 1 aerosol, 2 ozone
  double amplitude, inverse_scale_height, slope, constant;
};

struct Shell {
  double bottom = 0, top = 0;  // heights, km
  std::vector<ShellTerm> terms;
};

/// The parabola of a straight ray in a sphere: (R + h(t))^2 - R^2 = at_start + t (linear + t).
struct RayParabola {
  double radius, at_start, linear;
  RayParabola(double radius, double height, double mu)
      : radius(radius),
        at_start(height * (2 * radius + height)),
        linear(2 * (radius + height) * mu) {}
  [[nodiscard]] double height(double t) const;
};

/// Columns along t0 .. t1 of a ray within one shell. Relative error below 1e-6 of the column of the
/// whole shell (tested).
Columns shell_columns(const Shell& shell, const RayParabola& ray, double t0, double t1);

/// A ray's way through the shells.
struct Trace {
  struct Piece {
    double begin, end;  // distances from the ray's start, km
    int shell;
    Columns columns;
  };
  std::vector<Piece> pieces;
  bool hits_ground = false;
  double length = 0;  // to the top of the air, or to the ground
  Columns total;
};

class Shells {
 public:
  explicit Shells(const atmosphere::Medium& medium);

  [[nodiscard]] double radius() const { return radius_; }
  [[nodiscard]] double top() const { return top_; }
  [[nodiscard]] const Shell& shell(int i) const { return shells_[size_t(i)]; }
  [[nodiscard]] Columns densities(double height) const;

  /// Cosine of the zenith angle of the geometric horizon at a height >= 0.
  [[nodiscard]] double horizon_cosine(double height) const;

  /// From `height` (0..top) in direction `mu` to the ground or to the top. `trace` is overwritten.
  void follow(double height, double mu, Trace& trace) const;
  /// Columns from `height` to the top; a ray that would meet the ground is taken as the one that
  /// touches the horizon.
  [[nodiscard]] Columns to_top(double height, double mu) const;

 private:
  [[nodiscard]] int shell_at(double height) const;
  template <class Visit>
  void walk_down(double height, double mu, double lowest, int& shell, double& t,
                 const Visit& visit) const;
  template <class Visit>
  void walk_up(double height, double mu, int shell, double t, const Visit& visit) const;

  double radius_, top_;
  atmosphere::Medium medium_;
  std::vector<Shell> shells_;
};

}  // namespace skylapse::sky::monte_carlo
