// Adds the orders that were not computed to the sum over those that were: multiples of the last.
// Item [height][zenith][sun].
layout(local_size_x = 32) in;

layout(std430, binding = 0) readonly buffer SourceBlock { vec4 source[]; };  // the last order; [group][height][zenith][sun][azimuth]
layout(std430, binding = 1) readonly buffer FactorBlock { vec4 factors[]; };  // [group][height][sun]
layout(std430, binding = 2) buffer TotalBlock { vec4 total[]; };

const int ITEMS = HEIGHTS * TABLE_ZENITHS * SUNS;

void main() {
  int item = int(gl_GlobalInvocationID.x);
  int group = int(gl_WorkGroupID.z);
  if (item >= ITEMS) return;
  int height = item / (TABLE_ZENITHS * SUNS);
  vec4 factor = factors[(group * HEIGHTS + height) * SUNS + item % SUNS];
  for (int azimuth = 0; azimuth < TABLE_AZIMUTHS; ++azimuth) {
    int i = (group * ITEMS + item) * TABLE_AZIMUTHS + azimuth;
    total[i] += source[i] * factor;
  }
}
