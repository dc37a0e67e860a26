#pragma once
// What GL provides to the physics text (shaders/atmosphere/README.md lists it). GROUPS is a define.

#define Real float
const float PI = 3.14159265358979;
const int MAX_DENSITY_TERMS = 8;
const int MAX_CUTS = 8;

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

vec3 fetch_columns(vec2 texel) {
  // Distances run fastest in memory.
  return textureLod(columns_table, (texel.yx + 0.5) / vec2(textureSize(columns_table, 0)), 0.0).xyz;
}

vec4 fetch_source(int g, vec3 texel) {
  return textureLod(source_table[g], (texel + 0.5) / vec3(textureSize(source_table[g], 0)), 0.0);
}

vec4 fetch_ground(int g, float row) {
  int rows = int(air.sun_row_last) + 1;
  int node = clamp(int(row), 0, rows - 2);
  vec4 below = ground_rows[g * rows + node];
  return below + (ground_rows[g * rows + node + 1] - below) * clamp(row - float(node), 0.0, 1.0);
}

#include "atmosphere/atmosphere.glsl"
