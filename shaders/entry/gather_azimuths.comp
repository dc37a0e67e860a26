// Cosine transform of the incident light over the azimuth: item [height][row][sun].
layout(local_size_x = 32) in;
#include "shared/harmonics.glsl"

layout(std430, binding = 0) readonly buffer LightBlock { vec4 light[]; };  // as march_list.glsl
layout(std430, binding = 1) readonly buffer CosineBlock { float cosines[]; };  // [azimuth][m]
layout(std430, binding = 2) writeonly buffer WaveBlock { vec4 waves[]; };  // [group][height][m][row][sun]

int items() { return HEIGHTS * ROWS * sun_nodes; }

int terms(int item) { return AZIMUTHS; }
int outputs(int item) { return ORDERS; }
vec4 load(int group, int item, int k) { return light[(group * items() + item) * AZIMUTHS + k]; }
float factor(int item, int k, int j) { return cosines[k * ORDERS + min(j, DEGREE)]; }
void store(int group, int item, int j, vec4 value) {
  int height = item / (ROWS * sun_nodes);
  waves[((group * HEIGHTS + height) * ORDERS + j) * ROWS * sun_nodes + item % (ROWS * sun_nodes)] = value;
}

#include "shared/contraction.glsl"
