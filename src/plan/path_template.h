#pragma once
// Output names: {site} {date} {time} {camera} {turbidity} {albedo} {sun_elevation} {half} {size}
// {face} {level} ####.
#include <string>
#include <vector>

namespace skylapse::plan {

struct PathValues {
  std::string site, date, time, camera, turbidity, albedo, sun_elevation, half, size, face, level;
};

/// Fills the tokens that have a value; the others and runs of '#' stay. Characters that make file
/// names awkward (spaces, slashes, anything but letters, digits, ".", "_", "-", "+") become "-"
/// inside a value.
std::string expand_tokens(const std::string& path, const PathValues& values);

/// Puts `number` into the run of '#' (zero-padded to its length; longer numbers stay whole).
std::string expand_number(const std::string& path, long number);

/// The six values of {face} in the order +X -X +Y -Y +Z -Z.
const std::vector<std::string>& face_names();

}  // namespace skylapse::plan
