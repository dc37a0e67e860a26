#include "pipeline/frame_files.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <optional>

#include "color/dither.h"
#include "color/exposure.h"
#include "core/constants.h"
#include "core/parallel.h"
#include "core/sha256.h"
#include "output/atomic_file.h"
#include "pipeline/fingerprint.h"
#include "pipeline/image_file.h"
#include "pipeline/job_context.h"
#include "pipeline/products/cube_texture.h"
#include "pipeline/products/product.h"
#include "pipeline/reference_sky.h"

namespace skylapse::pipeline {
namespace {

/// Where the config names the view; the output's path if it names none.
SourceSpan view_span_of(const config::Output& output) {
  const auto written_in = [](const auto& o) {
    return o.view_span.line > 0 ? o.view_span : o.path.span;
  };
  if (const auto* image = std::get_if<config::ImageOutput>(&output)) return written_in(*image);
  if (const auto* movie = std::get_if<config::MovieOutput>(&output)) return written_in(*movie);
  return config::path_of(output).span;
}

bool same_camera(const image::Camera& a, const image::Camera& b) {
  return a.projection == b.projection && a.width == b.width && a.height == b.height &&
         a.field_of_view == b.field_of_view && a.cube_layout == b.cube_layout &&
         a.camera_to_enu == b.camera_to_enu;
}

/// Rows of the camera's picture that are made at once, and where they lie in the files.
struct RowRange {
  int source_row = 0, file_row = 0, rows = 0;
};

/// All rows in the order of the files, in ranges of at most `strip_pixels`.
std::vector<RowRange> row_ranges(const OutputView& view, size_t strip_pixels) {
  const image::Camera& camera = view.camera.camera;
  const int most =
      int(std::clamp<size_t>(strip_pixels / size_t(camera.width), 1, size_t(camera.height)));
  const bool by_face =
      view.reorders_faces() && camera.cube_layout == image::CubeLayout::vertical_strip;
  const int blocks = by_face ? 6 : 1, block_rows = camera.height / blocks;
  std::vector<RowRange> ranges;
  for (int b = 0; b < blocks; ++b)
    for (int row = 0; row < block_rows; row += most)
      ranges.push_back({(by_face ? view.faces[size_t(b)] : b) * block_rows + row,
                        b * block_rows + row, std::min(most, block_rows - row)});
  return ranges;
}

void exchange_columns(image::FrameBuffer& picture, int first, int second, int count) {
  for (int y = 0; y < picture.height(); ++y)
    std::swap_ranges(picture.pixel(first, y), picture.pixel(first, y) + 3 * ptrdiff_t(count),
                     picture.pixel(second, y));
}

/// Makes the strips of one view.
class StripMaker {
 public:
  StripMaker(const FrameSource& source, const OutputView& view, bool with_sky, bool weighed)
      : source_(source), view_(view), with_sky_(with_sky), weighed_(weighed) {}

  Status make(const RowRange& range, PictureStrip& strip, StageTimes& times) const {
    const image::Camera& camera = view_.camera.camera;
    strip.first_row = range.file_row;
    if (strip.scene.height() != range.rows)
      strip.scene = image::FrameBuffer(camera.width, range.rows);
    else
      std::fill(strip.scene.data().begin(), strip.scene.data().end(), 0.0F);
    const Status filled =
        source_.light.fill_rows(camera, Disc::without, range.source_row, strip.scene, times);
    if (!filled) return filled;
    if (source_.light.sky.noise) strip.standard_error = &source_.light.sky.noise->standard_error;
    if (with_sky_) strip.sky = strip.scene;
    source_.light.add_disc_rows(camera, range.source_row, strip.scene, times);
    const StageTimer timer(times, Stage::encode);
    if (weighed_) strip.weights.emplace(camera, range.source_row, range.rows);
    arrange(strip);
    return Done{};
  }

 private:
  /// Faces side by side, in the order of the files.
  void arrange(PictureStrip& strip) const {
    const image::Camera& camera = view_.camera.camera;
    if (!view_.reorders_faces() || camera.cube_layout != image::CubeLayout::horizontal_strip)
      return;
    const int side = camera.height;  // only the last two change places
    assert(view_.faces[4] == 5 && view_.faces[5] == 4);
    exchange_columns(strip.scene, 4 * side, 5 * side, side);
    if (with_sky_) exchange_columns(strip.sky, 4 * side, 5 * side, side);
    if (strip.weights) strip.weights->exchange_columns(4 * side, 5 * side, side);
  }

