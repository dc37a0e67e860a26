// Adds the orders that were not computed to the sum over those that were: multiples of the last.
// Item [height][zenith][sun].
layout(local_size_x = 32) in;
#include "shared/sun_nodes.glsl"

layout(std430, binding = 0) readonly buffer SourceBlock { vec4 source[]; };  // the last order; [group][height][zenith][sun][azimuth]
layout(std430, binding = 1) readonly buffer FactorBlock { vec4 factors[]; };  // [group][height][sun]
layout(std430, binding = 2) buffer TotalBlock { vec4 total[]; };

int items() { return HEIGHTS * TABLE_ZENITHS * sun_nodes; }

void main() {
  int item = int(gl_GlobalInvocationID.x);
  int group = int(gl_WorkGroupID.z);
  if (item >= items()) return;
  int height = item / (TABLE_ZENITHS * sun_nodes);
  vec4 factor = factors[(group * HEIGHTS + height) * sun_nodes + item % sun_nodes];
  for (int azimuth = 0; azimuth < TABLE_AZIMUTHS; ++azimuth) {
    int i = (group * items() + item) * TABLE_AZIMUTHS + azimuth;
    total[i] += source[i] * factor;
  }
}
