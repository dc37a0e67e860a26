// Densities of the three components, relative to where their coefficients are quoted.

Real density_of_pieces(int first, int count, Real h) {
  Real sum = 0.0;
  for (int i = first; i < first + count; ++i) {
    DensityPiece piece = air.pieces[i];
    if (h >= piece.bottom && h < piece.top) {
      Real value = piece.slope * h + piece.constant;
      if (piece.amplitude != 0.0) value += piece.amplitude * exp(-h * piece.inverse_scale_height);
      sum += max(value, Real(0.0));
    }
  }
  return sum;
}

// (Rayleigh, aerosol, ozone) at a height.
vec3 densities(Real h) {
  return vec3(density_of_pieces(0, int(air.rayleigh_terms), h),
              density_of_pieces(MAX_DENSITY_TERMS, int(air.aerosol_terms), h),
              density_of_pieces(2 * MAX_DENSITY_TERMS, int(air.ozone_terms), h));
}

// Optical depth of three columns [km] in four bands.
vec4 optical_depth(BandGroup band, vec3 columns) {
  return band.rayleigh_scattering * columns.x + band.aerosol_extinction * columns.y +
         band.ozone_absorption * columns.z;
}
