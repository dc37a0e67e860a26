#pragma once
// Order of harmonic coefficients, as HarmonicIndex of src/sky/bruneton/harmonics.h: by m, then l.

#include "shared/sun_nodes.glsl"

const int HARMONICS = (DEGREE + 1) * (DEGREE + 2) / 2;
const int ORDERS = DEGREE + 1;  // m = 0..DEGREE

int first_harmonic(int m) { return m * ORDERS - m * (m - 1) / 2; }

// Items of the middle passes: [height][m][sun].
int sun_of(int item) { return item % sun_nodes; }
int m_of(int item) { return (item / sun_nodes) % ORDERS; }
int height_of(int item) { return item / (sun_nodes * ORDERS); }
