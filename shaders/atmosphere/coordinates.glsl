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

// A layer's density integrated over distances from the ray's lowest point; q = r^2 - R^2 there.
// Heights are quadratic in the distance but for 1e-4, which two Gauss nodes integrate exactly.
Real layer_column(LayerPiece layer, Real q, Real from, Real to) {
  Real R = air.bottom_radius;
  Real middle = 0.5 * (from + to);
  Real offset = 0.2886751345948129 * (to - from);
  Real q0 = max(q + (middle - offset) * (middle - offset), Real(0.0));
  Real q1 = max(q + (middle + offset) * (middle + offset), Real(0.0));
  Real heights = q0 / (R + sqrt(R * R + q0)) + q1 / (R + sqrt(R * R + q1));
  return max((0.5 * layer.slope * heights + layer.constant) * (to - from), Real(0.0));
}

// What the table of columns leaves out, [km] from h towards mu to the top.
vec3 layer_columns_to_top(Real h, Real mu) {
  Real R = air.bottom_radius;
  Real start = radius_of(h) * mu;  // distance from the lowest point
  Real q = h * (2.0 * R + h) - start * start;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < int(air.layer_count); ++i) {
    LayerPiece layer = air.layers[i];
    Real outer2 = layer.top * (2.0 * R + layer.top) - q;
    if (outer2 <= 0.0) continue;
    Real outer = sqrt(outer2);
    if (outer <= start) continue;
    Real inner = sqrt(max(layer.bottom * (2.0 * R + layer.bottom) - q, Real(0.0)));
    Real column = layer_column(layer, q, max(inner, start), outer);
    if (start < -inner) column += layer_column(layer, q, inner, min(-start, outer));
    sum += vec3(layer.rayleigh, layer.aerosol, layer.ozone) * column;
  }
  return sum;
}

// (Rayleigh, aerosol, ozone) columns [km] from h towards mu to the top; along the horizon for
// directions below it.
vec3 columns_to_top(Real h, Real mu) {
  Real above = max(mu, horizon_mu(h));
  vec3 columns = fetch_columns(columns_texel(h, above));
#if LAYERED
  columns += layer_columns_to_top(h, above);
#endif
  return columns;
}

// --- Source of multiple scattering: azimuth, sun row, zenith, height. ---

// Heights cluster at the ground and at layers: even in (h / H)^height_power between knots.
Real height_coordinate(Real h) {
  Real share = pow(clamp(h / air.top_height, Real(0.0), Real(1.0)), air.height_power);
  int knot = 0;
  for (int i = 1; i < int(air.knot_count); ++i)
    if (share >= air.knots[i].share) knot = i;
  return air.knots[knot].node + (share - air.knots[knot].share) * air.knots[knot].nodes_per_share;
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
  Real sines = sqrt(max((1.0 - mu) * (1.0 + mu) * (1.0 - mu_s) * (1.0 + mu_s), Real(0.0)));
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
