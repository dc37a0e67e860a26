// Where a value lies in the tables: coordinates in texels, whole numbers are nodes.

// --- Optical columns: x = sqrt(h / H), y = distance to the top between its bounds. ---

vec2 columns_texel(Real h, Real mu) {
  Real H = air.top_height;
  Real shortest = H - h;
  Real longest = sqrt(h * (2.0 * air.bottom_radius + h)) + air.horizon_length;
  Real y = (distance_to_top(h, mu) - shortest) / max(longest - shortest, Real(1e-9));
  return vec2(sqrt(clamp(h / H, Real(0.0), Real(1.0))) * air.columns_height_last,
              clamp(y, Real(0.0), Real(1.0)) * air.columns_distance_last);
}

// (Rayleigh, aerosol, ozone) columns [km] from h towards mu to the top; along the horizon for
// directions below it.
vec3 columns_to_top(Real h, Real mu) {
  return fetch_columns(columns_texel(h, max(mu, horizon_mu(h))));
}

// --- Source of multiple scattering: azimuth, sun row, zenith, height. ---

// Heights cluster at the ground: h = H (node / last)^(1 / height_power).
Real height_coordinate(Real h) {
  return pow(clamp(h / air.top_height, Real(0.0), Real(1.0)), air.height_power) * air.height_last;
}

// Zenith angles are uniform.
Real zenith_coordinate(Real mu) {
  return acos(clamp(mu, Real(-1.0), Real(1.0))) * (air.zenith_last / PI);
}

// Rows of the sun cluster in twilight: u = asinh((centre - theta) / width) is uniform from the
// zenith to the last row, past which there is no light: the last row is dark (or at 180 deg).
Real sun_row_of(Real mu_s) {
  Real u = asinh((air.sun_centre - acos(clamp(mu_s, Real(-1.0), Real(1.0)))) / air.sun_width);
  return clamp((air.sun_first - u) * air.sun_rows_per_unit, Real(0.0), air.sun_row_last);
}

// Azimuths of a direction from the sun's are uniform, by the angle between both: cosine nu.
Real azimuth_coordinate(Real mu, Real mu_s, Real nu) {
  Real sines = sqrt(max((1.0 - mu * mu) * (1.0 - mu_s * mu_s), Real(0.0)));
  Real cosine = sines > 1e-9 ? (nu - mu * mu_s) / sines : Real(1.0);
  return acos(clamp(cosine, Real(-1.0), Real(1.0))) * (air.azimuth_last / PI);
}

struct SourceTexel {
  vec3 below;         // in the slab of the height node below; the next slab is zenith_last + 1 on
  Real height_weight;  // of the node above
};

SourceTexel source_texel(Real h, Real mu, Real mu_s, Real nu) {
  Real height = height_coordinate(h);
  Real node = min(floor(height), air.height_last - 1.0);
  SourceTexel texel;
  texel.below = vec3(azimuth_coordinate(mu, mu_s, nu), sun_row_of(mu_s),
                     zenith_coordinate(mu) + node * (air.zenith_last + 1.0));
  texel.height_weight = height - node;
  return texel;
}

vec4 source_at(int group, SourceTexel texel) {
  vec3 above = vec3(texel.below.x, texel.below.y, texel.below.z + air.zenith_last + 1.0);
  return fetch_source(group, texel.below) * (1.0 - texel.height_weight) +
         fetch_source(group, above) * texel.height_weight;
}
