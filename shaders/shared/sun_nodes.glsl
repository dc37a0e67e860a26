#pragma once
// How many sun nodes there are: no define, since a job may need any part of all.

layout(std140, binding = 5) uniform SunNodesBlock {
  int sun_nodes;
  int dark_end;  // 1: the last has no light
};
