#include "pipeline/products/usda.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/constants.h"
#include "core/version.h"

namespace skylapse::pipeline {
namespace {

/// Text between double quotes.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return out + '"';
}

std::string row(const glm::dvec3& v, int last) {
  const auto tidy = [](double x) { return std::abs(x) < 1e-15 ? 0.0 : x; };
  return fmt::format("({}, {}, {}, {})", tidy(v.x), tidy(v.y), tidy(v.z), last);
}

}  // namespace

Result<std::string> usda_head(const ProductRequest& request) {
  const auto& convention = image::convention_of(request.output.orientation);
  if (glm::determinant(image::enu_to_world(request.output.orientation)) < 0)
    return Error{ErrorCode::invalid_input,
                 fmt::format("{} is left-handed, and USD stages are not", convention.name),
                 request.output.path.span, "orientation: usd"};
  const plan::Frame& frame = request.frame;
  return fmt::format(
      "#usda 1.0\n(\n"
      "    defaultPrim = \"Sky\"\n"
      "    doc = \"\"\"skylapse {}. Scene-linear {}; one unit of radiance is {} cd/m^2, one of "
      "irradiance {} lux: for nits multiply inputs:intensity by {}. North is ({:g}, {:g}, {:g}), "
      "east ({:g}, {:g}, {:g}).\"\"\"\n"
      "    metersPerUnit = 1\n"
      "    upAxis = \"{}\"\n"
      "    customLayerData = {{\n"
      "        dictionary skylapse = {{\n"
      "            string colorSpace = {}\n"
      "            string orientation = {}\n"
      "            string site = {}\n"
      "            string utc = {}\n"
      "            double whiteLuminance = {}\n"
      "        }}\n    }}\n)\n\n",
      kVersion, request.plan.job.color.space, kLuminousEfficacy, kLuminousEfficacy,
      kLuminousEfficacy, convention.north.x, convention.north.y, convention.north.z,
      convention.east.x, convention.east.y, convention.east.z, convention.up.y > 0.5 ? "Y" : "Z",
      quoted(request.plan.job.color.space), quoted(std::string(convention.name)),
      quoted(request.plan.job.sites[frame.site].name), quoted(format_utc(frame.instant, 3)),
      kLuminousEfficacy);
}

std::string usda_transform(const glm::dmat3& axes, const std::string& indent) {
  return fmt::format(
      "{}matrix4d xformOp:transform = ( {}, {}, {}, (0, 0, 0, 1) )\n"
      "{}uniform token[] xformOpOrder = [\"xformOp:transform\"]\n",
      indent, row(axes[0], 0), row(axes[1], 0), row(axes[2], 0), indent);
}

std::string usda_asset(const std::string& file, const std::string& from) {
  const auto folder = std::filesystem::path(from).parent_path();
  const std::string relative = std::filesystem::path(file)
                                   .lexically_relative(folder.empty() ? "." : folder)
                                   .generic_string();
  const std::string anchored = relative.starts_with("..") ? relative : "./" + relative;
  const char* const mark = anchored.find('@') == std::string::npos ? "@" : "@@@";
  return mark + anchored + mark;
}

std::string usda_color_space(const ProductRequest& request) {
  const std::string& space = request.plan.job.color.space;
  if (space == "acescg") return "lin_ap1_scene";
  if (space == "aces2065-1") return "lin_ap0_scene";
  return "lin_" + space + "_scene";
}

ProductFile text_product(const std::string& text) {
  ProductFile file;
  const auto* const first = reinterpret_cast<const std::byte*>(text.data());
  file.bytes.assign(first, first + text.size());
  return file;
}

}  // namespace skylapse::pipeline
