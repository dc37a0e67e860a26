// One node of a frame's slice an invocation: light of a range of band groups, projected to XYZ and
// added to what the ranges before have left.
layout(local_size_x = 32) in;

#include "shared/physics_host.glsl"

struct SliceBlock {
  float mu_s;  // at the camera
  int azimuths, rows;
  int multiple_scattering, ground;  // switches
  int unused_0, unused_1, unused_2;
};
layout(std140, binding = 3) uniform SliceUniforms { SliceBlock slice; };
layout(std140, binding = 4) uniform WeightBlock { vec4 xyz_weight[4 * GROUPS]; };  // per band
layout(std430, binding = 1) readonly buffer RayBlock { Ray rays[]; };
layout(std430, binding = 2) readonly buffer MuBlock { float row_mu[]; };  // at the camera
layout(std430, binding = 3) buffer SmoothBlock { vec4 smooth_xyz[]; };    // [row][azimuth]
layout(std430, binding = 4) buffer AerosolBlock { vec4 aerosol_xyz[]; };

vec4 project(int g, vec4 bands_light) {
  return xyz_weight[4 * g] * bands_light.x + xyz_weight[4 * g + 1] * bands_light.y +
         xyz_weight[4 * g + 2] * bands_light.z + xyz_weight[4 * g + 3] * bands_light.w;
}

void main() {
  int item = int(gl_GlobalInvocationID.x);
  if (item >= slice.azimuths * slice.rows) return;
  int row = item / slice.azimuths;
  Ray ray = rays[row];
  float nu = cosine_to_sun(row_mu[row], slice.mu_s, slice_azimuth(item % slice.azimuths, slice.azimuths));
  SunOfRay sun = sun_of_ray(ray, slice.mu_s, nu);
  RayLight light = march(ray, sun, slice.multiple_scattering == 1);
  vec4 smooth_sum = smooth_xyz[item];
  vec4 aerosol_sum = aerosol_xyz[item];
  for (int g = 0; g < GROUPS; ++g) {
    vec4 sum = light.rayleigh[g] * rayleigh_phase(nu) + light.multiple[g];
    if (slice.ground == 1) sum += ground_through_air(g, ray, sun, light);
    smooth_sum += project(g, sum);
    aerosol_sum += project(g, light.aerosol[g]);
  }
  smooth_xyz[item] = smooth_sum;
  aerosol_xyz[item] = aerosol_sum;
}
