// Nodes of a frame's slice (src/sky/bruneton/sky_slice.h has the same mapping).

// Azimuth from the sun of column i.
Real slice_azimuth(int i, int azimuths) { return PI * pow(Real(i) / Real(azimuths - 1), Real(1.5)); }

// Cosine of the angle between view and sun at the camera.
Real cosine_to_sun(Real mu, Real mu_s, Real azimuth) {
  return clamp(mu * mu_s + sqrt(max((1.0 - mu) * (1.0 + mu) * (1.0 - mu_s) * (1.0 + mu_s), Real(0.0))) * cos(azimuth),
               Real(-1.0), Real(1.0));
}
