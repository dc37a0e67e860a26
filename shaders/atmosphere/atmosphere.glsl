// The physics text after parameters.glsl, in order.
#include "atmosphere/density.glsl"
#include "atmosphere/phase.glsl"
#include "atmosphere/geometry.glsl"
#include "atmosphere/coordinates.glsl"
#include "atmosphere/sun.glsl"
#include "atmosphere/slice.glsl"
#include "atmosphere/march.glsl"
