#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "config/output_section.h"
#include "config/path_template.h"

namespace skylapse::config {
namespace {

using OutputSections = std::vector<std::shared_ptr<const Section>>;

std::string_view kind_of(const Section& section) { return section.spec->keys[0].name; }

std::optional<Output> build_output(const OutputItem& item) {
  const auto as_output = [](auto built) {
    return built ? std::optional<Output>(*std::move(built)) : std::nullopt;
  };
  const std::string_view kind = item.path_key;
  if (kind == "image") return as_output(build_image(item));
  if (kind == "movie") return as_output(build_movie(item));
  if (kind == "gallery") return as_output(build_library(item, LibraryKind::gallery));
  if (kind == "sheet") return as_output(build_library(item, LibraryKind::sheet));
  static constexpr std::array<std::pair<std::string_view, ProductKind>, 5> kProducts{
      {{"specular", ProductKind::specular},
       {"irradiance", ProductKind::irradiance},
       {"harmonics", ProductKind::harmonics},
       {"sun", ProductKind::sun},
       {"dome", ProductKind::dome}}};
  for (const auto& [name, product] : kProducts)
    if (name == kind) return as_output(build_product(item, product));
  return std::nullopt;
}

/// The key by which an output names an image output of the job; empty if it names none.
std::string_view reference_key(const Section& section) {
  const std::string_view kind = kind_of(section);
  if (kind == "dome") return "map";
  return kind == "gallery" || kind == "sheet" ? "image" : std::string_view{};
}

/// Why `image` is none that this kind of output can show; empty if it can.
std::string why_not_shown(std::string_view kind, const ImageOutput& image, const JobConfig& job) {
  if (kind != "dome") {
    const bool picture = image.format == "png" || image.format == "jpg";
    return is_display_referred(image) && picture ? "" : "it is no display-referred png or jpg";
  }
  const auto no_map = [](const CameraConfig& c) {
    return c.camera.projection != image::Projection::lat_long;
  };
  const bool other = image.own_view ? no_map(*image.own_view)
                                    : std::any_of(job.cameras.begin(), job.cameras.end(), no_map);
  if (other) return "it is no lat-long map";
  const bool linear = image.format == "exr" || image.format == "hdr";
  return linear && !is_display_referred(image) ? "" : "it is no scene-linear exr or hdr";
}

/// Finds the image output that `section` names.
std::optional<Spanned<std::string>> resolve_image(const Section& section,
                                                  const OutputSections& sections,
                                                  const std::vector<Output>& outputs,
                                                  const JobConfig& job,
                                                  const ReadContext& context) {
  const std::string_view key = reference_key(section);
  const auto written = section.get<std::string>(key);
  if (!written) return std::nullopt;
  const std::string wanted = normalised_path(*written);
  const auto refuse = [&](std::string message, std::string hint) {
    context.errors.add(section.place_of(key), fmt::format("{}: {}", section.path_of(key), message),
                       std::move(hint));
    return std::nullopt;
  };
  std::vector<std::string> names;
  for (const auto& other : sections)
    if (kind_of(*other) == "image")
      if (const auto name = other->get<std::string>("image"))
        names.push_back(normalised_path(*name));
  if (std::find(names.begin(), names.end(), wanted) == names.end()) {
    const auto nearest = nearest_name(wanted, names);
    return refuse("no image output has this name",
                  nearest         ? fmt::format("did you mean {}?", *nearest)
                  : names.empty() ? "add an image output with this name"
                                  : fmt::format("image outputs: {}", fmt::join(names, ", ")));
  }
  for (const Output& output : outputs) {
    const auto* image = std::get_if<ImageOutput>(&output);
    if (image == nullptr || image->path.value != wanted) continue;
    const std::string why = why_not_shown(kind_of(section), *image, job);
    if (!why.empty()) return refuse(fmt::format("{} cannot be shown here: {}", wanted, why), "");
    return Spanned<std::string>{wanted, context.sources.span(section.place_of(key))};
  }
  return std::nullopt;  // the image output has errors of its own
}

void resolve_references(const OutputSections& sections, const std::vector<size_t>& section_of,
                        const JobConfig& job, const ReadContext& context,
                        std::vector<Output>& outputs) {
  for (size_t i = 0; i < outputs.size(); ++i) {
    const Section& section = *sections[section_of[i]];
    if (reference_key(section).empty()) continue;
    const auto image = resolve_image(section, sections, outputs, job, context);
    if (!image) continue;
    if (auto* product = std::get_if<ProductOutput>(&outputs[i])) product->map_path = *image;
    if (auto* library = std::get_if<LibraryOutput>(&outputs[i])) library->image_path = *image;
  }
}

void check_names_differ(const OutputSections& sections, const ReadContext& context) {
  std::map<std::string, int> lines;
  for (const auto& section : sections) {
    const std::string_view key = kind_of(*section);
    const auto path = section->get<std::string>(key);
    if (!path) continue;
    const int line = context.sources.span(section->place_of(key)).line;
    const auto [first, is_new] = lines.emplace(normalised_path(*path), line);
    if (!is_new)
      context.errors.add(section->place_of(key), "two outputs have this name",
                         fmt::format("the first is on line {}", first->second));
  }
}

}  // namespace

std::vector<Output> build_outputs(const Section& root, const JobConfig& job,
                                  const ReadContext& context) {
  std::vector<Output> outputs;
  std::vector<size_t> section_of;
  const OutputSections sections = root.sections("outputs");
  for (size_t i = 0; i < sections.size(); ++i) {
    auto output = build_output(OutputItem(*sections[i], job, context));
    if (!output) continue;
    outputs.push_back(*std::move(output));
    section_of.push_back(i);
  }
  resolve_references(sections, section_of, job, context, outputs);
  check_names_differ(sections, context);
  return outputs;
}

}  // namespace skylapse::config
