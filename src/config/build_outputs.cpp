#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "config/build_job.h"
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
  };
  return rules;
}

constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kImageEndings{
    {{"exr", "exr"},
     {"hdr", "hdr"},
     {"png", "png"},
     {"jpg", "jpg"},
     {"jpeg", "jpg"},
     {"tif", "tif"},
     {"tiff", "tif"}}};
constexpr std::array<std::string_view, 4> kMovieEndings{"mp4", "mkv", "mov", "webm"};

std::string_view type_word(SampleType type) {
  for (const auto& [word, value] : kSampleTypeWords)
    if (value == type) return word;
  return {};
}

/// Reads one output; keeps what the readers of single keys share.
class OutputReader {
 public:
  OutputReader(const Section& section, std::string_view path_key, const JobConfig& job,
               const ReadContext& context)
      : section_(section), path_key_(path_key), job_(job), context_(context) {
    path_ = normalised_path(section.get<std::string>(path_key).value_or(""));
    tokens_ = tokens_in(path_);
  }

  std::optional<ImageOutput> image() {
    if (path_.empty() || !allowed_place()) return std::nullopt;
    const std::string ending = extension_of(path_);
    const auto known = std::find_if(kImageEndings.begin(), kImageEndings.end(),
                                    [&](const auto& e) { return e.first == ending; });
    if (known == kImageEndings.end()) {
      const bool movie =
          std::find(kMovieEndings.begin(), kMovieEndings.end(), ending) != kMovieEndings.end();
      refuse_path(ending.empty() ? "the name has no ending"
                                 : fmt::format("no image format ends in .{}", ending),
                  movie ? "movies are written as \"movie: ...\""
                        : "allowed: .exr, .hdr, .png, .jpg, .jpeg, .tif, .tiff");
      return std::nullopt;
    }
    ImageOutput out;
    out.path = {path_, context_.sources.span(section_.place_of(path_key_))};
    out.format = known->second;
    read_type(out);
    out.view_span = view_span();
    out.sun_policy_span = span_of_first({"sun"});
    read_view(out);
    read_content(out);
    read_sun(out);
    read_compression(out);
    if (const auto quality = section_.get<long>("quality")) out.quality = int(*quality);
    if (section_.has("quality") && out.format != "jpg") no_meaning("quality", "it belongs to jpg");
    check_image_names();
    return out;
  }

  std::optional<MovieOutput> movie() {
    if (path_.empty() || !allowed_place()) return std::nullopt;
    const std::string ending = extension_of(path_);
    if (std::find(kMovieEndings.begin(), kMovieEndings.end(), ending) == kMovieEndings.end()) {
      refuse_path(ending.empty() ? "the name has no ending"
                                 : fmt::format("no movie format ends in .{}", ending),
                  "allowed: .mp4, .mkv, .mov, .webm");
      return std::nullopt;
    }
    MovieOutput out;
    out.path = {path_, context_.sources.span(section_.place_of(path_key_))};
    out.frames_per_second = section_.get<double>("fps").value_or(out.frames_per_second);
    if (const auto crf = section_.get<long>("crf")) out.crf = int(*crf);
    out.display = section_.get<std::string>("display");
    out.view = section_.get<std::string>("view").value_or("");
    out.view_span = view_span();
    check_movie_names();
    return out;
  }

 private:
  [[nodiscard]] bool has_token(std::string_view name) const {
    return std::find(tokens_.begin(), tokens_.end(), name) != tokens_.end();
  }
  /// The value of the first of these keys that is written, else the path.
  [[nodiscard]] SourceSpan span_of_first(std::initializer_list<std::string_view> keys) const {
    for (const std::string_view key : keys)
      if (section_.has(key)) return context_.sources.span(section_.place_of(key));
    return context_.sources.span(section_.place_of(path_key_));
  }
  [[nodiscard]] SourceSpan view_span() const { return span_of_first({"view", "display"}); }
  void refuse_path(std::string message, std::string hint) {
    context_.errors.add(section_.place_of(path_key_),
                        fmt::format("{}: {}", section_.path_of(path_key_), message),
                        std::move(hint));
  }
  void no_meaning(std::string_view key, std::string hint) {
    context_.errors.add(section_.field(key)->key_place,
                        fmt::format("{} has no meaning here", section_.path_of(key)),
                        std::move(hint));
  }

  bool allowed_place() {
    if (is_reserved_path(path_)) {
      refuse_path("this name belongs to the program's own records",
                  "manifest.json and .skylapse are kept at the top of the output folder");
      return false;
    }
    if (job_.allow_outside_paths || !leaves_folder(path_)) return true;
    refuse_path("this leaves the output folder",
                "use a name inside it, or add \"allow_outside_paths: on\" at the top level");
    return false;
  }

  [[nodiscard]] const FormatRules& rules(const ImageOutput& out) const {
    return *std::find_if(format_rules().begin(), format_rules().end(),
                         [&](const FormatRules& r) { return r.format == out.format; });
  }

  void read_type(ImageOutput& out) {
    const auto& types = rules(out).types;
    out.sample_type = types.front();
    const auto word = section_.get<std::string>("type");
    if (!word) return;
    const SampleType type = *value_of(kSampleTypeWords, *word);
    if (std::find(types.begin(), types.end(), type) != types.end()) {
      out.sample_type = type;
      return;
    }
    std::string allowed;
    for (const SampleType t : types)
      allowed += (allowed.empty() ? "" : ", ") + std::string(type_word(t));
    context_.errors.add(
        section_.place_of("type"),
        fmt::format("{} = {} cannot be stored in {}", section_.path_of("type"), *word, out.format),
        fmt::format("allowed: {}", allowed));
  }

