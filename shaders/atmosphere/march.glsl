// One view ray: single scattering exactly, multiple scattering from the source table.

struct RayLight {
  vec4 rayleigh[GROUPS];  // single scattering without phase function [W m^-2 nm^-1]
  vec4 aerosol[GROUPS];
  vec4 multiple[GROUPS];  // all further orders [W m^-2 sr^-1 nm^-1]
  vec4 transmittance[GROUPS];
};

// mu_s and nu are those at the camera.
SunOfRay sun_of_ray(Ray ray, Real mu_s, Real nu) {
  Real mu_start = (ray.camera_radius * mu_s + ray.skipped * nu) / radius_of(ray.height);
  SunOfRay sun;  // member by member: not every C++ compiler builds structs as GLSL does
  sun.mu_s = clamp(mu_start, Real(-1.0), Real(1.0));
  sun.nu = nu;
  return sun;
}

// Densities integrated over [from, to] of a ray, 3-point Gauss.
vec3 columns_between(Ray ray, Real from, Real to) {
  Real half_length = 0.5 * (to - from);
  Real middle = 0.5 * (from + to);
  Real offset = 0.7745966692414834 * half_length;
  return (densities(height_along(ray.height, ray.mu, middle)) * Real(0.8888888888888889) +
          (densities(height_along(ray.height, ray.mu, middle - offset)) +
           densities(height_along(ray.height, ray.mu, middle + offset))) * Real(0.5555555555555556)) *
         half_length;
}

// The first place after `from` where the integrand has a corner.
Real next_cut(Ray ray, SunOfRay sun, vec2 shadow, Real from) {
  Real next = ray.length;
  Real least = from + 1e-6 * ray.length;
  for (int i = 0; i < int(ray.cut_count); ++i)
    if (ray.cuts[i] > least) next = min(next, ray.cuts[i]);
  if (shadow.x > least) next = min(next, shadow.x);
  if (shadow.y > least) next = min(next, shadow.y);
#if LAYERED
  for (int i = 0; i < int(air.layer_count); ++i) {
    vec2 veil = grazing_cuts(ray.height, ray.mu, sun.mu_s, sun.nu, air.layers[i].top);
    if (veil.x > least) next = min(next, veil.x);
    if (veil.y > least) next = min(next, veil.y);
  }
#endif
  return next;
}

RayLight dark_ray() {
  RayLight light;
  for (int g = 0; g < GROUPS; ++g) {
    light.rayleigh[g] = vec4(0.0);
    light.aerosol[g] = vec4(0.0);
    light.multiple[g] = vec4(0.0);
    light.transmittance[g] = vec4(1.0);
  }
  return light;
}

// Sums at one point of the ray, `dt` km of it, seen through the columns `view`.
RayLight add_point(RayLight light, Ray ray, SunOfRay sun, Real t, Real dt, vec3 view,
                   bool with_multiple) {
  Real h = height_along(ray.height, ray.mu, t);
  Real mu = clamp((radius_of(ray.height) * ray.mu + t) / radius_of(h), Real(-1.0), Real(1.0));
  Real mu_s = clamp((radius_of(ray.height) * sun.mu_s + t * sun.nu) / radius_of(h), Real(-1.0),
                    Real(1.0));
  vec3 density = densities(h) * dt;
  Real visible = sun_visibility(h, mu_s);
  vec3 total = visible > 0.0 ? view + columns_to_top(h, mu_s) : view;
  SourceTexel texel = source_texel(h, mu, mu_s, sun.nu);
  for (int g = 0; g < GROUPS; ++g) {
    BandGroup band = band_group(g);
    if (visible > 0.0) {
      vec4 sunlight = exp(-optical_depth(band, total)) * visible;
      light.rayleigh[g] += sunlight * density.x;
      light.aerosol[g] += sunlight * density.y;
    }
    if (with_multiple)
      light.multiple[g] += exp(-optical_depth(band, view)) * source_at(g, texel) *
                           (band.rayleigh_scattering * density.x + band.aerosol_scattering * density.y);
  }
  return light;
}

// Light that reaches the camera along a ray, without that of the ground.
RayLight march(Ray ray, SunOfRay sun, bool with_multiple) {
  RayLight light = dark_ray();
  if (ray.length <= 0.0) return light;
  vec2 shadow = shadow_cuts(ray.height, ray.mu, sun.mu_s, sun.nu);
  int samples = int(air.march_samples);
  vec3 view = vec3(0.0);
  Real last = 0.0;
  Real begin = 0.0;
  for (int piece = 0; piece < MAX_CUTS + 3 + 2 * MAX_LAYERS; ++piece) {
    if (begin >= ray.length) break;
    Real end = next_cut(ray, sun, shadow, begin);
    bool rising = begin >= ray.lowest - 1e-6 * ray.length;
    for (int i = 0; i < samples; ++i) {
      // Samples gather at the lower end, where air is dense: distance from it = length * s^2.
      vec2 node = fetch_gauss(rising ? i : samples - 1 - i);
      Real away = (end - begin) * node.x * node.x;
      Real t = rising ? begin + away : end - away;
      view += columns_between(ray, last, t);
      last = t;
      light = add_point(light, ray, sun, t, 2.0 * node.x * node.y * (end - begin), view,
                        with_multiple);
    }
    begin = end;
  }
  view += columns_between(ray, last, ray.length);
  for (int g = 0; g < GROUPS; ++g) {
    BandGroup band = band_group(g);
    light.rayleigh[g] *= band.rayleigh_scattering * band.solar_irradiance;
    light.aerosol[g] *= band.aerosol_scattering * band.solar_irradiance;
    light.transmittance[g] = exp(-optical_depth(band, view));
  }
  return light;
}

// What the ground at the end of the ray adds.
vec4 ground_through_air(int group, Ray ray, SunOfRay sun, RayLight light) {
  if (ray.hits_ground < 0.5) return vec4(0.0);
  Real mu_s = (radius_of(ray.height) * sun.mu_s + ray.length * sun.nu) / air.bottom_radius;
  return light.transmittance[group] * ground_radiance(group, clamp(mu_s, Real(-1.0), Real(1.0)));
}
