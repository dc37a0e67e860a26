// Rows of the source texture between the sun nodes: cubic Hermite with limited slopes
// (src/sky/bruneton/sun_rows.h). Item [height][zenith][interval][azimuth].
layout(local_size_x = 32) in;
#include "shared/sun_nodes.glsl"

layout(std430, binding = 0) readonly buffer SourceBlock { vec4 source[]; };  // [group][height][zenith][sun][azimuth]
layout(binding = 0, rgba32f) uniform writeonly image3D table;
layout(std140, binding = 3) uniform GroupBlock { int group; };

int intervals() { return sun_nodes - 1; }
int items() { return HEIGHTS * TABLE_ZENITHS * intervals() * TABLE_AZIMUTHS; }

// As limited_slope of sun_rows.h, with the products of two small secants kept above float's least.
vec4 limited_slope(vec4 before, vec4 after) {
  vec4 a = abs(before);
  vec4 b = abs(after);
  vec4 geometric = sqrt(a) * sqrt(b);
  vec4 harmonic = 2.0 * a * (b / max(a + b, vec4(1e-37)));
  vec4 slope = sign(before) * min((2.0 * geometric + harmonic) / 3.0, 3.0 * min(a, b));
  return mix(slope, vec4(0.0), lessThanEqual(sign(before) * sign(after), vec4(0.0)));
}

// FOLD as in shaders/shared/physics_host.glsl.
void put(int azimuth, int row, int slab, vec4 value) {
  int height = slab / TABLE_ZENITHS;
  imageStore(table,
             ivec3(azimuth + TABLE_AZIMUTHS * (height % FOLD), row,
                   slab % TABLE_ZENITHS + TABLE_ZENITHS * (height / FOLD)),
             value);
}

void main() {
  int item = int(gl_GlobalInvocationID.x);
  if (item >= items()) return;
  int azimuth = item % TABLE_AZIMUTHS;
  int interval = (item / TABLE_AZIMUTHS) % intervals();
  int slab = item / (TABLE_AZIMUTHS * intervals());
  int base = (group * HEIGHTS * TABLE_ZENITHS + slab) * sun_nodes * TABLE_AZIMUTHS + azimuth;
  vec4 here = source[base + interval * TABLE_AZIMUTHS];
  vec4 next = source[base + (interval + 1) * TABLE_AZIMUTHS];
  vec4 secant = next - here;
  vec4 slope_here = secant;
  vec4 slope_next = dark_end == 1 ? vec4(0.0) : secant;
  if (interval > 0)
    slope_here = limited_slope(here - source[base + (interval - 1) * TABLE_AZIMUTHS], secant);
  if (interval + 2 < sun_nodes)
    slope_next = limited_slope(secant, source[base + (interval + 2) * TABLE_AZIMUTHS] - next);
  for (int k = 0; k < ROWS_PER_INTERVAL; ++k) {
    float t = float(k) / float(ROWS_PER_INTERVAL);
    float u = 1.0 - t;
    vec4 value = u * u * (1.0 + 2.0 * t) * here + t * t * (3.0 - 2.0 * t) * next +
                 t * u * u * slope_here - t * t * u * slope_next;
    put(azimuth, interval * ROWS_PER_INTERVAL + k, slab, value);
  }
  if (interval == intervals() - 1)
    put(azimuth, intervals() * ROWS_PER_INTERVAL, slab, next);
}
