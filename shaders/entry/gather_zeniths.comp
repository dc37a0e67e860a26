// Harmonic coefficients of the incident light, times the moments of the air's phase function there:
// coefficients of the source. Item [height][m][sun].
layout(local_size_x = 32) in;
#include "shared/harmonics.glsl"

layout(std430, binding = 0) readonly buffer WaveBlock { vec4 waves[]; };  // [group][height][m][row][sun]
layout(std430, binding = 1) readonly buffer FactorBlock { float factors[]; };  // [height][row][harmonic]
layout(std430, binding = 2) readonly buffer MomentBlock { vec4 moments[]; };  // [group][height][l]
layout(std430, binding = 3) writeonly buffer CoefficientBlock { vec4 coefficients[]; };  // [group][height][harmonic][sun]

int items() { return HEIGHTS * ORDERS * sun_nodes; }

int terms(int item) { return ROWS; }
int outputs(int item) { return ORDERS - m_of(item); }
vec4 load(int group, int item, int k) {
  return waves[((group * HEIGHTS * ORDERS + item / sun_nodes) * ROWS + k) * sun_nodes + sun_of(item)];
}
float factor(int item, int k, int j) {
  int harmonic = min(first_harmonic(m_of(item)) + j, HARMONICS - 1);
  return factors[(height_of(item) * ROWS + k) * HARMONICS + harmonic];
}
void store(int group, int item, int j, vec4 value) {
  int point = group * HEIGHTS + height_of(item);
  int m = m_of(item);
  coefficients[(point * HARMONICS + first_harmonic(m) + j) * sun_nodes + sun_of(item)] =
      value * moments[point * ORDERS + m + j];
}

#include "shared/contraction.glsl"
