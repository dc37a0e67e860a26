#include "diff/compare_pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "diff/judge.h"
#include "image/camera/camera_check.h"
#include "image/camera/camera_words.h"

namespace skylapse::diff {
namespace {

class Stopwatch {
 public:
  double ms() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// What is left of a pair is not worth finishing: the whole comparison ends as interrupted.
bool stopped(const PairOptions& options) {
  return options.stop_signal != nullptr && *options.stop_signal != 0;
}

Result<ReadPicture> read_side(const std::string& path, const std::string& manifest_entry,
                              const ReadLimits& limits) {
  const auto entry = nlohmann::json::parse(manifest_entry, nullptr, false);
  return read_picture(path, limits, entry.is_object() ? &entry : nullptr);
}

void add(PairResult& pair, const std::string& check, std::string message) {
  pair.findings.push_back({Verdict::different, check, std::move(message), {}});
}

/// Whether the pixels can be held against each other at all; what speaks against it is added.
bool comparable(const ReadPicture& a, const ReadPicture& b, PairResult& pair) {
  const image::Picture &pa = a.picture, &pb = b.picture;
  if (pa.width != pb.width || pa.height != pb.height)
    add(pair, "size",
        fmt::format("A is {} x {} pixels, B {} x {}", pa.width, pa.height, pb.width, pb.height));
  if (pa.channels != pb.channels)
    add(pair, "channels",
        fmt::format("A has the channels {}, B {}", fmt::join(pa.channels, ", "),
                    fmt::join(pb.channels, ", ")));
  return pair.findings.empty();
}

/// Floats against integers: the floats are display values too, or nothing will agree.
void use_one_scale(image::Picture& a, image::Picture& b) {
  a.display_referred = b.display_referred = a.display_referred || b.display_referred;
}

/// The camera of the command line in the size of the picture; of cubes the layout that has its
/// proportions.
image::Camera camera_of_size(image::Camera camera, int width, int height) {
  using enum image::CubeLayout;
  camera.width = width, camera.height = height;
  if (camera.projection == image::Projection::cube)
    for (const auto layout : {horizontal_strip, cross, vertical_cross, vertical_strip}) {
      camera.cube_layout = layout;
      if (!image::camera_problem(camera)) break;
    }
  return camera;
}

/// What is known of the sky from A, else from B, else from the command line.
image::SkyView view_of(const ReadPicture& a, const ReadPicture& b, const PairOptions& options,
                       PairResult& pair) {
  image::SkyView view = a.facts.view;
  const image::Picture& picture = a.picture;
  if (!view.camera) view.camera = b.facts.view.camera;
  if (view.camera && (view.camera->width != picture.width || view.camera->height != picture.height))
    view.camera.reset();
  if (!view.camera && options.camera) {
    view.camera = camera_of_size(*options.camera, picture.width, picture.height);
    if (const auto problem = image::camera_problem(*view.camera)) {
      add(pair, "metadata.projection",
          fmt::format("no {} map: {}", name_of(view.camera->projection), *problem));
      view.camera.reset();
    }
  }
  if (!view.sun && b.facts.view.sun) {
    view.sun = b.facts.view.sun;
    view.sun_radius = b.facts.view.sun_radius;
  }
  if (!view.sun) view.sun = options.sun;
  return view;
}

image::CompareOptions compare_options(const ReadPicture& a, const Limits& limits,
                                      const PairOptions& options) {
  image::CompareOptions out;
  out.forgive_rounding = limits.profile != Profile::exact;
  out.psnr_peak = options.psnr_peak;
  const auto space = color::rgb_space_from_name(a.facts.color_space);
  out.rgb_to_xyz = color::rgb_to_xyz(space ? *space : color::RgbSpace::rec709);
  return out;
}

double error_of_pixel(const image::Picture& a, const image::Picture& b, size_t i, double unit) {
  double worst = 0;
  const size_t n = a.channels.size();
  for (size_t c = 0; c < n; ++c) {
    const double va = double(a.samples[i * n + c]), vb = double(b.samples[i * n + c]);
    if (va == vb || (std::isnan(va) && std::isnan(vb))) continue;
    const double e = std::fabs(vb - va) * unit;
    worst = std::isnan(e) ? HUGE_VAL : std::max(worst, e);
  }
  return worst;
}

/// Share of the pixels beyond the limit of the command line: of the failing one, and if that passes
/// of the warning one.
void judge_simple(const SimpleLimit& simple, const image::Picture& a, const image::Picture& b,
                  const image::Comparison& comparison, const image::FlipResult& flip,
                  PairResult& pair) {
  const double unit = a.display_referred ? 255 : 1;
  const auto error = [&](size_t i) -> double {
    if (simple.metric == "absolute") return error_of_pixel(a, b, i, unit);
    return double(simple.metric == "flip" ? flip.map[i] : comparison.error[i]);
  };
  const double allowed = simple.percent / 100;
  for (const auto& [above, limit] : {std::pair(simple.fail, Limit{kNone, allowed}),
                                     std::pair(simple.warn, Limit{allowed, kNone})}) {
    if (std::isnan(above)) continue;
    size_t beyond = 0;
    for (size_t i = 0; i < a.pixel_count(); ++i) beyond += error(i) > above;
    Limits limits;
    limits.measures["pixels.above"] = limit;
    const double share = double(beyond) / double(a.pixel_count());
    judge_measures({{"pixels.above", share, {}}}, limits, pair);
    if (pair.measures.back().verdict == Verdict::different) return;
  }
}

void keep_trace(const image::Comparison& comparison, const image::Picture& a, PairTrace& trace) {
  trace.valid = true, trace.display = a.display_referred;
  trace.identical = comparison.identical;
  trace.hash_a = comparison.hash_a, trace.hash_b = comparison.hash_b;
  trace.thumbnail_a = comparison.thumbnail_a, trace.thumbnail_b = comparison.thumbnail_b;
  trace.regions = comparison.regions;
}

void measure(const ReadPicture& a, const ReadPicture& b, const Limits& limits,
             const PairOptions& options, PairResult& pair, PairTrace* trace) {
  Stopwatch watch;
  const auto comparison =
      image::compare(a.picture, b.picture, pair.view, compare_options(a, limits, options));
  if (trace != nullptr) keep_trace(comparison, a.picture, *trace);
  pair.measure_ms = watch.ms();
  const bool wants_flip = options.simple && options.simple->metric == "flip";
  image::FlipResult flip;
  if (stopped(options)) return;
  if (options.flip || wants_flip) {
    flip = image::flip(a.picture, b.picture, options.flip_options);
    pair.flip_ms = watch.ms();
  }
  // Errors are shares of light, and some are too small to be a number.
  if (limits.profile == Profile::exact && !comparison.identical)
    add(pair, "identical", "the samples are not the same");
  judge_odd_samples(comparison.odd, pair);
  if (options.simple) {
    // Only what was asked for decides; the other values are told without limits.
    judge_measures(comparison.measures, {}, pair);
    if (!flip.map.empty()) judge_measures(flip_measures(flip), {}, pair);
    judge_simple(*options.simple, a.picture, b.picture, comparison, flip, pair);
    return;
  }
  judge_measures(comparison.measures, limits, pair);
  if (!flip.map.empty()) judge_measures(flip_measures(flip), limits, pair);
}

}  // namespace

PairResult compare_pair(const FilePair& files, const Limits& limits, const PairOptions& options,
                        PairTrace* trace) {
  PairResult pair;
  pair.name = files.name;
  pair.a.path = files.a, pair.b.path = files.b;
  pair.profile = name_of(limits.profile);
  Stopwatch watch;
  auto a = read_side(files.a, files.manifest_entry_a, options.limits);
  if (!a) {
    pair.error = a.error();
    return pair;
  }
  pair.a = a->facts.file;
  if (stopped(options)) return pair;
  auto b = read_side(files.b, files.manifest_entry_b, options.limits);
  if (!b) {
    pair.error = b.error();
    return pair;
  }
  pair.b = b->facts.file;
  if (stopped(options)) return pair;
  pair.read_ms = watch.ms();
  if (pair.a.renderer.empty()) pair.a.renderer = files.renderer_a;
  if (pair.b.renderer.empty()) pair.b.renderer = files.renderer_b;
  const bool measurable = comparable(*a, *b, pair);
  for (Finding& finding : compare_facts(a->facts, b->facts))
    pair.findings.push_back(std::move(finding));
  if (measurable) {
    use_one_scale(a->picture, b->picture);
    pair.view = view_of(*a, *b, options, pair);
    measure(*a, *b, limits, options, pair, trace);
  }
  conclude(limits, pair);
  return pair;
}

}  // namespace skylapse::diff
