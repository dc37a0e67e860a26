// The sky dome of Hosek and Wilkie 2012, one pixel an invocation; letters as in the paper's formula
// (src/sky/hosek_wilkie/model.h).
layout(local_size_x = 64) in;

struct Band {
  float a, b, c, d;
  float e, f, g, h;
  float i, unused_0, unused_1, unused_2;
  vec4 colour;  // scale and weight, in the image's space
};
layout(std140, binding = 0) uniform SkyBlock {
  vec4 ground;
  int band_count, pixel_count, unused_0, unused_1;
  Band bands[MAX_BANDS];
};
// cos theta, 1 - cos gamma, share of the pixel above the horizon (negative: outside the picture)
layout(std430, binding = 0) readonly buffer PlaceBlock { vec4 places[]; };
layout(std430, binding = 1) writeonly buffer PixelBlock { float pixels[]; };

// Angle of which this is 1 - cosine, from half-angle sine and cosine: no digits are lost near 0.
float angle_of(float one_minus_cosine) {
  return 2.0 * atan(sqrt(max(one_minus_cosine, 0.0)), sqrt(max(2.0 - one_minus_cosine, 0.0)));
}

float radiance(Band p, float cos_theta, float gamma, float one_minus_cosine) {
  float cos_gamma = 1.0 - one_minus_cosine;
  float base = (1.0 - p.h) * (1.0 - p.h) + 2.0 * p.h * one_minus_cosine;
  float chi = (1.0 + cos_gamma * cos_gamma) / (base * sqrt(base));
  float lobes = p.c + p.d * exp(p.e * gamma) + p.f * cos_gamma * cos_gamma + p.g * chi;
  return (1.0 + p.a * exp(p.b / (cos_theta + 0.01))) * (lobes + p.i * sqrt(cos_theta));
}

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= pixel_count) return;
  vec4 place = places[i];
  vec3 sky = vec3(0.0);
  if (place.z > 0.0) {
    float gamma = angle_of(place.y);
    for (int n = 0; n < band_count; ++n)
      sky += bands[n].colour.rgb * radiance(bands[n], max(place.x, 0.0), gamma, place.y);
  }
  // Negative results of the fit become 0, as on the CPU.
  vec3 colour = place.z < 0.0 ? vec3(0.0) : mix(ground.rgb, max(sky, vec3(0.0)), place.z);
  for (int c = 0; c < 3; ++c) pixels[3 * i + c] = colour[c];
}