  const FrameSource& source_;
  const OutputView& view_;
  bool with_sky_, weighed_;
};

/// Writes a finished file and describes it for the ledger.
Result<LedgerEntry> write_whole(const FrameSource& source, const std::string& file,
                                const std::string& fingerprint, const ProductFile& made,
                                StageTimes& times) {
  const StageTimer timer(times, Stage::write);
  const Status written = output::write_file_atomically(source.folder / file, made.bytes);
  if (!written) return written.error();
  LedgerEntry entry = entry_for(source, file, fingerprint);
  entry.sha256 = sha256_hex(made.bytes);
  entry.bytes = made.bytes.size();
  entry.encoding = made.encoding;
  const auto held = made.encoding.find("horizontal_lux");
  const auto whole = made.encoding.find("true_horizontal_lux");
  if (held != made.encoding.end() && whole != made.encoding.end() && whole->second > 0)
    entry.encoding.try_emplace("error_percent", 100 * (held->second / whole->second - 1));
  return entry;
}

}  // namespace

Result<Displays> Displays::make(const output::ImageIo& io, const config::JobConfig& job) {
  Displays displays;
  std::map<std::pair<std::string, std::string>, std::shared_ptr<const output::DisplayTransform>>
      made;
  for (const auto& output : job.outputs) {
    const auto* image = std::get_if<config::ImageOutput>(&output);
    const auto* movie = std::get_if<config::MovieOutput>(&output);
    std::pair<std::optional<std::string>, std::optional<std::string>> names;
    if (image != nullptr) names = {image->display, image->view};
    if (movie != nullptr) names = {movie->display, movie->view};
    if (movie == nullptr && !names.first && !names.second) {
      displays.by_output_.push_back(nullptr);
      continue;
    }
    const auto key = std::pair(names.first.value_or(""), names.second.value_or(""));
    auto& transform = made[key];
    if (!transform) {
      auto fresh = io.display({color_config_file(job), job.color.space, key.first, key.second});
      if (!fresh) {
        Error error = fresh.error();
        error.span = view_span_of(output);
        return error;
      }
      transform = std::move(*fresh);
    }
    displays.by_output_.push_back(transform);
  }
  return displays;
}

const output::DisplayTransform* Displays::of(size_t output) const {
  return by_output_[output].get();
}

uint64_t dither_seed(const plan::Frame& frame) {
  return uint64_t(frame.instant.utc.time_since_epoch().count()) * 2 + frame.instant.leap_second;
}

void display_values(const plan::Frame& frame, const image::FrameBuffer& scene,
                    const output::DisplayTransform& display, std::span<float> values) {
  assert(values.size() == scene.data().size());
  const float scale = float(color::exposure_scale_per_cd_m2(frame.ev) * kLuminousEfficacy);
  parallel_for_ranges(scene.pixel_count(), 1 << 14, [&](size_t begin, size_t end) {
    for (size_t i = 3 * begin; i < 3 * end; ++i) values[i] = scene.data()[i] * scale;
    display.apply(values.data() + 3 * begin, end - begin);
  });
}

std::vector<uint8_t> display_picture(const plan::Frame& frame, const RenderedFrame& rendered,
                                     const output::DisplayTransform& display, StageTimes& times) {
  const StageTimer timer(times, Stage::display);
  const image::FrameBuffer& scene = rendered.scene;
  std::vector<float> values(scene.data().size());
  display_values(frame, scene, display, values);
  std::vector<uint8_t> picture(values.size());
  color::quantise_u8(values.data(), size_t(scene.width()), size_t(scene.height()),
                     dither_seed(frame), picture.data());
  return picture;
}

std::vector<ViewGroup> group_by_view(const plan::Plan& plan, const plan::Frame& frame,
                                     const std::vector<size_t>& outputs) {
  std::vector<ViewGroup> groups;
  for (const size_t o : outputs) {
    const auto* image = std::get_if<config::ImageOutput>(&plan.job.outputs[o]);
    if (image == nullptr || is_texture(plan.job.outputs[o])) continue;
    const OutputView view = view_of_output(plan, frame, *image);
    const auto known = std::find_if(groups.begin(), groups.end(), [&](const ViewGroup& group) {
      return same_camera(group.view.camera.camera, view.camera.camera) &&
             group.view.faces == view.faces &&
             group.view.camera.cube_faces_apart == view.camera.cube_faces_apart;
    });
    if (known != groups.end())
      known->outputs.push_back(o);
    else
      groups.push_back({view, {o}});
  }
  return groups;
}

Status write_view(const FrameSource& source, const ViewGroup& group,
                  const FingerprintOf& fingerprint_of, const StageTimes& before,
                  const Record& record, StageTimes& times, size_t strip_pixels) {
  std::vector<ImageFile> files;
  bool sky = false, weighed = false, survey = false;
  for (const size_t o : group.outputs) {
    const ImageFile& file = files.emplace_back(source, o, group.view, fingerprint_of(o));
    sky = sky || file.needs_sky();
    weighed = weighed || file.is_weighed();
    survey = survey || file.needs_survey();
  }
  weighed = weighed && image::sees_upper_hemisphere(group.view.camera.camera);
  // Paths are drawn for a whole picture: their record is of that.
  const size_t at_once = source.light.sky.noise ? ~size_t{0} : strip_pixels;
  const auto ranges = row_ranges(group.view, at_once);
  const StripMaker maker(source, group.view, sky, weighed);
  PictureStrip strip;
  StageTimes shared;
  const auto for_strips = [&](const auto& act, bool made) -> Status {
    for (const RowRange& range : ranges) {
      if (source.stopped && source.stopped()) return interrupted();
      if (!made)
        if (const Status filled = maker.make(range, strip, shared); !filled) return filled;
      for (ImageFile& file : files)
        if (const Status acted = act(file); !acted) return acted;
    }
    return Done{};
  };
  if (survey) {
    const Status seen = for_strips(
        [&](ImageFile& file) -> Status {
          if (file.needs_survey()) file.survey(strip);
          return Done{};
        },
        false);
    if (!seen) return seen;
  }
  for (ImageFile& file : files)
    if (const Status opened = file.open(); !opened) return opened;
  const bool still_there = survey && ranges.size() == 1;
  const Status written = for_strips([&](ImageFile& file) { return file.add(strip); }, still_there);
  if (!written) return written;
  times += shared;
  for (ImageFile& file : files) {
    auto entries = file.finish();
    if (!entries) return entries.error();
    StageTimes all = before;
    all += shared;
    all += file.times();
    times += file.times();
    for (LedgerEntry& entry : *entries) {
      entry.times = all;
      if (const Status recorded = record(std::move(entry)); !recorded) return recorded;
    }
  }
  return Done{};
}

bool is_texture(const config::Output& output) {
  const auto* image = std::get_if<config::ImageOutput>(&output);
  return image != nullptr && image->format == "ktx2";
}

Status write_texture(const FrameSource& source, size_t index, const std::string& fingerprint,
                     const StageTimes& before, const Record& record, StageTimes& times) {
  const auto& output = std::get<config::ImageOutput>(source.plan.job.outputs[index]);
  const config::CameraConfig view = view_of_output(source.plan, source.frame, output).camera;
  const image::Camera& camera = view.camera;
  StageTimes own;
  const bool whole = output.content == config::ImageContent::radiance;
  auto sky = source.light.picture(camera, Disc::without, own);
  if (!sky) return sky.error();
  image::FrameBuffer strip = *sky;
  if (whole) source.light.add_disc_rows(camera, 0, strip, own);
  auto meta = metadata_of(source.plan, source.frame, source.light, fingerprint);
  describe_picture(source.light, output, view, meta);
  output::SampleType type = output.sample_type;
  if (type == output::SampleType::half_float) {
    const bool split = output.sun_policy == output::SunPolicy::split;
    output::RangeSurvey survey;
    survey.add(strip.data(), (split ? *sky : strip).data(), strip.width());
    const auto policy = output::decide_sun_policy(survey, output.sun_policy);
    if (!policy) return at_sun_policy(output, policy.error());
    if (split) strip = *sky;
    output::apply_sun_policy(strip.data(), *policy);
    meta.sun_policy = *policy;
    if (policy->policy == output::SunPolicy::float32 &&
        (policy->pixels_beyond_half > 0 || survey.underflows_half()))
      type = output::SampleType::float32;
  }
  auto made = make_cube_texture(strip, camera, type, meta, output.orientation, own);
  if (!made) return made.error();
  if (meta.sun_policy) made->encoding.merge(policy_record(*meta.sun_policy));
  made->encoding["stored_bits"] = stored_bits(type);
  add_light_record(source, output, made->encoding["horizontal_lux"], made->encoding);
  const auto file = plan::files_of(source.plan, source.frame, index).front();
  auto entry = write_whole(source, file, fingerprint, *made, own);
  if (!entry) return entry.error();
  times += own;
  own += before;
  entry->times = own;
  return record(*std::move(entry));
}

Status write_product(const FrameSource& source, size_t index, const std::string& fingerprint,
                     const StageTimes& before, const Record& record, StageTimes& times) {
  const auto& output = std::get<config::ProductOutput>(source.plan.job.outputs[index]);
  const auto files = plan::files_of(source.plan, source.frame, index);
  const ProductRequest request{
      source.plan,  source.frame, output,
      source.light, source.io,    metadata_of(source.plan, source.frame, source.light, fingerprint),
      files};
  StageTimes own;
  const auto made = make_product(request, own);
  if (!made) {
    Error error = made.error();
    if (error.span.line == 0) error.span = output.path.span;
    return error;
  }
  assert(made->size() == files.size());
  std::vector<LedgerEntry> entries;
  for (size_t i = 0; i < files.size(); ++i) {
    auto entry = write_whole(source, files[i], fingerprint, (*made)[i], own);
    if (!entry) return entry.error();
    entries.push_back(*std::move(entry));
  }
  times += own;
  own += before;
  for (LedgerEntry& entry : entries) {
    entry.times = own;
    if (const Status recorded = record(std::move(entry)); !recorded) return recorded;
  }
  return Done{};
}

}  // namespace skylapse::pipeline
