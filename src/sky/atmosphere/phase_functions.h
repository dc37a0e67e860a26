#pragma once
// Which way scattered light goes. nu = cosine of the scattering angle, +1 is forward; phase
// functions are per steradian and integrate to 1 over the sphere (tested).
#include <vector>

namespace skylapse::sky::atmosphere {

/// Molecules whose scattering is depolarized by `rho` (0 is the plain 3/(16 pi) (1 + nu^2)).
/// Source   Chandrasekhar 1950, section 18; as 3/(8 pi (2 + rho)) ((1 + rho) + (1 - rho) nu^2).
/// Domain   rho in [0, 1]; nu in [-1, 1].
double rayleigh_phase(double rho, double nu);

/// Aerosol, Cornette-Shanks form.
/// Source   Cornette and Shanks 1992, Applied Optics 31:3152, Eq. (8); Bruneton and Neyret 2008,
///          Eq. (4).
/// Domain   |g| < 1; nu in [-1, 1].
/// Note     g is a shape parameter: the mean cosine is 3 g (4 + g^2) / (5 (2 + g^2)).
double aerosol_phase(double g, double nu);

/// Legendre moments chi_0..chi_degree, chi_l = 2 pi times the integral of phase(nu) P_l(nu):
/// what convolution with the phase function does to harmonics of degree l. chi_0 is 1, chi_1 the
/// mean cosine. Closed forms; right to rounding for every degree (tested against quadrature to
/// degree 64 and |g| 0.99).
std::vector<double> rayleigh_moments(double rho, int degree);
std::vector<double> aerosol_moments(double g, int degree);

}  // namespace skylapse::sky::atmosphere
