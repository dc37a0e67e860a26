// The table of keys is true: to itself, to the defaults in the structs, and to docs/config.md.
#include "config/key_reference.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "config/job_text.h"
#include "config/key_spec.h"
#include "config/quantity_parser.h"

namespace skylapse::config {
namespace {

using test::kSmallJob;
using test::with;

void for_each_section(const SectionSpec& section, const auto& visit,
                      std::set<const SectionSpec*>& seen) {
  if (!seen.insert(&section).second) return;
  visit(section);
  for (const KeySpec& key : section.keys)
    for (const SectionSpec* below : key.sections) for_each_section(*below, visit, seen);
}

void for_each_section(const auto& visit) {
  std::set<const SectionSpec*> seen;
  for_each_section(job_spec(), visit, seen);
  EXPECT_EQ(seen.size(), 22u);
}

TEST(KeyTable, EveryKeyIsExplainedAndNamedOnce) {
  for_each_section([](const SectionSpec& section) {
    std::set<std::string_view> names;
    EXPECT_FALSE(section.doc.empty()) << section.name;
    for (const KeySpec& key : section.keys) {
      EXPECT_TRUE(names.insert(key.name).second) << section.name << "." << key.name;
      EXPECT_FALSE(key.doc.empty()) << section.name << "." << key.name;
    }
    for (const Alternatives& group : section.alternatives)
      for (const std::string_view key : group.keys) EXPECT_TRUE(names.contains(key)) << key;
  });
}

TEST(KeyTable, RangesAreWrittenInTheirUnitsAndInOrder) {
  for_each_section([](const SectionSpec& section) {
    for (const KeySpec& key : section.keys) {
      const bool needs_range = key.kind == ValueKind::quantity || key.kind == ValueKind::number ||
                               key.kind == ValueKind::integer || key.kind == ValueKind::azimuth;
      if (!needs_range) continue;
      if (key.dimension == Dimension::none) {
        EXPECT_LT(*parse_number(key.min), *parse_number(key.max))
            << section.name << "." << key.name;
        continue;
      }
      const auto low = parse_quantity(key.min, key.dimension),
                 high = parse_quantity(key.max, key.dimension);
      ASSERT_TRUE(low.ok() && high.ok()) << section.name << "." << key.name;
      EXPECT_LT(*low, *high) << section.name << "." << key.name;
    }
  });
}

/// The parts of a job that have defaults, as text.
std::string summary(const JobConfig& job) {
  const auto& camera = job.cameras.at(0).camera;
  std::string text = fmt::format(
      "{} {} {} {} | {} {} {} {} {} | {} {} {} {} | {} {} | {} {} {} {} | {} {}",
      job.sites[0].position.height.in(metre), job.time.dut1.in(second),
      job.time.from->clock->count(), job.time.to->clock->count(), job.air.turbidity[0].value,
      job.air.ground_albedo[0].value.value, job.air.refraction.enabled,
      job.air.refraction.pressure.in(hPa), job.air.refraction.temperature.in(degC),
      int(job.sky.fit), int(job.sky.solar_flux), job.sky.sun_disc, int(job.sky.sun_algorithm),
      int(camera.projection), int(camera.cube_layout), int(job.exposure.mode), job.exposure.ev,
      job.exposure.compensation, job.exposure.rate_limit, job.color.space, job.allow_outside_paths);
  const auto& air = job.air.description;
  text +=
      fmt::format(" | {} {} {} {} {} {} {} {} {} {} {} {} | {} {} {} {}", air.aerosol_optical_depth,
                  air.angstrom_exponent, air.aerosol_single_scattering_albedo, air.aerosol_g,
                  air.aerosol_scale_height.in(km), air.stratospheric_optical_depth,
                  air.stratospheric_bottom.in(km), air.stratospheric_top.in(km), air.ozone_du,
                  air.surface_pressure.in(hPa), air.planet_radius.in(km), air.top_height.in(km),
                  job.air.needs_atmosphere.has_value(), int(job.sky.model), int(job.sky.level),
                  job.sky.wavelengths);
  const Sky& sky = job.sky;
  text += fmt::format(" | {} {} {} {}x{} {} | {} {} {} {} | {} {} {}", int(sky.effects.rule),
                      sky.effects.listed.size(), sky.orders, sky.slice_azimuths, sky.slice_zeniths,
                      int(sky.precision), sky.paths.samples, sky.paths.relative_error.value_or(0),
                      sky.paths.seed, sky.cie_type, sky.accuracy.has_value(),
                      sky.time_budget.has_value(), sky.steps);
  for (const Output& output : job.outputs) {
    if (const auto* image = std::get_if<ImageOutput>(&output))
      text += fmt::format(" | {} {} {} {}", int(image->sample_type), int(image->sun_policy),
                          image->quality, image->compression);
    if (const auto* movie = std::get_if<MovieOutput>(&output))
      text += fmt::format(" | {} {}", movie->frames_per_second, movie->crf);
    if (const auto* product = std::get_if<ProductOutput>(&output))
      text += fmt::format(" | {} {} {} {} {}", int(product->sample_type), product->levels,
                          int(product->orientation), product->sun_disc,
                          product->view ? product->view->camera.width : 0);
    if (const auto* library = std::get_if<LibraryOutput>(&output))
      text += fmt::format(" | {}", library->columns);
  }
  return text;
}

TEST(KeyTable, WritingADefaultChangesNothing) {
  const std::string job_text =
      with(kSmallJob, "[{image: sky.####.png}]",
           "[{image: sky.####.exr, type: half}, {image: sky.####.jpg}, {movie: day.mp4}, "
           "{specular: s.####.ktx2}, {irradiance: i.####.exr}, {harmonics: h.####.json}, "
           "{sun: sun.####.json}, {dome: d.####.usda, map: m.####.exr}, {sheet: s.png, image: "
           "sky.####.jpg}, {image: m.####.exr, projection: lat-long}]");
  const std::map<std::string, std::string> outputs{
      {"movie output", "outputs.2."},      {"specular output", "outputs.3."},
      {"irradiance output", "outputs.4."}, {"harmonics output", "outputs.5."},
      {"sun output", "outputs.6."},        {"dome output", "outputs.7."},
      {"sheet output", "outputs.8."}};
  size_t written = 0;
  for_each_section([&](const SectionSpec& section) {
    for (const KeySpec& key : section.keys) {
      const std::string name(key.name), spec(section.name);
      // Names have a numbered default, and these keys belong to other projections or modes.
      if (key.default_text.empty() || name == "name" || name == "layout" || name == "ev" ||
          name == "rate_limit" || name == "half" || spec == "dates" || spec == "look_at" ||
          (name == "orientation" && spec == "sun output"))
        continue;
      const std::string path =
          spec.empty()             ? name
          : spec == "image output" ? (name == "quality" ? "outputs.1." : "outputs.0.") + name
          : outputs.contains(spec) ? outputs.at(spec) + name
          : spec == "aerosol" || spec == "stratosphere" ? "air." + spec + "." + name
                                                        : spec + "." + name;
      const auto plain = parse_job(job_text, "job.yaml");
      const auto changed = parse_job(job_text, "job.yaml", {{path, std::string(key.default_text)}});
      ASSERT_TRUE(plain.ok()) << test::error_of(job_text);
      ASSERT_TRUE(changed.ok()) << test::error_of(job_text,
                                                  {{path, std::string(key.default_text)}});
      EXPECT_EQ(summary(*plain), summary(*changed)) << path;
      ++written;
    }
  });
  EXPECT_GE(written, 20u);
  EXPECT_EQ(
      color::ExposureSettings{}.ev,
      *parse_quantity(
          find_key_spec(*find_key_spec(job_spec(), "exposure")->sections[0], "ev")->default_text,
          Dimension::exposure_value));
  EXPECT_EQ(color::ExposureSettings{}.rate_limit,
            *parse_quantity(
                find_key_spec(*find_key_spec(job_spec(), "exposure")->sections[0], "rate_limit")
                    ->default_text,
                Dimension::exposure_rate));
}

/// The generated part of docs/config.md between two markers. Set SKYLAPSE_UPDATE_DOCS=1 to write it
/// anew.
void expect_in_docs(const std::string& markers, const std::string& table) {
  const std::string file = SKYLAPSE_SOURCE_DIR "/docs/config.md";
  const std::string begin = "<!-- " + markers + ": begin -->\n\n",
                    end = "<!-- " + markers + ": end -->\n";
  std::ostringstream stream;
  stream << std::ifstream(file).rdbuf();
  const std::string text = stream.str();
  const size_t first = text.find(begin), last = text.find(end);
  ASSERT_NE(first, std::string::npos) << file;
  ASSERT_NE(last, std::string::npos) << file;
  const std::string written = text.substr(first + begin.size(), last - first - begin.size());
  if (std::getenv("SKYLAPSE_UPDATE_DOCS") != nullptr)
    std::ofstream(file) << text.substr(0, first + begin.size()) << table << text.substr(last);
  else
    EXPECT_EQ(written, table)
        << "the table in docs/config.md is old: run this test with SKYLAPSE_UPDATE_DOCS=1";
}

TEST(KeyTable, TheDocsHoldItAsItIs) { expect_in_docs("key table", key_reference_markdown()); }

TEST(AtmosphereKeyTable, TheDocsHoldItAsItIs) {
  expect_in_docs("atmosphere key table", atmosphere_reference_markdown());
}

}  // namespace
}  // namespace skylapse::config
