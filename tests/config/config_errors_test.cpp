// What bad jobs are told: place, message, hint.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/job_text.h"

namespace skylapse::config {
namespace {

using test::error_of;
using test::errors_of;
using test::kSmallJob;
using test::with;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string error_with(const std::string& from, const std::string& to) {
  return error_of(with(kSmallJob, from, to));
}
std::string error_after(const std::string& lines) { return error_of(kSmallJob + lines); }

const std::string kLatitude = "latitude: 50.0755 deg";
const std::string kTime = "{zone: Europe/Prague, date: 2026-06-21, step: 10 min}";
const std::string kCamera = "{look_at: west}";
const std::string kImage = "{image: sky.####.png}";

TEST(ConfigErrors, PlacesAndRanges) {
  EXPECT_EQ(error_with(kLatitude, "latitude: 95 deg"),
            "1 [95 deg] location.latitude = 95 deg is out of range | allowed: -90 deg to 90 deg");
  EXPECT_EQ(error_with("14.4378 deg", "400"),
            "1 [400] location.longitude = 400 is out of range | allowed: -180 deg to 360 deg");
  EXPECT_EQ(
      error_with(kLatitude, "height: 2500000 km, latitude: 5"),
      "1 [2500000 km] location.height = 2500000 km is out of range | allowed: -500 m to 400000 km; "
      "did you mean 2500000 m?");
  EXPECT_EQ(error_with(kLatitude, "height: 235, latitude: 5"),
            "1 [235] location.height: 235 has no unit | write 235 m; allowed units: m, km, ft");
  EXPECT_EQ(error_with(kLatitude + ", ", ""),
            "1 [location] location.latitude is missing | add \"latitude: 50.0755 deg\"");
  EXPECT_EQ(error_with(kLatitude, "latitude:"),
            "1 [latitude] location.latitude has no value | such as 50.0755 deg");
  EXPECT_EQ(error_with(kLatitude, "latitude: [50]"),
            "1 [[] location.latitude is a list, not a single value | such as 50.0755 deg");
  EXPECT_EQ(error_with(kLatitude, "latitude: .nan"),
            "1 [.nan] location.latitude: \".nan\" does not begin with a number | ");
  EXPECT_THAT(error_with("Europe/Prague", "Europe/Pargue"),
              StartsWith("2 [Europe/Pargue] time.zone: unknown time zone \"Europe/Pargue\" | di"));
}

TEST(ConfigErrors, KeysThatDoNotExist) {
  EXPECT_THAT(
      error_with("latitude", "lattitude"),
      StartsWith(
          "1 [lattitude] the key \"lattitude\" is not known in location | did you mean latitude?"));
  EXPECT_EQ(error_after("sky: {modell: auto}\n"),
            "5 [modell] the key \"modell\" is not known in sky | did you mean model?");
  EXPECT_THAT(
      error_after("clouds: many\n"),
      StartsWith("5 [clouds] the key \"clouds\" is not known at the top level | known keys: "));
  EXPECT_EQ(
      error_with(kImage, "{movi: a.mp4}"),
      "4 [{] outputs.0 lacks one of image, movie, specular, irradiance, harmonics, sun, dome, "
      "gallery, sheet | did you mean movie instead of movi?");
}

TEST(ConfigErrors, KeysThatExcludeOrNeedEachOther) {
  EXPECT_EQ(
      error_after("locations: [{latitude: 1, longitude: 2}]\n"),
      "5 [locations] location and locations exclude each other | use one of location, locations");
  EXPECT_EQ(error_with("step: 10 min", "step: 10 min, frames: 7"),
            "2 [frames] time.step and time.frames exclude each other | use one of step, frames, "
            "every, at, sun_elevations");
  EXPECT_EQ(
      error_with(", step: 10 min", ""),
      "2 [time] time lacks one of step, frames, every, at, sun_elevations | add \"step: 2 min\"");
  EXPECT_EQ(
      error_after("air: {turbidity: 3, visibility: 20 km}\n"),
      "5 [visibility] air.turbidity and air.visibility exclude each other | use one of turbidity, "
      "visibility, "
      "aerosol_optical_depth");
  EXPECT_EQ(error_with("camera: " + kCamera, "title: x"),
            "1 [] the job lacks one of camera, cameras | add \"camera: {look_at: west, size: "
            "1280x720}\"");
}

TEST(ConfigErrors, Times) {
  const auto error_at = [](const std::string& time) { return error_with(kTime, time); };
  const std::string zone_hint =
      " | add \"zone: Europe/Prague\" (an IANA name, UTC or +02:00) to time or to the location";
  EXPECT_EQ(error_at("{date: 2026-06-21, from: 04:30, to: 05:00Z, step: 1 min}"),
            "2 [04:30] time.from has neither a time zone nor an offset" + zone_hint);
  EXPECT_EQ(error_at("{date: 2026-06-21, from: 04:30Z, to: sunset, step: 1 min}"),
            "2 [sunset] time.to needs a time zone: events are those of a local day" + zone_hint);
  EXPECT_EQ(error_at("{date: 2026-06-21, step: 1 min}"),
            "2 [time] the day has no time zone" + zone_hint);
  EXPECT_EQ(
      error_at("{zone: UTC, from: sunrise, to: 2026-06-21 sunset, step: 1 min}"),
      "2 [sunrise] time.from has no day | add \"date: 2026-06-21\" beside it, or write the day "
      "before the time");
  EXPECT_EQ(error_at("{zone: UTC, date: 2026-06-21, from: 2026-06-21 sunrise, step: 1 min}"),
            "2 [2026-06-21 sunrise] time.from carries a day of its own, and time.date is given too "
            "| give the day in "
            "one of the "
            "two places");
  EXPECT_EQ(error_at("{zone: UTC, step: 1 min}"),
            "2 [time] the job has no day | add \"date: 2026-06-21\"");
  EXPECT_EQ(
      error_at("{zone: UTC, date: 2026-06-21, from: 18:00, to: 04:00, step: 1 min}"),
      "2 [04:00] the time span ends before it begins | a span over midnight: write `to` as 24:00 "
      "+ 4 h, or "
      "give both a day");
  EXPECT_EQ(error_at("{zone: UTC, date: 2026-06-21, from: 18:00, at: [19:00]}"),
            "2 [from] time.from has no meaning beside time.at | `at` lists the times themselves");
  EXPECT_EQ(error_at("{zone: UTC, date: 2026-06-31, step: 1 min}"),
            "2 [2026-06-31] time.date: 2026-06 has no day 31 | its last day is 30");
  EXPECT_EQ(error_at("{zone: UTC, dates: [2026-06-21, 2026-06-21], step: 1 min}"),
            "2 [2026-06-21] the day 2026-06-21 is given twice | ");
  EXPECT_EQ(error_at("{zone: UTC, dates: {from: 2026-06-21, to: 2026-06-20}, step: 1 min}"),
            "2 [2026-06-20] time.dates ends before it begins | write the earlier day first");
  EXPECT_EQ(
      error_at(
          "{zone: UTC, dates: {from: 2026-06-21, to: 2026-06-23, step: 1.5 days}, step: 1 min}"),
      "2 [1.5 days] time.dates.step = 1.5 days is no whole number of days | ");
  EXPECT_EQ(
      error_at("{zone: UTC, date: 2026-06-21, every: 1}"),
      "2 [1] time.every: 1 has no unit | write 1 deg; allowed units: deg, rad, arcmin, arcsec");
  EXPECT_EQ(error_at("{zone: UTC, date: 2026-06-21, step: 1 min, dut1: 2 s}"),
            "2 [2 s] time.dut1 = 2 s is out of range | allowed: -0.9 s to 0.9 s");
}

TEST(ConfigErrors, Air) {
  EXPECT_EQ(error_after("air: {turbidity: 12}\n"),
            "5 [12] air.turbidity = 12 is out of range | allowed: 1 to 10");
  EXPECT_EQ(error_after("air: {turbidity: [2, 0.5]}\n"),
            "5 [0.5] air.turbidity.1 = 0.5 is out of range | allowed: 1 to 10");
  EXPECT_EQ(error_after("air: {turbidity: 3 km}\n"),
            "5 [3 km] air.turbidity: \"3 km\" is not a plain number | this value has no unit");
  EXPECT_EQ(error_after("air: {turbidity: [3, 3]}\n"),
            "5 [3] air.turbidity lists the same value twice | ");
  EXPECT_EQ(error_after("air: {turbidity: []}\n"),
            "5 [[] air.turbidity is an empty list | such as 3");
  EXPECT_EQ(error_after("air: {pressure: 101325 hPa}\n"),
            "5 [101325 hPa] air.pressure = 101325 hPa is out of range | allowed: 0 hPa to 1100 "
            "hPa; did you "
            "mean 101325 Pa?");
  EXPECT_EQ(error_after("air: {temperature: 288 degC}\n"),
            "5 [288 degC] air.temperature = 288 degC is out of range | allowed: -100 degC to 60 "
            "degC; did "
            "you mean 288 K?");
  EXPECT_EQ(error_after("air: {refraction: maybe}\n"),
            "5 [maybe] air.refraction = maybe is neither on nor off | allowed: on, off");
  const std::string ground = error_after("air: {ground_albedo: gras}\n");
  EXPECT_THAT(
      ground,
      StartsWith("5 [gras] air.ground_albedo = gras is not known | allowed: 0 to 1, or one of "));
  EXPECT_THAT(ground, HasSubstr("did you mean grass?"));
}

TEST(ConfigErrors, Cameras) {
  const auto error_at = [](const std::string& camera) { return error_with(kCamera, camera); };
  EXPECT_EQ(error_at("{fov: 75 deg}"),
            "3 [camera] camera.look_at is missing | add \"look_at: {azimuth: 270 deg, elevation: "
            "15 deg}\"");
  EXPECT_EQ(
      error_at("{look_at: west, fov: 75}"),
      "3 [75] camera.fov: 75 has no unit | write 75 deg; allowed units: deg, rad, arcmin, arcsec");
  EXPECT_EQ(
      error_at("{look_at: west, fov: 180 deg}"),
      "3 [180 deg] camera.fov = 180 deg is too wide for this projection | allowed: less than 180 "
      "deg; fisheyes "
      "see more");
  EXPECT_EQ(error_at("{projection: fisheye-stereographic, fov: 360 deg}"),
            "3 [360 deg] camera.fov = 360 deg is too wide for this projection | allowed: less than "
            "360 deg");
  EXPECT_EQ(
      error_at("{projection: lat-long, fov: 90 deg}"),
      "3 [fov] camera.fov has no meaning here | images of the whole sphere have no field of view");
  EXPECT_EQ(
      error_at("{projection: lat-long, look_at: {azimuth: 0 deg, elevation: 5 deg}}"),
      "3 [5 deg] images of the whole sphere stand upright | their look_at takes the azimuth of "
      "the image centre "
      "alone");
  EXPECT_EQ(error_at("{look_at: {elevation: 5 deg}}"),
            "3 [look_at] camera.look_at.azimuth is missing | add \"azimuth: 270 deg\"");
  EXPECT_THAT(error_at("{look_at: up}"),
              StartsWith("3 [up] camera.look_at = up is not a direction | a"));
  EXPECT_THAT(error_at("{look_at: wets}"),
              StartsWith("3 [wets] camera.look_at = wets is not a direction"));
  EXPECT_EQ(error_at("{look_at: west, size: 640}"),
            "3 [640] camera.size: the height is missing | such as 640x640");
  EXPECT_EQ(error_at("{look_at: west, layout: cross}"),
            "3 [layout] camera.layout has no meaning here | it belongs to \"projection: cube\"");
  EXPECT_EQ(error_at("{projection: cube, size: 64x32}"),
            "3 [64x32] camera.size: the faces of a cube are squares | give the side of a face, "
            "such as 64");
  EXPECT_EQ(
      error_at("{projection: cube, size: 11000}"),
      "3 [11000] camera.size: a cube of 11000 pixel faces is 11000x66000 in all | allowed: faces "
      "of at most 10922 "
      "pixels in this layout");
  EXPECT_EQ(error_at("{look_at: west, name: ..}"),
            "3 [..] camera.name = .. holds no letter or digit | names become part of file names");
  EXPECT_EQ(error_of(with(kSmallJob, "camera: " + kCamera,
                          "cameras: [{name: a, look_at: west}, {name: a, look_at: east}]")),
            "3 [a] two cameras are named a | the first is on line 3; names must differ");
}

TEST(ConfigErrors, Exposure) {
  EXPECT_EQ(error_after("exposure: {mode: metered, ev: 15}\n"),
            "5 [ev] exposure.ev has no effect here | it belongs to mode fixed");
  EXPECT_EQ(error_after("exposure: {rate_limit: 1}\n"),
            "5 [rate_limit] exposure.rate_limit has no effect here | it belongs to mode metered");
  EXPECT_EQ(error_after("exposure: {mode: auto}\n"),
            "5 [auto] exposure.mode = auto is not known | allowed: sun-curve, fixed, metered");
}

TEST(ConfigErrors, OneFileSpelledTwiceIsFound) {
  for (const char* again : {"./a/sky.####.png", "a//sky.####.png", "a/b/../sky.####.png"})
    EXPECT_THAT(error_with(kImage, fmt::format("{{image: a/sky.####.png}}, {{image: {}}}", again)),
                HasSubstr("two outputs have this name | the first is on line 4"));
}

TEST(ConfigErrors, TheRecordsOfTheProgramAreNoOutputs) {
  for (const char* name : {"manifest.json", "./manifest.json/####.png", ".skylapse/####.png",
                           "a/../.skylapse/####.png"})
    EXPECT_EQ(error_with(kImage, fmt::format("{{image: {}}}", name)),
              fmt::format("4 [{}] outputs.0.image: this name belongs to the program's own records "
                          "| manifest.json and .skylapse are kept at the top of the output folder",
                          name));
  EXPECT_EQ(error_with(kImage, "{image: a/.skylapse/####.png}"), "no error");
}

TEST(ConfigErrors, AFaceMeansNothingToACameraWithoutFaces) {
  const std::string cameras =
      "cameras: [{name: cube, projection: cube, layout: faces}, {name: west, look_at: west}]";
  const std::string text = with(kSmallJob, "camera: {look_at: west}", cameras);
  EXPECT_EQ(error_of(with(text, "sky.####.png", "\"{camera}-{face}.####.png\"")),
            "4 [{camera}-{face}.####.png] outputs.0.image: {face} has no meaning for the camera "
            "west | give cameras with \"layout: faces\" a job of their own");
  EXPECT_THAT(error_of(text), HasSubstr("six faces would be written to one file"));
}

TEST(ConfigErrors, Outputs) {
  const auto error_at = [](const std::string& output) { return error_with(kImage, output); };
  EXPECT_EQ(error_at("{image: sky.####.bmp}"),
            "4 [sky.####.bmp] outputs.0.image: no image format ends in .bmp | allowed: .exr, .hdr, "
            ".png, .jpg, "
            ".jpeg, .tif, .tiff, .ktx2");
  EXPECT_EQ(error_at("{image: sky.mp4}"),
            "4 [sky.mp4] outputs.0.image: no image format ends in .mp4 | movies are written as "
            "\"movie: ...\"");
  EXPECT_EQ(error_at("{image: \"{sit}.####.png\"}"),
            "4 [{sit}] outputs.0.image: the token {sit} is not known | did you mean {site}?");
  EXPECT_EQ(error_at("{image: \"a/{sit}.####.png\"}"),
            "4 [{sit}] outputs.0.image: the token {sit} is not known | did you mean {site}?");
  for (const char* path : {"../sky.####.png", "/tmp/sky.####.png", "a/../../sky.####.png"})
    EXPECT_EQ(error_at("{image: " + std::string(path) + "}"),
              "4 [" + std::string(path) +
                  "] outputs.0.image: this leaves the output folder | use a name inside it, or add "
                  "\"allow_outside_paths: on\" at the top level");
  EXPECT_TRUE(
      errors_of(with(kSmallJob, "sky.####", "../sky.####") + "allow_outside_paths: on\n").empty());
  EXPECT_EQ(
      error_at("{image: sky.png}"),
      "4 [sky.png] outputs.0.image: all frames of a day would be written to one file | add #### "
      "(the frame "
      "number) or {time} to the name");
  EXPECT_EQ(error_at("{image: sky.####.png, type: half}"),
            "4 [half] outputs.0.type = half cannot be stored in png | allowed: u8, u16");
  EXPECT_EQ(
      error_at("{image: sky.####.png, sun: clip}"),
      "4 [sun] outputs.0.sun has no meaning here | it belongs to scene-linear exr, hdr and ktx2");
  EXPECT_EQ(
      error_at("{image: sky.####.png, compression: zip}"),
      "4 [compression] outputs.0.compression has no meaning here | it belongs to exr and tif");
  EXPECT_EQ(error_at("{image: sky.####.tif, compression: piz}"),
            "4 [piz] outputs.0.compression = piz cannot be used in tif | allowed: zip, none");
  EXPECT_THAT(error_at("{image: sky.####.png, fps: 30}"),
              StartsWith("4 [fps] the key \"fps\" is not known in outputs.0 | known k"));
  EXPECT_EQ(error_at("{image: \"sky.{face}.####.png\"}"),
            "4 [sky.{face}.####.png] outputs.0.image: no camera has faces of its own | {face} "
            "belongs to \"layout: faces\"");
  EXPECT_EQ(error_at("{image: sky.####.png}, {image: sky.####.png}"),
            "4 [sky.####.png] two outputs have this name | the first is on line 4");
  EXPECT_EQ(error_at("{movie: day.avi}"),
            "4 [day.avi] outputs.0.movie: no movie format ends in .avi | allowed: .mp4, .mkv, "
            ".mov, .webm");
  EXPECT_EQ(
      error_at("{movie: day.####.mp4}"),
      "4 [day.####.mp4] outputs.0.movie: a movie has no frame number in its name | allowed: {site} "
      "{date} {camera} "
      "{turbidity} {albedo}");
  EXPECT_EQ(error_at("{movie: day.mp4, crf: 99}"),
            "4 [99] outputs.0.crf = 99 is out of range | allowed: 0 to 51");
  EXPECT_EQ(error_of(with(kSmallJob, "outputs: [{image: sky.####.png}]", "outputs:")),
            "4 [outputs] outputs has no value | such as [{image: sky.####.png}]");
  EXPECT_EQ(error_of(with(kSmallJob, "[{image: sky.####.png}]", "{image: sky.####.png}")),
            "4 [{] outputs is a section, not a list | such as [{image: sky.####.png}]");
  EXPECT_EQ(error_of(with(with(kSmallJob, kImage, "{movie: day.mp4}"), "camera: " + kCamera,
                          "cameras: [{look_at: west}, {look_at: east}]")),
            "4 [day.mp4] outputs.0.movie: 2 cameras would be written to one movie | add the token "
            "{camera} to the name");
}

TEST(ConfigErrors, TheRootMustBeASection) {
  EXPECT_EQ(
      error_of("- a\n- b\n"),
      "1 [-] the config is a list, not a section with keys | a config begins with keys such as "
      "\"location:\" "
      "and \"time:\"");
  EXPECT_EQ(errors_of("").size(), 4u);
  EXPECT_EQ(errors_of("just text\n").size(), 1u);
}

TEST(ConfigErrors, AllErrorsOfAFileComeInOneRunInTheirOrder) {
  const std::string text =
      "location:\n"
      "  name: Prague\n"
      "  latitude: 150.0755\n"
      "  longitude: 14.4378 N\n"
      "  heigth: 3 m\n"
      "time:\n"
      "  zone: Europe/Pargue\n"
      "  from: sunrize - 45 min\n"
      "  to: 25:00\n"
      "  step: 2\n"
      "air: {visibility: 40 m, ground_albedo: gras, temperature: 15 hPa}\n"
      "camera:\n"
      "  projection: fisheye\n"
      "  fov: 75\n"
      "  size: 1000000x1000000\n"
      "  fov: 80 deg\n"
      "exposure: {mode: sun-curv}\n"
      "outputs:\n"
      "  - image: \"../{sit}.####.png\"\n"
      "  - image: ../x.####.png\n";
  std::vector<std::string> places;
  const auto job = parse_job(text, "job.yaml");
  ASSERT_FALSE(job.ok());
  for (const Error& e : job.error())
    places.push_back(fmt::format("{}:{}", e.span.line, e.span.column));
  const std::vector<std::string> expected{"3:13", "4:14",  "5:3",   "7:9",   "8:9",  "9:7",
                                          "10:9", "11:19", "11:40", "11:59", "14:8", "15:9",
                                          "16:3", "17:18", "19:16", "20:12"};
  EXPECT_EQ(places, expected);
}

TEST(ConfigErrors, MessagesShowTheLineWithACaretUnderTheValue) {
  const auto job =
      parse_job(with(kSmallJob, kLatitude, "latitude: 50°04'32\"S, height: 5"), "job.yaml");
  ASSERT_FALSE(job.ok());
  EXPECT_EQ(
      format_error(job.error()[0]),
      "job.yaml:1:42: error: location.height: 5 has no unit\n"
      "    1 | location: {latitude: 50°04'32\"S, height: 5, longitude: 14.4378 deg}\n"
      "      |                                          ^  write 5 m; allowed units: m, km, ft");
}

}  // namespace
}  // namespace skylapse::config
