#include "sky/monte_carlo/shells.h"

#include <algorithm>
#include <cmath>

namespace skylapse::sky::monte_carlo {
namespace {
using atmosphere::DensityProfile;
using atmosphere::DensityTerm;

/// Heights at which an exponential is cut so that eight Gauss nodes a shell suffice: 8 scale
/// heights hold all but 3e-4 of it, what is above may be coarser. exp(-8 x) by 8 nodes errs by
/// 5e-9, the Gaussian exp(-8 x^2) of a horizontal ray by 1e-6.
constexpr double kCutsInScaleHeights[] = {8, 20, 45};

void add_cuts(const DensityTerm& term, double top, std::vector<double>& edges) {
  const double inverse = term.inverse_scale_height_per_km;
  if (term.amplitude == 0 || inverse == 0) return;
  for (const double n : kCutsInScaleHeights) {
    const double cut =
        inverse > 0 ? term.bottom_km + n / inverse : std::min(term.top_km, top) + n / inverse;
    if (cut > term.bottom_km && cut < term.top_km) edges.push_back(cut);
  }
}

void add_terms(const DensityProfile& profile, int component, Shell& shell) {
  const double middle = (shell.bottom + shell.top) / 2;
  for (const DensityTerm& term : profile.terms) {
    if (!(term.bottom_km <= middle && middle < term.top_km)) continue;
    const double value = term.amplitude * std::exp(-middle * term.inverse_scale_height_per_km) +
                         term.slope_per_km * middle + term.constant;
    if (value > 0)
      shell.terms.push_back({component, term.amplitude, term.inverse_scale_height_per_km,
                             term.slope_per_km, term.constant});
  }
}

}  // namespace

double RayParabola::height(double t) const {
  const double q = at_start + t * (linear + t);
  const double square = radius * radius + q;
  return q / (radius + std::sqrt(square > 0 ? square : 0));
}

Shells::Shells(const atmosphere::Medium& medium)
    : radius_(medium.bottom_radius_km), top_(medium.top_height_km), medium_(medium) {
  std::vector<double> edges{0, top_};
  for (const DensityProfile* profile : {&medium.rayleigh, &medium.aerosol, &medium.ozone}) {
    for (const double h : profile->breaks_km(top_)) edges.push_back(h);
    for (const DensityTerm& term : profile->terms) add_cuts(term, top_, edges);
  }
  std::sort(edges.begin(), edges.end());
  // Edges nearer than a millimetre are one: the sliver between them holds nothing.
  const auto near = [](double a, double b) { return b - a < 1e-6; };
  std::vector<double> kept;
  for (const double e : edges) {
    if (e < 0 || e > top_ || (!kept.empty() && near(kept.back(), e))) continue;
    kept.push_back(e);
  }
  kept.back() = top_;
  for (size_t i = 0; i + 1 < kept.size(); ++i) {
    Shell shell{.bottom = kept[i], .top = kept[i + 1], .terms = {}};
    add_terms(medium.rayleigh, 0, shell);
    add_terms(medium.aerosol, 1, shell);
    add_terms(medium.ozone, 2, shell);
    shells_.push_back(std::move(shell));
  }
}

int Shells::shell_at(double height) const {
  int i = 0;
  while (i + 1 < int(shells_.size()) && height >= shells_[size_t(i)].top) ++i;
  return i;
}

Columns Shells::densities(double height) const {
  if (height > top_) return {};
  return {medium_.rayleigh.at(height), medium_.aerosol.at(height), medium_.ozone.at(height)};
}

double Shells::horizon_cosine(double height) const {
  return -std::sqrt(height * (2 * radius_ + height)) / (radius_ + height);
}

/// Down to `lowest` (the ground or the tangent point), visiting (shell, t0, t1).
template <class Visit>
void Shells::walk_down(double height, double mu, double lowest, int& shell, double& t,
                       const Visit& visit) const {
  const double rm = (radius_ + height) * mu;
  const auto distance = [&](double edge) {
    const double c = (edge - height) * (2 * radius_ + edge + height);
    const double root = std::sqrt(std::max(0.0, rm * rm + c));
    return root - rm > 0 ? -c / (root - rm) : 0.0;
  };
  for (;; --shell) {
    const double edge = shells_[size_t(shell)].bottom;
    const bool last = shell == 0 || edge <= lowest;
    const double end = distance(last ? std::min(lowest, height) : edge);
    if (end > t) visit(shell, t, end);
    t = std::max(t, end);
    if (last) return;
  }
}

template <class Visit>
void Shells::walk_up(double height, double mu, int shell, double t, const Visit& visit) const {
  const double rm = (radius_ + height) * mu;
  for (; shell < int(shells_.size()); ++shell) {
    const double edge = shells_[size_t(shell)].top;
    const double c = (edge - height) * (2 * radius_ + edge + height);
    const double root = std::sqrt(std::max(0.0, rm * rm + c));
    const double end = rm > 0 ? c / (rm + root) : root - rm;
    if (end > t) visit(shell, t, end);
    t = std::max(t, end);
  }
}

void Shells::follow(double height, double mu, Trace& trace) const {
  trace.pieces.clear();
  trace.total = {};
  trace.length = 0;
  const RayParabola ray(radius_, height, mu);
  const auto visit = [&](int shell, double t0, double t1) {
    const Columns columns = shell_columns(shells_[size_t(shell)], ray, t0, t1);
    trace.pieces.push_back({t0, t1, shell, columns});
    trace.total += columns;
    trace.length = t1;
  };
  int shell = shell_at(height);
  double t = 0;
  trace.hits_ground = false;
  if (mu < 0) {
    const double rm = (radius_ + height) * mu;
    const double q = ray.at_start - rm * rm;  // (R + tangent height)^2 - R^2
    trace.hits_ground = q <= 0;
    const double tangent = q > 0 ? q / (radius_ + std::sqrt(radius_ * radius_ + q)) : 0;
    walk_down(height, mu, tangent, shell, t, visit);
    if (trace.hits_ground) return;
  }
  walk_up(height, mu, shell, t, visit);
}

Columns Shells::to_top(double height, double mu) const {
  Columns sum;
  mu = std::max(mu, horizon_cosine(height));
  const RayParabola ray(radius_, height, mu);
  const auto visit = [&](int shell, double t0, double t1) {
    sum += shell_columns(shells_[size_t(shell)], ray, t0, t1);
  };
  int shell = shell_at(height);
  double t = 0;
  if (mu < 0) {
    const double rm = (radius_ + height) * mu;
    const double q = std::max(0.0, ray.at_start - rm * rm);
    walk_down(height, mu, q / (radius_ + std::sqrt(radius_ * radius_ + q)), shell, t, visit);
  }
  walk_up(height, mu, shell, t, visit);
  return sum;
}

}  // namespace skylapse::sky::monte_carlo
