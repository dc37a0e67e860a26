#pragma once
// A job as the user wrote it, checked value by value. What needs the sun (anchored times) is
// resolved later by plan/, with the spans kept here.
#include <chrono>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "astro/ephemeris/ephemeris.h"
#include "astro/events.h"
#include "astro/sky_state.h"
#include "color/exposure.h"
#include "core/result.h"
#include "image/camera/camera.h"
#include "image/orientation.h"
#include "output/image_writer.h"
#include "sky/atmosphere/atmosphere.h"
#include "sky/bruneton/settings.h"
#include "sky/effects.h"
#include "sky/hosek_wilkie/options.h"

namespace skylapse::config {

struct Site {
  std::string name;  // letters, digits, "-", "_", "." when used in a path; default "site1"...
  astro::GeodeticPosition position;
  std::optional<Spanned<std::string>> zone;  // this site's own zone; else the job's
  SourceSpan span;
};

/// "2026-06-21 sunrise - 45 min", "04:30", "2026-06-21T04:30+02:00", "solar_noon".
struct TimeExpression {
  std::optional<std::chrono::year_month_day> date;  // else the day being expanded
  // Since local midnight (24:00 allowed); of a leap second, hh:mm:60: the next minute.
  std::optional<std::chrono::microseconds> clock;
  std::optional<std::chrono::seconds> utc_offset;  // written with the time, wins over zones
  bool leap_second = false;                        // the clock read 23:59:60
  std::optional<astro::EventKind> anchor;          // exactly one of clock and anchor
  Duration offset{};                               // added last
  SourceSpan span;
};

struct DateRange {
  std::chrono::year_month_day first, last;  // inclusive
  int step_days = 1;
  SourceSpan span;
};

struct FixedStep {
  Duration step;
};
struct FrameCount {
  long count = 0;
};  // evenly from `from` to `to`, both included
struct ElevationStep {
  Angle step;
};  // each crossing of a multiple of `step`
struct ExplicitTimes {
  std::vector<TimeExpression> times;
};
struct SunElevations {
  enum class Half { morning, afternoon, both };
  std::vector<Angle> elevations;  // true elevations of the sun, in the order written
  Half half = Half::both;         // rising before the day's culmination, or sinking after it
};  // each moment of a day when the sun stands there; days without it are noted and passed over
using Sampling = std::variant<FixedStep, FrameCount, ElevationStep, ExplicitTimes, SunElevations>;

struct TimePlan {
  std::optional<Spanned<std::string>> zone;
  std::vector<DateRange> dates;            // empty only if every expression carries its own date
  std::optional<TimeExpression> from, to;  // both there unless the times are explicit
  Sampling sampling;
  Duration dut1{};
  SourceSpan span;
};

/// Ground reflectance: grey, or a named spectrum of data/spectral/ground_albedo.
struct Albedo {
  std::string name;  // "0.2", "grass"
  double value = 0;  // grey value; for a named spectrum its mean over 400..700 nm
  bool spectral = false;
};

/// Reflectance of a ground over the wavelength.
sky::atmosphere::Spectrum ground_spectrum(const Albedo& albedo);

/// What of the air may change during a job.
struct AirState {
  double aerosol_optical_depth = 0;  // vertical, 550 nm
  double ozone_du = 300;
};

/// The air at a time; between two keyframes it goes linearly from one to the other, before the
/// first and after the last it stays. Values that a keyframe leaves out are the job's.
struct AirKeyframe {
  TimeExpression time;
  AirState state;
};

/// One dimension of the job per list: the frames of all combinations are rendered.
struct Air {
  std::vector<Spanned<double>> turbidity{
      {2.5, {}}};  // from turbidity, visibility or aerosol depth; Hosek-Wilkie takes 1..10
  std::vector<Spanned<Albedo>> ground_albedo{{{"0.2", 0.2, false}, {}}};
  astro::RefractionConditions refraction;
  bool observer_pressure_given = false;  // the refraction's pressure was written, not the default
  /// Everything else about the air; its aerosol depth is that of `turbidity`, its ground that of
  /// `ground_albedo`. For the models that compute the atmosphere.
  sky::atmosphere::AirDescription description;
  std::vector<AirKeyframe> keyframes;  // in the order written; sorted by the plan
  /// The first key with a value that only a model of the atmosphere understands (a preset, ozone
  /// that is not the default, haze beyond turbidity 10, keyframes), as "air.ozone"; empty if
  /// Hosek-Wilkie will do. Never set where the config demands Hosek-Wilkie: that is an error.
  std::optional<Spanned<std::string>> needs_atmosphere;
};

enum class SkyModel {
  automatic,
  cie,
  preetham,
  hosek_wilkie,
  hosek_wilkie_gl,
  single_scattering,
  bruneton,
  reference,
};

/// Whether the model is a fitted sky of an observer on the ground with the sun up; the others
/// compute the light in an atmosphere, wherever camera and sun are.
constexpr bool is_fitted(SkyModel model) {
  return model == SkyModel::cie || model == SkyModel::preetham || model == SkyModel::hosek_wilkie ||
         model == SkyModel::hosek_wilkie_gl;
}

/// What of the scene is computed.
struct EffectChoice {
  enum class Rule {
    automatic,  // what the scene calls for
    all,        // everything, whether it shows or not
    listed,     // these and no others
  };
  Rule rule = Rule::automatic;
  std::vector<sky::Effect> listed;
};

/// Arithmetic of an atmosphere: OpenGL in float, the same with tables rounded to half floats, or
/// the CPU in double.
enum class SkyPrecision { half, single, full };

/// Paths of the reference, per pixel.
struct PathSettings {
  long samples = 1024;  // with relative_error: at most
  std::optional<double> relative_error;
  uint64_t seed = 1;
};

struct Sky {
  SkyModel model = SkyModel::automatic;
  /// At most one of the two, and only where the planner is free to choose (model auto, level and
  /// wavelengths not given): greatest rms relative error of the picture's sky; time for a frame.
  std::optional<Spanned<double>> accuracy;
  std::optional<Spanned<Duration>> time_budget;
  EffectChoice effects;
  sky::bruneton::Level level = sky::bruneton::Level::standard;
  int wavelengths = 16;            // bands of the atmosphere models, 3..32
  bool wavelengths_given = false;  // written, not the default
  int orders = 0;                  // of scattering, no tail; 0: until they converge
  int steps = 0;                   // Gauss nodes of each piece of a view ray; 0: the model's own
  /// Azimuths and zeniths of the table of directions that a frame is made from; 0: by the height.
  int slice_azimuths = 0, slice_zeniths = 0;
  SkyPrecision precision = SkyPrecision::single;
  PathSettings paths;
  int cie_type = 12;  // of the CIE general sky, 1..15
  sky::hosek_wilkie::Fit fit = sky::hosek_wilkie::Fit::spectral;
  sky::hosek_wilkie::SolarFlux solar_flux = sky::hosek_wilkie::SolarFlux::reference;
  bool sun_disc = true;
  astro::SunAlgorithm sun_algorithm = astro::SunAlgorithm::erfa;
  /// As Air::needs_atmosphere: the first such key of the section.
  std::optional<Spanned<std::string>> needs_atmosphere;
};

struct CameraConfig {
  std::string name = "camera";
  image::Camera camera;
  bool cube_faces_apart = false;  // layout: faces, six files by the token {face}
  SourceSpan span;
};

struct ColorConfig {
  std::string space = "rec709";              // scene-linear space of the pixels
  std::optional<Spanned<std::string>> ocio;  // config file; else $OCIO, else built in
};

/// What the values of an image are.
enum class ImageContent {
  radiance,
  sky,             // radiance without the sun's disc, whatever the effects say
  standard_error,  // of the radiance without the sun's disc, of the model `reference`
};

struct ImageOutput {
  Spanned<std::string> path;  // template, relative to the output folder
  std::string format;         // "exr", "hdr", "png", "jpg", "tif", by the extension
  ImageContent content = ImageContent::radiance;
  /// The output's own view of the frame's sky, instead of that of the frame's camera. Its heading
  /// is that of `orientation`, else of the frame's camera where that one is a map or cube.
  std::optional<CameraConfig> own_view;
  std::optional<image::Orientation> orientation;
  output::SampleType sample_type = output::SampleType::float32;
  output::SunPolicy sun_policy = output::SunPolicy::clip;  // of formats that cannot hold the disc
  // Display-referred if and only if there is a view; an empty one is the display's default.
  std::optional<std::string> display, view;
  int quality = 92;                 // jpeg
  std::string compression = "zip";  // exr: none, zip, zips, piz, dwaa
  // The values of `view` (else `display`) and `sun`; where they are not written, the path.
  SourceSpan view_span{}, sun_policy_span{};
};

/// What a renderer wants of a sky beside its picture.
enum class ProductKind {
  specular,    // cube with mips, filtered by GGX of growing roughness
  irradiance,  // map of the irradiance of a surface by its normal
  harmonics,   // spherical harmonics L0 to L2: JSON
  sun,         // the sun as a light of its own: JSON or USD
  dome,        // USD dome light that names the map of another output
};

/// One file (or six faces) per frame, made from the frame's sky.
struct ProductOutput {
  ProductKind kind = ProductKind::harmonics;
  Spanned<std::string> path;
  std::string format;  // "ktx2", "exr", "hdr", "json", "usda"
  output::SampleType sample_type = output::SampleType::half_float;
  /// Of `specular` and `irradiance`: a cube or lat-long camera; its size is that of the first
  /// level.
  std::optional<CameraConfig> view;
  int levels = 0;  // of `specular`: roughness 0 to 1; 0: down to 4 pixels a face
  image::Orientation orientation = image::Orientation::openexr;
  bool sun_disc = true;           // of `specular`, `irradiance`, `harmonics`: with the disc's light
  Spanned<std::string> map_path;  // of `dome`: the path of the image output that it shows
};

/// What a folder of skies is looked through with.
enum class LibraryKind {
  gallery,  // a page of all frames: HTML
  sheet,    // contact sheet with labels
};

/// One file for the whole job, made when all frames are there.
struct LibraryOutput {
  LibraryKind kind = LibraryKind::gallery;
  Spanned<std::string> path;
  std::string format;               // "html", "png", "jpg"
  Spanned<std::string> image_path;  // the path of the display-referred image output that it shows
  int columns = 0;                  // of `sheet`; 0: by the number of frames
};

struct MovieOutput {
  Spanned<std::string> path;
  double frames_per_second = 30;
  std::optional<std::string> display, view;  // always display-referred: there is a view
  int crf = 18;
  SourceSpan view_span{};  // of `view`, else `display`, else the path
};

using Output = std::variant<ImageOutput, MovieOutput, ProductOutput, LibraryOutput>;

/// Whether an output has files for each frame; the others are made of all frames.
inline bool is_per_frame(const Output& output) {
  return std::holds_alternative<ImageOutput>(output) ||
         std::holds_alternative<ProductOutput>(output);
}

inline const Spanned<std::string>& path_of(const Output& output) {
  return std::visit([](const auto& o) -> const Spanned<std::string>& { return o.path; }, output);
}

/// More frames than this in one job are refused: more than a year at one a minute.
inline constexpr long kMaxJobFrames = 1'000'000;

struct JobConfig {
  std::string file;
  std::string title;
  std::vector<Site> sites;
  TimePlan time;
  Air air;
  Sky sky;
  std::vector<CameraConfig> cameras;
  color::ExposureSettings exposure;
  ColorConfig color;
  std::vector<Output> outputs;
  bool allow_outside_paths = false;  // outputs may leave the output folder
};

/// "key.path=value" of the command line.
struct Override {
  std::string key_path;
  std::string value;
};

/// Reads and checks a file; all errors in one go, in the order of their places.
Result<JobConfig, Diagnostics> load_job(const std::string& path,
                                        const std::vector<Override>& overrides = {});
/// The same for text; `name` is used in messages.
Result<JobConfig, Diagnostics> parse_job(const std::string& text, const std::string& name,
                                         const std::vector<Override>& overrides = {});
/// JSON Schema (draft 2020-12) of the config, made from the same table that the reader uses.
std::string job_json_schema();

}  // namespace skylapse::config
