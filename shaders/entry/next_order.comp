// Light of the next order at every point from every direction: what the source of the order before
// scatters into the rays, and the ground lit by that order.
layout(local_size_x = 32) in;

#include "shared/physics_host.glsl"
#include "shared/march_list.glsl"

// [group][sample]: transmittance * scattering * length of both components
layout(std430, binding = 6) readonly buffer WeightBlock { vec4 scattering_weight[]; };

void main() {
  int item = int(gl_GlobalInvocationID.x);
  int items = rays.length() * sun_nodes * AZIMUTHS;
  if (item >= items) return;
  Incidence at = incidence_of(item);
  ListRay ray = rays[at.ray];
  vec4 sum[GROUPS];
  for (int g = 0; g < GROUPS; ++g) sum[g] = vec4(0.0);
  for (int i = ray.first; i < ray.first + ray.count; ++i) {
    ListSample here = samples[i];
    SourceTexel texel = source_texel_of(here, sun_cosine(here, at.mu_s, at.nu), at.nu);
    for (int g = 0; g < GROUPS; ++g)
      sum[g] += source_at(g, texel) * scattering_weight[g * samples.length() + i];
  }
  if (ray.hits_ground > 0.5) {
    float row = sun_row_of(
        clamp(ray.ground_sun_scale * at.mu_s + ray.ground_nu_scale * at.nu, -1.0, 1.0));
    for (int g = 0; g < GROUPS; ++g)
      sum[g] += to_ground[g * rays.length() + at.ray] * band_group(g).ground_albedo *
                fetch_ground(g, row) * (1.0 / PI);
  }
  for (int g = 0; g < GROUPS; ++g) light[g * items + at.store] = sum[g];
}
