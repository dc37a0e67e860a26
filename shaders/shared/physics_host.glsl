#pragma once
// What GL provides to the physics text (shaders/atmosphere/README.md lists it). Defines: GROUPS,
// MAX_GAUSS, SCALED_SOURCE: 1 where the source tables hold half floats, EXACT_FILTER: 1 where the samplers' interpolation is not that of float, and FOLD: how
// many heights stand side by side along the azimuths of a source texture (1 unless it would be
// deeper than a texture may be).

#define Real float
const float PI = 3.14159265358979;
const int MAX_DENSITY_TERMS = 8;
const int MAX_CUTS = 16;
const int MAX_LAYERS = 8;
const int MAX_HEIGHT_KNOTS = 50;

// Abramowitz and Stegun 1964, 4.4.46: error below 2e-8 (GL promises 1e-4 at most, which moves the
// sun rows of deep twilight by tenths of a percent in light).
float acos(float x) {
  float y = abs(x);
  float p = -0.0012624911;
  p = p * y + 0.0066700901;
  p = p * y - 0.0170881256;
  p = p * y + 0.0308918810;
  p = p * y - 0.0501743046;
  p = p * y + 0.0889789874;
  p = p * y - 0.2145988016;
  p = p * y + 1.5707963050;
  float angle = p * sqrt(max(1.0 - y, 0.0));
  return x < 0.0 ? PI - angle : angle;
}

#include "atmosphere/parameters.glsl"

layout(std140, binding = 0) uniform AirBlock { AirParameters air; };
layout(std140, binding = 1) uniform BandBlock { BandGroup bands[GROUPS]; };
layout(std140, binding = 2) uniform GaussBlock { vec4 gauss[MAX_GAUSS]; };
layout(std430, binding = 0) readonly buffer GroundBlock { vec4 ground_rows[]; };  // [group][sun row]
layout(binding = 0) uniform sampler2D columns_table;
layout(binding = 1) uniform sampler3D source_table[GROUPS];

BandGroup band_group(int g) { return bands[g]; }

vec2 fetch_gauss(int i) { return gauss[i].xy; }

#if EXACT_FILTER
// Samplers in hardware keep 8 bits of the weights; the steps of 1/256 would show in twilight.
vec4 filtered_plane(sampler3D table, ivec3 low, ivec3 high, vec2 weight, int z) {
  return mix(mix(texelFetch(table, ivec3(low.xy, z), 0), texelFetch(table, ivec3(high.x, low.y, z), 0), weight.x),
             mix(texelFetch(table, ivec3(low.x, high.y, z), 0), texelFetch(table, ivec3(high.xy, z), 0), weight.x),
             weight.y);
}

vec4 filtered(sampler3D table, vec3 texel) {
  ivec3 last = textureSize(table, 0) - 1;
  vec3 at = clamp(texel, vec3(0.0), vec3(last));
  ivec3 low = ivec3(at);
  ivec3 high = min(low + 1, last);
  vec3 weight = at - vec3(low);
  return mix(filtered_plane(table, low, high, weight.xy, low.z),
             filtered_plane(table, low, high, weight.xy, high.z), weight.z);
}

vec4 filtered(sampler2D table, vec2 texel) {
  ivec2 last = textureSize(table, 0) - 1;
  vec2 at = clamp(texel, vec2(0.0), vec2(last));
  ivec2 low = ivec2(at);
  ivec2 high = min(low + 1, last);
  vec2 weight = at - vec2(low);
  return mix(mix(texelFetch(table, low, 0), texelFetch(table, ivec2(high.x, low.y), 0), weight.x),
             mix(texelFetch(table, ivec2(low.x, high.y), 0), texelFetch(table, high, 0), weight.x),
             weight.y);
}
#else
vec4 filtered(sampler3D table, vec3 texel) {
  return textureLod(table, (texel + 0.5) / vec3(textureSize(table, 0)), 0.0);
}

vec4 filtered(sampler2D table, vec2 texel) {
  return textureLod(table, (texel + 0.5) / vec2(textureSize(table, 0)), 0.0);
}
#endif

vec3 fetch_columns(vec2 texel) {
  return filtered(columns_table, texel.yx).xyz;  // distances run fastest in memory
}

vec4 fetch_source(int g, vec3 texel) {
#if FOLD > 1
  float zeniths = air.zenith_last + 1.0;
  float height = floor((texel.z + 0.25) / zeniths);
  float story = floor((height + 0.25) / float(FOLD));
  texel.x += (air.azimuth_last + 1.0) * (height - story * float(FOLD));
  texel.z += zeniths * (story - height);
#endif
#if SCALED_SOURCE
  return filtered(source_table[g], texel) * bands[g].source_scale;
#else
  return filtered(source_table[g], texel);
#endif
}

vec4 fetch_ground(int g, float row) {
  int rows = int(air.sun_row_last) + 1;
  int node = clamp(int(row), 0, rows - 2);
  vec4 below = ground_rows[g * rows + node];
  return below + (ground_rows[g * rows + node + 1] - below) * clamp(row - float(node), 0.0, 1.0);
}

#include "atmosphere/atmosphere.glsl"
