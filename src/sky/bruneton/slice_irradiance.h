#pragma once
#include <glm/glm.hpp>

#include "sky/bruneton/sky_slice.h"

namespace skylapse::sky::bruneton {

/// Horizontal irradiance by the sky of a slice on a level surface at the camera that faces up, from
/// all that lies above elevation 0, without the disc [W m^-2 with CIE weights, 1 au].
/// By Gauss quadrature in the slice's own coordinates: within 2e-3 of the integral of
/// SkySlice::radiance_xyz (tested).
glm::dvec3 horizontal_irradiance_xyz(const SkySlice& slice);

/// A small slice that is enough for it, whatever the frame's own is and however little of it is
/// computed: the sky half alone, so that the irradiance of a place depends on no camera. Within
/// kIrradianceSliceError of a slice of 128 x 384, for suns down to -16 deg (bench_economies
/// irradiance).
SliceGrid irradiance_grid(const atmosphere::Medium& medium, Length height);
inline constexpr double kIrradianceSliceError = 2e-3;
SliceWindow irradiance_window(const SliceGrid& grid);

}  // namespace skylapse::sky::bruneton
