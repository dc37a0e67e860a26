#pragma once
// Small matrix products, one item times a matrix each: output_j = sum over k of input_k * M_kj.
// The entry defines items(), the host BLOCK, and the entry before including this
//   int terms(int item); int outputs(int item);
//   vec4 load(int group, int item, int k);
//   float factor(int item, int k, int j);  any finite value for j >= outputs
//   void store(int group, int item, int j, vec4 value);
// One invocation makes BLOCK outputs of one item, so that each input is loaded once for all.

void main() {
  int item = int(gl_GlobalInvocationID.x);
  int first = int(gl_WorkGroupID.y) * BLOCK;
  int group = int(gl_WorkGroupID.z);
  if (item >= items() || first >= outputs(item)) return;
  vec4 sums[BLOCK];
  for (int j = 0; j < BLOCK; ++j) sums[j] = vec4(0.0);
  int count = terms(item);
  for (int k = 0; k < count; ++k) {
    vec4 value = load(group, item, k);
    for (int j = 0; j < BLOCK; ++j) sums[j] += value * factor(item, k, first + j);
  }
  int used = outputs(item);
  for (int j = 0; j < BLOCK; ++j)
    if (first + j < used) store(group, item, first + j, sums[j]);
}
