// The source of one order at the sun nodes, and added to the sum of all: item [height][zenith][sun].
layout(local_size_x = 32) in;
#include "shared/harmonics.glsl"

layout(std430, binding = 0) readonly buffer WaveBlock { vec4 waves[]; };  // [group][height][m][zenith][sun]
layout(std430, binding = 1) readonly buffer CosineBlock { float cosines[]; };  // [m][azimuth]
layout(std430, binding = 2) writeonly buffer SourceBlock { vec4 source[]; };  // [group][height][zenith][sun][azimuth]
layout(std430, binding = 3) buffer TotalBlock { vec4 total[]; };  // likewise, summed over the orders

int items() { return HEIGHTS * TABLE_ZENITHS * sun_nodes; }

int terms(int item) { return ORDERS; }
int outputs(int item) { return TABLE_AZIMUTHS; }
vec4 load(int group, int item, int k) {
  int height = item / (TABLE_ZENITHS * sun_nodes);
  return waves[((group * HEIGHTS + height) * ORDERS + k) * TABLE_ZENITHS * sun_nodes +
               item % (TABLE_ZENITHS * sun_nodes)];
}
float factor(int item, int k, int j) { return cosines[k * TABLE_AZIMUTHS + min(j, TABLE_AZIMUTHS - 1)]; }
void store(int group, int item, int j, vec4 value) {
  int i = (group * items() + item) * TABLE_AZIMUTHS + j;
  // The cut series rings below 0; past the last sun node there is no light.
  vec4 light = dark_end == 1 && item % sun_nodes == sun_nodes - 1 ? vec4(0.0) : max(value, vec4(0.0));
  source[i] = light;
  total[i] += light;
}

#include "shared/contraction.glsl"
