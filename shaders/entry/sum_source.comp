// How bright the source of one order is at each height under each sun node: sums over zeniths and
// azimuths (OrderSums of src/sky/bruneton/order_tail.h). Item [height][sun].
layout(local_size_x = 32) in;
#include "shared/sun_nodes.glsl"

layout(std430, binding = 0) readonly buffer SourceBlock { vec4 source[]; };  // [group][height][zenith][sun][azimuth]
layout(std430, binding = 1) writeonly buffer SumBlock { vec4 sums[]; };  // [group][height][sun]

int items() { return HEIGHTS * sun_nodes; }

void main() {
  int item = int(gl_GlobalInvocationID.x);
  int group = int(gl_WorkGroupID.z);
  if (item >= items()) return;
  int sun = item % sun_nodes;
  int height = item / sun_nodes;
  vec4 sum = vec4(0.0);
  for (int zenith = 0; zenith < TABLE_ZENITHS; ++zenith)
    for (int azimuth = 0; azimuth < TABLE_AZIMUTHS; ++azimuth)
      sum += source[(((group * HEIGHTS + height) * TABLE_ZENITHS + zenith) * sun_nodes + sun) *
                        TABLE_AZIMUTHS + azimuth];
  sums[group * items() + item] = sum;
}
