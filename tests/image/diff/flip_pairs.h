#pragma once
// The 15 pairs of pictures that the published values of FLIP belong to (tests/data/flip/SOURCE.md).
#include <string>

#include "image/diff/flip.h"

namespace skylapse::image {

struct FlipPair {
  std::string name;
  Picture reference, test;
  FlipOptions options;
  std::string reference_fnv1a, test_fnv1a;  // of the bytes: code values, or little-endian floats
};

/// A row of tests/data/flip/pairs.tsv, with the pictures that the formulas of that name give.
FlipPair flip_pair(const std::string& row);

/// FNV-1a 64 of the picture's samples, in hexadecimal.
std::string fnv1a_of(const Picture& picture);

/// Scene-linear R, G, B.
Picture linear_picture(int width, int height);

}  // namespace skylapse::image
