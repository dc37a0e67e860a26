// Shares of light scattered into a unit solid angle [1/sr]; nu = cosine of the scattering angle,
// +1 is forward. Each integrates to 1 over the sphere.

// Rayleigh with King's depolarisation (Bucholtz 1995, Eqs. 10-12; the host takes rho to the two
// coefficients). Without it 3 / (16 pi) (1 + nu^2).
Real rayleigh_phase(Real nu) { return air.rayleigh_constant + air.rayleigh_quadratic * nu * nu; }

// Cornette-Shanks (Bruneton and Neyret 2008, Eq. 4). The denominator 1 + g^2 - 2 g nu is written as
// (1 - |g|)^2 + 2 |g| (1 - cosine), the cosine being from the peak: that keeps its digits there.
Real aerosol_phase(Real nu) {
  Real g = abs(air.aerosol_g);
  Real cosine = air.aerosol_g < 0.0 ? -nu : nu;
  Real d = (1.0 - g) * (1.0 - g) + 2.0 * g * (1.0 - cosine);
  return air.aerosol_norm * (1.0 + nu * nu) / (d * sqrt(d));
}
