// Light of the sun at a point, as a share of what arrives above the atmosphere.

// Visible part of the disc: a smooth step of the centre's height over the horizon. Its width is
// that of the disc, in cosines.
Real sun_visibility(Real h, Real mu_s) {
  Real sin_horizon = air.bottom_radius / radius_of(h);
  Real width = max(air.sun_angular_radius * sin_horizon, Real(1e-7));
  return smoothstep(-width, width, mu_s - horizon_mu(h));
}

// Mean cosine of incidence over the disc on a horizontal plane at the ground (the part below the
// horizon counts as 0), of a disc whose light falls evenly over its height.
Real sun_mean_cosine(Real mu_s) {
  Real a = max(air.sun_angular_radius, Real(1e-7));
  if (mu_s <= -a) return 0.0;
  if (mu_s >= a) return mu_s;
  return (mu_s + a) * (mu_s + a) / (4.0 * a);
}

// Transmittance from the ground towards the sun.
vec4 ground_sun_transmittance(int group, Real mu_s) {
  return exp(-optical_depth(band_group(group), columns_to_top(0.0, mu_s)));
}

// Radiance of the ground [W m^-2 sr^-1 nm^-1]: Lambert, lit by the sun and by the sky.
vec4 ground_radiance(int group, Real mu_s) {
  BandGroup band = band_group(group);
  vec4 sun = band.solar_irradiance * ground_sun_transmittance(group, mu_s) * sun_mean_cosine(mu_s);
  return band.ground_albedo * (sun + fetch_ground(group, sun_row_of(mu_s))) * (1.0 / PI);
}
