#pragma once
// The rays from the points of the tables, sampled by the host (src/sky/bruneton/march_buffers.h).

#include "shared/list_sample.glsl"
#include "shared/sun_nodes.glsl"

struct ListRay {
  int first, count;  // samples
  float mu;          // at the point
  float hits_ground;
  float ground_sun_scale, ground_nu_scale, unused_0, unused_1;
};

layout(std430, binding = 1) readonly buffer RayBlock { ListRay rays[]; };
layout(std430, binding = 2) readonly buffer SampleBlock { ListSample samples[]; };
layout(std430, binding = 3) readonly buffer SunBlock { float sun_mu[]; };  // of the sun nodes
// [group][ray]: transmittance to the ground, 0 where the ray does not hit it
layout(std430, binding = 4) readonly buffer GroundTransmittanceBlock { vec4 to_ground[]; };
// [group][ray][sun][azimuth]
layout(std430, binding = 5) writeonly buffer LightBlock { vec4 light[]; };

// One invocation is one ray under one sun at one azimuth, for all groups. All rays under one sun come
// one after the other, for they read the same few sun rows of the source.
struct Incidence {
  int ray;
  float mu_s, nu;
  int store;  // place in light[] of the first group
};

Incidence incidence_of(int item) {
  int azimuth = item % AZIMUTHS;
  int ray = (item / AZIMUTHS) % rays.length();
  int sun = item / (AZIMUTHS * rays.length());
  float mu = rays[ray].mu;
  float mu_s = sun_mu[sun];
  float sines = sqrt(max((1.0 - mu * mu) * (1.0 - mu_s * mu_s), 0.0));
  float nu = mu * mu_s + sines * cos(PI * (float(azimuth) + 0.5) / float(AZIMUTHS));
  return Incidence(ray, mu_s, nu, (ray * sun_nodes + sun) * AZIMUTHS + azimuth);
}
