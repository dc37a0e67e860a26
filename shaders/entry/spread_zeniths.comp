// The source by zenith angle and m from its coefficients: item [height][m][sun].
layout(local_size_x = 32) in;
#include "shared/harmonics.glsl"

layout(std430, binding = 0) readonly buffer CoefficientBlock { vec4 coefficients[]; };  // [group][height][harmonic][sun]
layout(std430, binding = 1) readonly buffer FactorBlock { float factors[]; };  // [harmonic][zenith]
layout(std430, binding = 2) writeonly buffer WaveBlock { vec4 waves[]; };  // [group][height][m][zenith][sun]

int items() { return HEIGHTS * ORDERS * sun_nodes; }

int terms(int item) { return ORDERS - m_of(item); }
int outputs(int item) { return TABLE_ZENITHS; }
vec4 load(int group, int item, int k) {
  int point = group * HEIGHTS + height_of(item);
  return coefficients[(point * HARMONICS + first_harmonic(m_of(item)) + k) * sun_nodes + sun_of(item)];
}
float factor(int item, int k, int j) {
  return factors[(first_harmonic(m_of(item)) + k) * TABLE_ZENITHS + min(j, TABLE_ZENITHS - 1)];
}
void store(int group, int item, int j, vec4 value) {
  waves[((group * HEIGHTS * ORDERS + item / sun_nodes) * TABLE_ZENITHS + j) * sun_nodes + sun_of(item)] = value;
}

#include "shared/contraction.glsl"
