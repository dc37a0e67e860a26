#pragma once
// How different two colours on a display look.
#include <glm/glm.hpp>

namespace skylapse::study {

/// CIE 1976 L*a*b* under D65 of a display-encoded sRGB colour (0..1, clamped as a display does).
glm::dvec3 lab_of_srgb(const glm::dvec3& encoded);

/// CIEDE2000 with k_L = k_C = k_H = 1. About 1 is the least difference that people see side by
/// side. Source: Sharma, Wu & Dalal 2005, "The CIEDE2000 color-difference formula: implementation
/// notes, supplementary test data, and mathematical observations", Color Research and Application
/// 30:21.
double ciede2000(const glm::dvec3& lab1, const glm::dvec3& lab2);

}  // namespace skylapse::study
