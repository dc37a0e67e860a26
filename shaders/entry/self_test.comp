// Squares and adds: proves that a context computes (gpu/self_test.h).
layout(local_size_x = 32) in;

layout(std430, binding = 0) buffer Values { float values[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < uint(values.length())) values[i] = values[i] * values[i] + values[i];
}
