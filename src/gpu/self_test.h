#pragma once
// Whether a context computes: a shader squares and sums numbers.
#include "core/result.h"
#include "gpu/context.h"

namespace skylapse::gpu {

/// Error if the shader does not compile, or its sums are not what arithmetic says.
Status self_test(Context& context);

}  // namespace skylapse::gpu
