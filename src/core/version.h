#pragma once

namespace skylapse {

/// Version of the product.
extern const char* const kVersion;
/// SHA-256 over the sources, shaders and data this binary was built from: part of every frame's
/// fingerprint, so that frames of another build are rendered again.
extern const char* const kSourceHash;

}  // namespace skylapse
