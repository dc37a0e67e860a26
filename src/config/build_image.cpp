#include <fmt/format.h>

#include <algorithm>

#include "config/output_section.h"
#include "config/path_template.h"
#include "config/words.h"

namespace skylapse::config {
namespace {

using output::SampleType;

/// What an image format can hold; the first type is the default.
struct FormatRules {
  std::string_view format;
  std::vector<SampleType> types;
  std::vector<std::string_view> compressions;
};

const std::vector<FormatRules>& format_rules() {
  static const std::vector<FormatRules> rules{
      {"exr",
       {SampleType::float32, SampleType::half_float},
       {"zip", "none", "zips", "piz", "dwaa"}},
      {"hdr", {SampleType::float32}, {}},
      {"png", {SampleType::u8, SampleType::u16}, {}},
      {"jpg", {SampleType::u8}, {}},
      {"tif", {SampleType::u16, SampleType::u8, SampleType::float32}, {"zip", "none"}},
      {"ktx2", {SampleType::half_float, SampleType::float32}, {}},
  };
  return rules;
}

const OutputItem::Endings kEndings{{"exr", "exr"},  {"hdr", "hdr"},  {"png", "png"},
                                   {"jpg", "jpg"},  {"jpeg", "jpg"}, {"tif", "tif"},
                                   {"tiff", "tif"}, {"ktx2", "ktx2"}};

/// Reads one image output, key by key.
class ImageReader {
 public:
  ImageReader(const OutputItem& item, std::string format) : item_(item), section_(item.section) {
    out_.path = item.spanned_path();
    out_.format = std::move(format);
  }

  ImageOutput read() {
    read_type();
    out_.view_span = item_.span_of_first({"view", "display"});
    out_.sun_policy_span = item_.span_of_first({"sun"});
    read_view();
    read_content();
    read_sun();
    read_compression();
    if (const auto quality = section_.get<long>("quality")) out_.quality = int(*quality);
    if (section_.has("quality") && out_.format != "jpg")
      item_.no_meaning("quality", "it belongs to jpg");
    out_.own_view = build_own_view(section_, item_.job.cameras, item_.context);
    if (const auto word = section_.get<std::string>("orientation"))
      out_.orientation = *value_of(kOrientationWords, *word);
    check_cube();
    check_faces();
    item_.check_names_of_frames();
    item_.refuse_tokens({"level"}, "has no meaning here", "it belongs to specular outputs");
    return std::move(out_);
  }

 private:
  [[nodiscard]] const FormatRules& rules() const {
    return *std::find_if(format_rules().begin(), format_rules().end(),
                         [&](const FormatRules& r) { return r.format == out_.format; });
  }

  void read_type() {
    const auto& types = rules().types;
    out_.sample_type = types.front();
    const auto word = section_.get<std::string>("type");
    if (!word) return;
    const SampleType type = *value_of(kSampleTypeWords, *word);
    if (std::find(types.begin(), types.end(), type) != types.end()) {
      out_.sample_type = type;
      return;
    }
    std::string allowed;
    for (const SampleType t : types)
      allowed += (allowed.empty() ? "" : ", ") + std::string(word_of(kSampleTypeWords, t));
    item_.context.errors.add(
        section_.place_of("type"),
        fmt::format("{} = {} cannot be stored in {}", section_.path_of("type"), *word, out_.format),
        fmt::format("allowed: {}", allowed));
  }

  /// Integers hold display values only; numbers with a range stay scene-linear unless a view is
  /// asked for. An empty view stands for the default one.
  void read_view() {
    const bool integers = out_.sample_type == SampleType::u8 || out_.sample_type == SampleType::u16;
    out_.display = section_.get<std::string>("display");
    if (section_.has("view") || section_.has("display") || integers)
      out_.view = section_.get<std::string>("view").value_or("");
    if (out_.format == "ktx2")
      for (const std::string_view key : {"view", "display"})
        if (section_.has(key)) item_.no_meaning(key, "ktx2 holds scene-linear cubes");
  }

  void read_content() {
    const auto word = section_.get<std::string>("content");
    if (!word) return;
    out_.content = *value_of(kImageContentWords, *word);
    if (out_.content != ImageContent::standard_error) return;
    if (item_.job.sky.model != SkyModel::reference)
      item_.no_meaning("content", "only sky.model reference knows its standard errors");
    else if (out_.view || out_.format == "ktx2")
      item_.no_meaning("content",
                       "standard errors are numbers, not a picture: write exr, hdr or tif "
                       "with \"type: float\", without view and display");
    else if (section_.has("projection") || section_.has("size"))
      item_.no_meaning("content", "standard errors are those of the pixels of the job's camera");
  }

