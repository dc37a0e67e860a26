// Light scattered once, and direct sunlight off the ground, at every point from every direction.
layout(local_size_x = 32) in;

#include "shared/physics_host.glsl"
#include "shared/march_list.glsl"

// [group][sample]: transmittance * scattering * length, by component
layout(std430, binding = 6) readonly buffer RayleighBlock { vec4 rayleigh_weight[]; };
layout(std430, binding = 7) readonly buffer AerosolBlock { vec4 aerosol_weight[]; };

void main() {
  int item = int(gl_GlobalInvocationID.x);
  int items = rays.length() * sun_nodes * AZIMUTHS;
  if (item >= items) return;
  Incidence at = incidence_of(item);
  ListRay ray = rays[at.ray];
  float rayleigh_share = rayleigh_phase(at.nu);
  float aerosol_share = aerosol_phase(at.nu);
  vec4 sum[GROUPS];
  for (int g = 0; g < GROUPS; ++g) sum[g] = vec4(0.0);
  for (int i = ray.first; i < ray.first + ray.count; ++i) {
    ListSample here = samples[i];
    float mu_s = sun_cosine(here, at.mu_s, at.nu);
    float visible = sun_visibility(here.height, mu_s);
    if (visible <= 0.0) continue;
    vec3 columns = columns_to_top(here.height, mu_s);
    for (int g = 0; g < GROUPS; ++g) {
      int weight = g * samples.length() + i;
      sum[g] += exp(-optical_depth(band_group(g), columns)) * visible *
                (rayleigh_weight[weight] * rayleigh_share + aerosol_weight[weight] * aerosol_share);
    }
  }
  float ground_mu_s = clamp(ray.ground_sun_scale * at.mu_s + ray.ground_nu_scale * at.nu, -1.0, 1.0);
  for (int g = 0; g < GROUPS; ++g) {
    vec4 result = sum[g] * band_group(g).solar_irradiance;
    if (ray.hits_ground > 0.5)
      result += to_ground[g * rays.length() + at.ray] * ground_radiance(g, ground_mu_s);
    light[g * items + at.store] = result;
  }
}
