// Horizontal irradiance on the ground by the incident light of one order, at the sun nodes.
layout(local_size_x = 32) in;
#include "shared/sun_nodes.glsl"

layout(std430, binding = 0) readonly buffer LightBlock { vec4 light[]; };  // [group][ray][sun][azimuth]
layout(std430, binding = 1) readonly buffer WeightBlock { float weights[]; };  // [row]: mu * solid angle
layout(std430, binding = 2) writeonly buffer IrradianceBlock { vec4 irradiance[]; };  // [group][sun]

void main() {
  int sun = int(gl_GlobalInvocationID.x);
  int group = int(gl_WorkGroupID.z);
  if (sun >= sun_nodes) return;
  vec4 sum = vec4(0.0);
  for (int row = 0; row < UP_ROWS; ++row)
    for (int azimuth = 0; azimuth < AZIMUTHS; ++azimuth)
      sum += light[((group * HEIGHTS * ROWS + row) * sun_nodes + sun) * AZIMUTHS + azimuth] * weights[row];
  irradiance[group * sun_nodes + sun] = sum;
}
