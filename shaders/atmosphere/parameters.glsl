// What the text knows of the air beside the bands. Only Reals, in fours: see README.md.

// On bottom <= h < top: amplitude * exp(-h * inverse_scale_height) + slope * h + constant, never
// below 0 (src/sky/atmosphere/density_profile.h).
struct DensityPiece {
  Real bottom, top, amplitude, inverse_scale_height;
  Real slope, constant, unused_0, unused_1;
};

// A straight piece of a profile that begins above the ground, whose columns are in no table
// (src/sky/bruneton/layers.h): density slope * h + constant on bottom <= h < top.
struct LayerPiece {
  Real bottom, top, slope, constant;
  Real rayleigh, aerosol, ozone, unused;  // 1 for its component
};

// From x = (h / H)^height_power >= `share` on, height nodes are even in x.
struct HeightKnot {
  Real share, node, nodes_per_share, unused;
};

struct AirParameters {
  Real bottom_radius, top_height;  // km
  Real sun_angular_radius;         // rad
  Real horizon_length;             // km from the ground at grazing incidence to the top

  // Phase functions (phase.glsl): Rayleigh is constant + quadratic * nu^2.
  Real rayleigh_constant, rayleigh_quadratic, aerosol_g, aerosol_norm;

  // Coordinates of the tables (coordinates.glsl).
  Real sun_centre, sun_width;       // rad: the sun rows' warp
  Real sun_first, sun_rows_per_unit;  // its value at the zenith; rows per unit of it
  Real sun_row_last, height_last, zenith_last, azimuth_last;  // greatest indices
  Real height_power, columns_height_last, columns_distance_last;
  Real march_samples;  // Gauss nodes of a piece

  Real rayleigh_terms, aerosol_terms, ozone_terms, layer_count;  // how many pieces are in use
  Real knot_count, unused_0, unused_1, unused_2;
  DensityPiece pieces[3 * MAX_DENSITY_TERMS];  // Rayleigh, aerosol, ozone
  LayerPiece layers[MAX_LAYERS];
  HeightKnot knots[MAX_HEIGHT_KNOTS];
};

// Coefficients of four bands (src/sky/atmosphere/medium.h), per km.
struct BandGroup {
  vec4 solar_irradiance;
  vec4 rayleigh_scattering;
  vec4 aerosol_scattering;
  vec4 aerosol_extinction;
  vec4 ozone_absorption;
  vec4 ground_albedo;
  vec4 source_scale;  // of the numbers in the source table, where those are half floats; else 1
};

// The part of a ray inside the air. The host makes it in double (src/sky/bruneton/rays.h), since a
// camera in space sees the whole atmosphere in a few of float's last digits.
struct Ray {
  Real height, mu;   // at the start, which is in the air
  Real skipped;      // km from the camera to the start
  Real camera_radius;  // km from the planet's centre
  Real length;       // km to the ground or the top; 0: no air on the ray
  Real lowest;       // km from the start to the lowest point, at most `length`
  Real hits_ground;  // 1: the planet's surface is at its end
  Real cut_count;
  Real cuts[MAX_CUTS];  // ascending distances at which the march begins anew
};

struct SunOfRay {
  Real mu_s;  // at the start of the ray
  Real nu;    // the same all along it
};