  /// Integers hold display values only; numbers with a range stay scene-linear unless a view is
  /// asked for. An empty view stands for the default one.
  void read_view(ImageOutput& out) {
    const bool integers = out.sample_type == SampleType::u8 || out.sample_type == SampleType::u16;
    out.display = section_.get<std::string>("display");
    if (section_.has("view") || section_.has("display") || integers)
      out.view = section_.get<std::string>("view").value_or("");
  }

  void read_content(ImageOutput& out) {
    const auto word = section_.get<std::string>("content");
    if (!word) return;
    out.content = *value_of(kImageContentWords, *word);
    if (out.content == ImageContent::radiance) return;
    if (job_.sky.model != SkyModel::reference)
      no_meaning("content", "only sky.model reference knows its standard errors");
    else if (out.view)
      no_meaning("content",
                 "standard errors are numbers, not a picture: write exr, hdr or tif "
                 "with \"type: float\", without view and display");
  }

  void read_sun(ImageOutput& out) {
    const auto word = section_.get<std::string>("sun");
    if (!word) return;
    if (out.sample_type != SampleType::half_float || out.view ||
        out.content != ImageContent::radiance)
      no_meaning("sun", "it belongs to scene-linear exr with \"type: half\"");
    else
      out.sun_policy = *value_of(kSunPolicyWords, *word);
  }

  void read_compression(ImageOutput& out) {
    const auto word = section_.get<std::string>("compression");
    if (!word) return;
    const auto& allowed = rules(out).compressions;
    if (allowed.empty())
      no_meaning("compression", "it belongs to exr and tif");
    else if (std::find(allowed.begin(), allowed.end(), *word) == allowed.end())
      context_.errors.add(section_.place_of("compression"),
                          fmt::format("{} = {} cannot be used in {}",
                                      section_.path_of("compression"), *word, out.format),
                          fmt::format("allowed: {}", fmt::join(allowed, ", ")));
    else
      out.compression = *word;
  }

  [[nodiscard]] bool day_has_several_times() const {
    if (const auto* list = std::get_if<ExplicitTimes>(&job_.time.sampling))
      return list->times.size() > 1;
    if (const auto* count = std::get_if<FrameCount>(&job_.time.sampling)) return count->count > 1;
    return true;
  }

  [[nodiscard]] bool job_has_several_days() const {
    const auto& dates = job_.time.dates;
    return dates.size() > 1 || (dates.size() == 1 && dates[0].first != dates[0].last);
  }

  /// Every camera writes to every output, so {face} must have a meaning for all of them or none.
  void check_faces() {
    const auto apart = [](const CameraConfig& c) { return c.cube_faces_apart; };
    const auto& cameras = job_.cameras;
    const bool some = std::any_of(cameras.begin(), cameras.end(), apart);
    const auto whole = std::find_if_not(cameras.begin(), cameras.end(), apart);
    if (some && !has_token("face"))
      refuse_path("six faces would be written to one file", "add the token {face} to the name");
    else if (!some && has_token("face"))
      refuse_path("no camera has faces of its own", "{face} belongs to \"layout: faces\"");
    else if (some && whole != cameras.end())
      refuse_path(fmt::format("{{face}} has no meaning for the camera {}", whole->name),
                  "give cameras with \"layout: faces\" a job of their own");
  }

  void check_image_names() {
    check_faces();
    if (has_token("#")) return;
    if (day_has_several_times() && !has_token("time"))
      refuse_path("all frames of a day would be written to one file",
                  "add #### (the frame number) or {time} to the name");
    else if (job_has_several_days() && !has_token("date"))
      refuse_path("the frames of all days would be written to one file",
                  "add #### (the frame number) or {date} to the name");
  }

  void check_movie_names() {
    for (const std::string_view token : {"#", "time", "sun_elevation", "face"})
      if (has_token(token))
        refuse_path(token == "#" ? "a movie has no frame number in its name"
                                 : fmt::format("{{{}}} differs within a movie", token),
                    "allowed: {site} {date} {camera} {turbidity} {albedo}");
    const auto need = [&](size_t count, std::string_view token, std::string_view what) {
      if (count > 1 && !has_token(token))
        refuse_path(fmt::format("{} {} would be written to one movie", count, what),
                    fmt::format("add the token {{{}}} to the name", token));
    };
    need(job_.sites.size(), "site", "locations");
    need(job_.cameras.size(), "camera", "cameras");
    need(job_.air.turbidity.size(), "turbidity", "turbidities");
    need(job_.air.ground_albedo.size(), "albedo", "ground albedos");
  }

  const Section& section_;
  std::string_view path_key_;
  const JobConfig& job_;
  const ReadContext& context_;
  std::string path_;
  std::vector<std::string> tokens_;
};

}  // namespace

std::vector<Output> build_outputs(const Section& root, const JobConfig& job,
                                  const ReadContext& context) {
  std::vector<Output> outputs;
  std::map<std::string, int> lines;
  for (const auto& section : root.sections("outputs")) {
    const bool is_image = section->spec->keys[0].name == "image";
    const std::string_view path_key = is_image ? "image" : "movie";
    OutputReader reader(*section, path_key, job, context);
    if (is_image) {
      if (auto image = reader.image()) outputs.emplace_back(std::move(*image));
    } else {
      if (auto movie = reader.movie()) outputs.emplace_back(std::move(*movie));
    }
    if (const auto path = section->get<std::string>(path_key)) {
      const int line = context.sources.span(section->place_of(path_key)).line;
      const auto [first, is_new] = lines.emplace(normalised_path(*path), line);
      if (!is_new)
        context.errors.add(section->place_of(path_key), "two outputs have this name",
                           fmt::format("the first is on line {}", first->second));
    }
  }
  return outputs;
}

}  // namespace skylapse::config
