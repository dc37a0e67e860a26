#include "study/calibration_file.h"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace skylapse::study {
namespace {

constexpr std::string_view kSceneColumns =
    "seed,index,sun_elevation_deg,height_km,aerosol_optical_depth,ground_albedo,ozone_du,aerosol_g,"
    "single_scattering_albedo,angstrom_exponent,core_seconds";
constexpr size_t kSceneFields = 11;

Error unreadable(const std::string& path, int line, const std::string& what) {
  return {ErrorCode::invalid_input, fmt::format("{}: {}", path, what), {path, line, 1}, ""};
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',')
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

}  // namespace

std::string measured_header() {
  std::string header(kSceneColumns);
  for (const auto error : plan::kErrorPartNames)
    for (const auto part : plan::kSkyPartNames) header += fmt::format(",{}@{}", error, part);
  for (const auto part : plan::kSkyPartNames) header += fmt::format(",uncertainty@{}", part);
  return header;
}

std::string measured_line(const MeasuredScene& m) {
  const auto& air = m.scene.air;
  std::string line = fmt::format(
      "{},{},{:.3f},{:.3f},{:.4f},{:.3f},{:.0f},{:.3f},{:.3f},{:.2f},{:.3g}", m.seed, m.index,
      m.scene.sun_elevation.in(deg), m.scene.height.in(km), air.aerosol_optical_depth,
      m.scene.ground_albedo, air.ozone_du, air.aerosol_g, air.aerosol_single_scattering_albedo,
      air.angstrom_exponent, m.errors.core_seconds);
  for (const auto& error : m.errors.parts)
    for (const auto& part : error) line += part ? fmt::format(",{:.3e}", part->value) : ",";
  for (const auto& part : m.errors.parts[size_t(plan::ErrorPart::fine)])
    line += part ? fmt::format(",{:.2e}", part->uncertainty) : ",";
  return line;
}

Result<std::vector<MeasuredScene>> read_measured(const std::string& path) {
  std::ifstream in(path);
  if (!in) return Error{ErrorCode::missing_input, fmt::format("{} cannot be read", path), {}, ""};
  std::vector<MeasuredScene> all;
  std::string line;
  std::getline(in, line);
  if (line != measured_header()) return unreadable(path, 1, "not the columns of measured scenes");
  for (int number = 2; std::getline(in, line); ++number) {
    const auto fields = fields_of(line);
    if (fields.size() != kSceneFields + (plan::kErrorParts + 1) * plan::kSkyParts)
      return unreadable(path, number, "a line of another length");
    MeasuredScene m;
    m.seed = std::strtoull(fields[0].c_str(), nullptr, 10);
    m.index = std::atoi(fields[1].c_str());
    m.scene = draw_scene(m.seed, m.index);
    m.errors.core_seconds = std::atof(fields[10].c_str());
    size_t next = kSceneFields;
    for (auto& error : m.errors.parts)
      for (auto& part : error) {
        const std::string& field = fields[next++];
        if (!field.empty()) part = MeanSquare{std::atof(field.c_str()), 0};
      }
    for (auto& part : m.errors.parts[size_t(plan::ErrorPart::fine)]) {
      const std::string& field = fields[next++];
      if (part) part->uncertainty = std::atof(field.c_str());
    }
    all.push_back(std::move(m));
  }
  return all;
}

}  // namespace skylapse::study