  /// Numbers that hold the disc as it is need no policy; .hdr may have one for readers that turn
  /// it into half numbers.
  void read_sun() {
    const bool half = out_.sample_type == SampleType::half_float;
    const bool has_range = out_.format == "exr" || out_.format == "hdr" || out_.format == "ktx2";
    if (!half) out_.sun_policy = output::SunPolicy::float32;
    const auto word = section_.get<std::string>("sun");
    if (!word) return;
    if (!has_range || out_.view)
      return item_.no_meaning("sun", "it belongs to scene-linear exr, hdr and ktx2");
    if (out_.content != ImageContent::radiance)
      return item_.no_meaning("sun", "it belongs to pictures with the sun's disc");
    out_.sun_policy = *value_of(kSunPolicyWords, *word);
    if (!half && out_.format != "hdr" && out_.sun_policy != output::SunPolicy::float32)
      item_.no_meaning("sun", "float numbers hold the disc; \"content: sky\" leaves it out");
  }

  void read_compression() {
    const auto word = section_.get<std::string>("compression");
    if (!word) return;
    const auto& allowed = rules().compressions;
    if (allowed.empty())
      item_.no_meaning("compression", "it belongs to exr and tif");
    else if (std::find(allowed.begin(), allowed.end(), *word) == allowed.end())
      item_.context.errors.add(section_.place_of("compression"),
                               fmt::format("{} = {} cannot be used in {}",
                                           section_.path_of("compression"), *word, out_.format),
                               fmt::format("allowed: {}", fmt::join(allowed, ", ")));
    else
      out_.compression = *word;
  }

  /// A ktx2 file holds the six faces as they are.
  void check_cube() {
    if (out_.format != "ktx2") return;
    const auto no_cube = [](const CameraConfig& c) {
      return c.camera.projection != image::Projection::cube;
    };
    const auto& cameras = item_.job.cameras;
    const bool wrong = out_.own_view ? no_cube(*out_.own_view)
                                     : std::any_of(cameras.begin(), cameras.end(), no_cube);
    if (wrong && !section_.has("projection"))
      item_.refuse_path("ktx2 holds cubes", "add \"projection: cube\"");
    else if (wrong)
      item_.context.errors.add(section_.place_of("projection"), "ktx2 holds cubes",
                               "allowed: cube");
    if (section_.has("layout")) item_.no_meaning("layout", "a ktx2 file holds six faces");
    item_.refuse_tokens({"face"}, "has no meaning here", "a ktx2 file holds six faces");
    if (out_.own_view) out_.own_view->cube_faces_apart = false;
  }

  /// {face} must have a meaning for all pictures of the output or none.
  void check_faces() {
    if (out_.format == "ktx2") return;
    const auto apart = [](const CameraConfig& c) { return c.cube_faces_apart; };
    const std::vector<CameraConfig> own =
        out_.own_view ? std::vector<CameraConfig>{*out_.own_view} : std::vector<CameraConfig>{};
    const auto& cameras = out_.own_view ? own : item_.job.cameras;
    const bool some = std::any_of(cameras.begin(), cameras.end(), apart);
    const auto whole = std::find_if_not(cameras.begin(), cameras.end(), apart);
    const bool has_face = item_.has_token("face");
    if (some && !has_face)
      item_.refuse_path("six faces would be written to one file",
                        "add the token {face} to the name");
    else if (!some && has_face)
      item_.refuse_path(
          out_.own_view ? "this view has no faces of its own" : "no camera has faces of its own",
          "{face} belongs to \"layout: faces\"");
    else if (some && whole != cameras.end())
      item_.refuse_path(fmt::format("{{face}} has no meaning for the camera {}", whole->name),
                        "give cameras with \"layout: faces\" a job of their own");
  }

  const OutputItem& item_;
  const Section& section_;
  ImageOutput out_;
};

bool is_movie_ending(const std::string& ending) {
  return ending == "mp4" || ending == "mkv" || ending == "mov" || ending == "webm";
}

}  // namespace

std::optional<ImageOutput> build_image(const OutputItem& item) {
  if (item.path.empty() || !item.allowed_place()) return std::nullopt;
  const bool movie = is_movie_ending(extension_of(item.path));
  const auto format =
      item.format_of(kEndings, "image", movie ? "movies are written as \"movie: ...\"" : "");
  if (!format) return std::nullopt;
  return ImageReader(item, *format).read();
}

}  // namespace skylapse::config
