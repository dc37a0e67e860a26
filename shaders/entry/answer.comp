// One query an invocation: light and transmittance along a view ray, and the sun's transmittance.
layout(local_size_x = 32) in;

#include "shared/physics_host.glsl"

struct QueryRays {
  Ray view, to_sun;
  float mu_s, nu;       // at the camera
  float sun_visible;    // share of the disc
  float unused;
};
struct AnswerBlock {
  int multiple_scattering, ground;  // switches
  int unused_0, unused_1;
};
layout(std140, binding = 3) uniform AnswerUniforms { AnswerBlock answer; };
layout(std430, binding = 1) readonly buffer QueryBlock { QueryRays queries[]; };
// [query][group]: radiance, transmittance, transmittance of the sun
layout(std430, binding = 2) writeonly buffer ResultBlock { vec4 results[]; };

void main() {
  int item = int(gl_GlobalInvocationID.x);
  if (item >= queries.length()) return;
  QueryRays query = queries[item];
  SunOfRay sun = sun_of_ray(query.view, query.mu_s, query.nu);
  RayLight light = march(query.view, sun, answer.multiple_scattering == 1);
  vec3 sun_columns = vec3(0.0);
  if (query.to_sun.length > 0.0) sun_columns = columns_to_top(query.to_sun.height, query.to_sun.mu);
  for (int g = 0; g < GROUPS; ++g) {
    vec4 sum = light.rayleigh[g] * rayleigh_phase(query.nu) +
               light.aerosol[g] * aerosol_phase(query.nu) + light.multiple[g];
    if (answer.ground == 1) sum += ground_through_air(g, query.view, sun, light);
    int first = 3 * (item * GROUPS + g);
    results[first] = sum;
    results[first + 1] = light.transmittance[g];
    results[first + 2] = exp(-optical_depth(band_group(g), sun_columns)) * query.sun_visible;
  }
}
