#pragma once
// A place on a ray where multiple scattering is looked up (made by the host in double).

struct ListSample {
  float sun_scale, nu_scale;  // mu_s there = sun_scale * mu_s + nu_scale * nu
  float mu, height;           // of the ray's direction there; km
  float slab;                 // depth in the source texture at the height node below
  float height_weight;        // of the node above
  float unused_0, unused_1;
};

float sun_cosine(ListSample here, float mu_s, float nu) {
  return clamp(here.sun_scale * mu_s + here.nu_scale * nu, -1.0, 1.0);
}

SourceTexel source_texel_of(ListSample here, float mu_s, float nu) {
  SourceTexel texel;
  texel.below = vec3(azimuth_coordinate(here.mu, mu_s, nu), sun_row_of(mu_s), here.slab);
  texel.height_weight = here.height_weight;
  return texel;
}
