// How bright the source of one order is at each height under each sun node: sums over zeniths and
// azimuths (OrderSums of src/sky/bruneton/order_tail.h). Item [height][sun].
layout(local_size_x = 32) in;

layout(std430, binding = 0) readonly buffer SourceBlock { vec4 source[]; };  // [group][height][zenith][sun][azimuth]
layout(std430, binding = 1) writeonly buffer SumBlock { vec4 sums[]; };  // [group][height][sun]

const int ITEMS = HEIGHTS * SUNS;

void main() {
  int item = int(gl_GlobalInvocationID.x);
  int group = int(gl_WorkGroupID.z);
  if (item >= ITEMS) return;
  int sun = item % SUNS;
  int height = item / SUNS;
  vec4 sum = vec4(0.0);
  for (int zenith = 0; zenith < TABLE_ZENITHS; ++zenith)
    for (int azimuth = 0; azimuth < TABLE_AZIMUTHS; ++azimuth)
      sum += source[(((group * HEIGHTS + height) * TABLE_ZENITHS + zenith) * SUNS + sun) *
                        TABLE_AZIMUTHS + azimuth];
  sums[group * ITEMS + item] = sum;
}
