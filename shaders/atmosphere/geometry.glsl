// Paths through a spherical shell by heights. h: height of a point [km], mu: cosine of the zenith
// angle of a direction there, t: distance along it [km]. r = R + h is never formed only to subtract
// R again: r^2 - R^2 = h (2 R + h).

Real radius_of(Real h) { return air.bottom_radius + h; }

// Height at distance t; clamped to the air.
Real height_along(Real h, Real mu, Real t) {
  Real R = air.bottom_radius;
  Real q = h * (2.0 * R + h) + t * (2.0 * (R + h) * mu + t);
  return clamp(q / (R + sqrt(max(R * R + q, Real(0.0)))), Real(0.0), air.top_height);
}

// Cosine of the horizon's zenith angle.
Real horizon_mu(Real h) {
  return -sqrt(h * (2.0 * air.bottom_radius + h)) / (air.bottom_radius + h);
}

// To the top of the atmosphere from inside it, the planet being no obstacle.
Real distance_to_top(Real h, Real mu) {
  Real b = radius_of(h) * mu;
  Real c = max((air.top_height - h) * (2.0 * air.bottom_radius + air.top_height + h), Real(0.0));
  Real root = sqrt(b * b + c);
  return b > 0.0 ? c / (b + root) : root - b;
}

// To the ground, for a direction below the horizon.
Real distance_to_ground(Real h, Real mu) {
  Real b = -radius_of(h) * mu;
  Real c = h * (2.0 * air.bottom_radius + h);
  return c > 0.0 ? c / (b + sqrt(max(b * b - c, Real(0.0)))) : Real(0.0);
}

// Where a ray crosses the edge of the planet's full shadow, t < 0 where it does not: (entry, exit).
// The umbra of a sun of angular radius a is the cone rho cos a + x sin a = R about the sun's axis
// (rho: distance from it, x > 0: distance down the shadow), which the sun's visible part of
// sun.glsl reaches 0 at. mu_s: cosine of the sun's zenith angle at the start; nu: of the angle
// between ray and sun.
vec2 shadow_cuts(Real h, Real mu, Real mu_s, Real nu) {
  Real R = air.bottom_radius;
  Real sin_a = sin(air.sun_angular_radius);
  Real cos_a2 = 1.0 - sin_a * sin_a;
  Real along = radius_of(h) * mu_s;
  Real a = cos_a2 - nu * nu;
  Real b = radius_of(h) * mu * cos_a2 - along * nu - R * sin_a * nu;
  Real c = h * (2.0 * R + h) * cos_a2 - R * R * sin_a * sin_a - along * along -
           2.0 * R * sin_a * along;
  Real d = b * b - a * c;
  if (d <= 0.0 || abs(a) < 1e-12) return vec2(-1.0, -1.0);
  Real q = b > 0.0 ? -(b + sqrt(d)) : sqrt(d) - b;
  Real t0 = q / a;
  Real t1 = q != 0.0 ? c / q : Real(-1.0);
  // Only behind the planet, and on the cone's own nappe.
  Real x0 = -(along + t0 * nu);
  Real x1 = -(along + t1 * nu);
  if (!(x0 > 0.0 && x0 * sin_a < R)) t0 = -1.0;
  if (!(x1 > 0.0 && x1 * sin_a < R)) t1 = -1.0;
  return vec2(min(t0, t1), max(t0, t1));
}

// Where a ray crosses the cylinder behind the planet on which the sun's rays graze the height
// `level`, t < 0 where it does not. A layer below that height dims them within little of the ray.
vec2 grazing_cuts(Real h, Real mu, Real mu_s, Real nu, Real level) {
  Real R = air.bottom_radius;
  Real along = radius_of(h) * mu_s;
  Real a = 1.0 - nu * nu;
  Real b = radius_of(h) * mu - along * nu;
  Real c = h * (2.0 * R + h) - level * (2.0 * R + level) - along * along;
  Real d = b * b - a * c;
  if (d <= 0.0 || a < 1e-12) return vec2(-1.0, -1.0);
  Real q = b > 0.0 ? -(b + sqrt(d)) : sqrt(d) - b;
  Real t0 = q / a;
  Real t1 = q != 0.0 ? c / q : Real(-1.0);
  if (along + t0 * nu >= 0.0) t0 = -1.0;
  if (along + t1 * nu >= 0.0) t1 = -1.0;
  return vec2(min(t0, t1), max(t0, t1));
}
