// What bad libraries are told: views of an output's own, products, galleries, the sun's elevations.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/job_text.h"

namespace skylapse::config {
namespace {

using test::error_of;
using test::kSmallJob;
using test::with;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kTime = "{zone: Europe/Prague, date: 2026-06-21, step: 10 min}";
const std::string kImage = "{image: sky.####.png}";
const std::string kPlace = "4 [";

std::string error_at(const std::string& output) {
  return error_of(with(kSmallJob, kImage, output));
}
std::string time_error(const std::string& time) { return error_of(with(kSmallJob, kTime, time)); }
std::string elevations_error(const std::string& elevations, const std::string& output) {
  const std::string time = "{zone: UTC, date: 2026-06-21, sun_elevations: " + elevations + "}";
  return error_of(with(with(kSmallJob, kTime, time), kImage, "{image: \"" + output + "\"}"));
}

TEST(LibraryErrors, ElevationsOfTheSun) {
  EXPECT_EQ(time_error("{zone: UTC, date: 2026-06-21, sun_elevations: [5]}"),
            "2 [5] time.sun_elevations.0: 5 has no unit | write 5 deg; allowed units: deg, rad, "
            "arcmin, arcsec");
  EXPECT_EQ(time_error("{zone: UTC, date: 2026-06-21, sun_elevations: [0 deg, 91 deg]}"),
            "2 [91 deg] time.sun_elevations.1 = 91 deg is out of range | allowed: -90 deg to 90 "
            "deg");
  EXPECT_THAT(time_error("{zone: UTC, date: 2026-06-21, sun_elevations: [5 deg, 300 arcmin]}"),
              StartsWith("2 [300 arcmin] time.sun_elevations lists the same elevation twice"));
  EXPECT_THAT(time_error("{zone: UTC, date: 2026-06-21, sun_elevations: []}"),
              StartsWith("2 [[] time.sun_elevations is an empty list"));
  EXPECT_EQ(time_error("{zone: UTC, date: 2026-06-21, step: 1 h, half: morning}"),
            "2 [half] time.half has no meaning here | it belongs to sun_elevations");
  EXPECT_THAT(
      time_error("{zone: UTC, date: 2026-06-21, sun_elevations: [5 deg], half: mornings}"),
      StartsWith("2 [mornings] time.half = mornings is not known | allowed: morning, afternoon, "
                 "both"));
  EXPECT_THAT(time_error("{zone: UTC, date: 2026-06-21, from: 06:00, sun_elevations: [5 deg]}"),
              StartsWith("2 [from] time.from has no meaning beside time.sun_elevations"));
  EXPECT_THAT(time_error("{zone: UTC, sun_elevations: [5 deg]}"),
              StartsWith("2 [time] the job has no day"));
  EXPECT_THAT(
      time_error("{zone: UTC, date: 2026-06-21, step: 1 h, sun_elevations: [5 deg]}"),
      StartsWith("2 [sun_elevations] time.step and time.sun_elevations exclude each other"));
  EXPECT_THAT(time_error("{date: 2026-06-21, sun_elevations: [5 deg]}"),
              StartsWith("2 [time] the day has no time zone"));
}

TEST(LibraryErrors, NamesTellTheSunsElevationsAndHalvesApart) {
  EXPECT_THAT(elevations_error("[5 deg]", "a.png"),
              HasSubstr("all frames of a day would be written to one file | add {time}, or "
                        "{sun_elevation} and {half}, to the name"));
  EXPECT_THAT(elevations_error("[5 deg, 6 deg], half: morning", "a.png"),
              HasSubstr("| add {time} or {sun_elevation} to the name"));
  EXPECT_EQ(elevations_error("[5 deg], half: morning", "a.png"), "no error");
  EXPECT_EQ(elevations_error("[5 deg, 6 deg]", "{sun_elevation}{half}.png"), "no error");
  EXPECT_EQ(elevations_error("[5 deg, 6 deg]", "{time}.png"), "no error");
  EXPECT_EQ(error_at("{image: \"{time}{half}.png\"}"),
            kPlace +
                "{time}{half}.png] outputs.0.image: {half} has no meaning here | it belongs to "
                "time.sun_elevations");
}

TEST(LibraryErrors, NamesHoldNoSpaces) {
  EXPECT_EQ(error_at("{image: \"my sky.####.png\"}"),
            kPlace +
                " ] outputs.0.image: the name holds a space | use - or _: a space splits "
                "names in scripts");
}

TEST(LibraryErrors, ViewsOfTheirOwn) {
  EXPECT_EQ(error_at("{image: a.####.exr, projection: lat-lon}"),
            kPlace +
                "lat-lon] outputs.0.projection = lat-lon is not known | allowed: "
                "perspective, fisheye, fisheye-equidistant, fisheye-equisolid, "
                "fisheye-stereographic, lat-long, cube, octahedral, mirror-ball; did you mean "
                "lat-long?");
  EXPECT_EQ(error_at("{image: a.####.exr, projection: perspective, size: 64x64}"),
            kPlace +
                "{] outputs.0.look_at is missing | add \"look_at: {azimuth: 270 deg, "
                "elevation: 15 deg}\"");
  EXPECT_EQ(error_at("{image: a.####.exr, projection: cube, fov: 90 deg}"),
            kPlace +
                "fov] outputs.0.fov has no meaning here | images of the whole sphere have no "
                "field of view");
  EXPECT_EQ(error_at("{image: a.####.exr, projection: lat-long, layout: cross}"),
            kPlace +
                "layout] outputs.0.layout has no meaning here | it belongs to \"projection: "
                "cube\"");
  EXPECT_EQ(error_at("{image: a.####.exr, projection: cube, layout: faces}"),
            kPlace +
                "a.####.exr] outputs.0.image: six faces would be written to one file | add "
                "the token {face} to the name");
  EXPECT_EQ(error_at("{image: \"{face}.####.exr\", projection: lat-long}"),
            kPlace +
                "{face}.####.exr] outputs.0.image: this view has no faces of its own | "
                "{face} belongs to \"layout: faces\"");
  EXPECT_EQ(error_at("{image: a.####.exr, orientation: usd}"),
            kPlace +
                "orientation] outputs.0.orientation has no meaning here | it belongs to "
                "images of the whole sphere that stand upright: lat-long, cube, octahedral");
  EXPECT_EQ(error_at("{image: a.####.exr, projection: lat-long, look_at: east, orientation: usd}"),
            kPlace +
                "orientation] outputs.0.orientation has no meaning here | look_at says where "
                "the centre is");
  EXPECT_EQ(error_at("{image: a.####.exr, projection: lat-long, orientation: pbrt}"),
            kPlace +
                "orientation] outputs.0.orientation has no meaning here | pbrt reads square "
                "octahedral maps alone");
  EXPECT_THAT(error_at("{sun: a.####.usda, orientation: unreal}"),
              HasSubstr("unreal is left-handed, and USD stages are not"));
  EXPECT_EQ(error_at("{sun: a.####.json, orientation: unreal}"), "no error");
  EXPECT_EQ(error_at("{image: a.####.exr, projection: octahedral, orientation: usd}"),
            kPlace +
                "orientation] outputs.0.orientation has no meaning here | octahedral maps are "
                "pbrt's");
  EXPECT_EQ(error_at("{specular: a.####.ktx2, orientation: pbrt}"),
            kPlace +
                "orientation] outputs.0.orientation has no meaning here | pbrt reads square "
                "octahedral maps alone");
  EXPECT_EQ(error_at("{image: a.####.exr, projection: octahedral, orientation: pbrt}"), "no error");
  EXPECT_THAT(error_at("{image: a.####.exr, projection: cube, orientation: unrael}"),
              HasSubstr("did you mean unreal?"));
  const std::string two = with(kSmallJob, "camera: {look_at: west}",
                               "cameras: [{name: a, look_at: west}, {name: b, look_at: east}]");
  EXPECT_EQ(error_of(with(two, kImage, "{image: \"{camera}.####.exr\", size: 64x36}")),
            kPlace +
                "size] outputs.0.size does not say of which camera | add projection: the job "
                "has several cameras");
  const std::string maps = with(kSmallJob, "camera: {look_at: west}",
                                "cameras: [{name: a, projection: lat-long, look_at: west}, {name: "
                                "b, projection: cube, look_at: east}]");
  EXPECT_EQ(error_of(with(maps, kImage, "{image: \"{camera}.####.exr\", projection: lat-long}")),
            kPlace +
                "lat-long] the job's maps and cubes are centred on different directions | add "
                "look_at or orientation to this output");
}

TEST(LibraryErrors, CubesWithMips) {
  EXPECT_EQ(error_at("{image: a.####.ktx2}"),
            kPlace + "a.####.ktx2] outputs.0.image: ktx2 holds cubes | add \"projection: cube\"");
  EXPECT_EQ(error_at("{image: a.####.ktx2, projection: lat-long}"),
            kPlace + "lat-long] ktx2 holds cubes | allowed: cube");
  EXPECT_EQ(error_at("{image: a.####.ktx2, projection: cube, layout: cross}"),
            kPlace + "layout] outputs.0.layout has no meaning here | a ktx2 file holds six faces");
  EXPECT_EQ(error_at("{image: \"{face}.####.ktx2\", projection: cube}"),
            kPlace +
                "{face}.####.ktx2] outputs.0.image: {face} has no meaning here | a ktx2 file "
                "holds six faces");
  EXPECT_EQ(error_at("{image: a.####.ktx2, projection: cube, type: u8}"),
            kPlace + "u8] outputs.0.type = u8 cannot be stored in ktx2 | allowed: half, float");
  EXPECT_EQ(error_at("{image: a.####.ktx2, projection: cube, display: sRGB}"),
            kPlace +
                "display] outputs.0.display has no meaning here | ktx2 holds scene-linear "
                "cubes");
  EXPECT_EQ(error_at("{image: a.####.ktx2, projection: cube, size: 64}"), "no error");
}

TEST(LibraryErrors, TheSunInFiles) {
  EXPECT_EQ(error_at("{image: a.####.exr, sun: split}"),
            kPlace +
                "sun] outputs.0.sun has no meaning here | float numbers hold the disc; "
                "\"content: sky\" leaves it out");
  EXPECT_EQ(error_at("{image: a.####.exr, type: half, content: sky, sun: clip}"),
            kPlace +
                "sun] outputs.0.sun has no meaning here | it belongs to pictures with the "
                "sun's disc");
  for (const char* good : {"{image: a.####.exr, sun: float}", "{image: a.####.hdr, sun: scale}",
                           "{image: a.####.exr, type: half, sun: float}",
                           "{image: a.####.exr, type: half, content: sky}"})
    EXPECT_EQ(error_at(good), "no error") << good;
  EXPECT_THAT(error_at("{image: a.####.exr, type: half, sun: split-disc}"),
              HasSubstr("outputs.0.sun = split-disc is not known | allowed: float, clip, scale, "
                        "split, refuse"));
}

TEST(LibraryErrors, SpecularCubes) {
  EXPECT_EQ(error_at("{specular: a.####.exr}"),
            kPlace +
                "a.####.exr] outputs.0.specular: all levels would be written to one file | "
                "add the token {level} to the name, or write ktx2");
  EXPECT_EQ(error_at("{specular: \"a{level}.####.ktx2\"}"),
            kPlace +
                "a{level}.####.ktx2] outputs.0.specular: {level} has no meaning here | a ktx2 "
                "file holds all faces and levels");
  EXPECT_EQ(error_at("{specular: a.####.png}"),
            kPlace +
                "a.####.png] outputs.0.specular: no specular format ends in .png | allowed: "
                ".ktx2, .exr, .hdr");
  EXPECT_EQ(error_at("{specular: a.####.ktx2, size: 100}"),
            kPlace + "100] outputs.0.size = 100 is no power of 2 | such as 64");
  EXPECT_EQ(error_at("{specular: a.####.ktx2, size: 64x32}"),
            kPlace +
                "64x32] outputs.0.size: the faces of a cube are squares | give the side of a "
                "face, such as 64");
  EXPECT_EQ(error_at("{specular: a.####.ktx2, size: 4096}"),
            kPlace +
                "4096] outputs.0.size: 4096 pixels are more than the light has detail | "
                "allowed: at most 2048");
  EXPECT_EQ(error_at("{specular: a.####.ktx2, size: 16, levels: 6}"),
            kPlace +
                "6] outputs.0.levels = 6: faces of 16 pixels have fewer levels | allowed: at "
                "most 5");
  EXPECT_EQ(error_at("{specular: a.####.ktx2, type: u8}"),
            kPlace + "u8] outputs.0.type = u8 is not known | allowed: half, float");
  EXPECT_EQ(error_at("{specular: \"a{level}.####.hdr\", type: half}"),
            kPlace + "half] outputs.0.type = half cannot be stored in hdr | allowed: float");
  EXPECT_THAT(error_at("{speculr: a.####.ktx2}"), HasSubstr("did you mean specular"));
  EXPECT_THAT(error_at("{specular: a.####.ktx2, level: 3}"),
              HasSubstr("the key \"level\" is not known in outputs.0 | did you mean levels?"));
  EXPECT_EQ(error_at("{specular: a.ktx2}"),
            kPlace +
                "a.ktx2] outputs.0.specular: all frames of a day would be written to one file "
                "| add #### (the frame number) or {time} to the name");
}

TEST(LibraryErrors, IrradianceHarmonicsAndSun) {
  EXPECT_EQ(error_at("{irradiance: a.####.ktx2, projection: lat-long}"),
            kPlace +
                "lat-long] outputs.0.projection = lat-long, but ktx2 holds cubes | allowed: "
                "cube");
  EXPECT_EQ(error_at("{irradiance: a.####.exr, projection: fisheye}"),
            kPlace +
                "fisheye] outputs.0.projection = fisheye is not known | allowed: lat-long, "
                "cube");
  EXPECT_EQ(error_at("{irradiance: \"a{level}.####.exr\"}"),
            kPlace +
                "a{level}.####.exr] outputs.0.irradiance: {level} has no meaning here | it "
                "belongs to specular outputs");
  EXPECT_EQ(error_at("{harmonics: a.####.exr}"),
            kPlace +
                "a.####.exr] outputs.0.harmonics: no harmonics format ends in .exr | allowed: "
                ".json");
  EXPECT_EQ(error_at("{harmonics: \"{size}.####.json\"}"),
            kPlace +
                "{size}.####.json] outputs.0.harmonics: {size} has no meaning here | this "
                "file has no pixels");
  EXPECT_EQ(error_at("{sun: a.####.usd}"),
            kPlace +
                "a.####.usd] outputs.0.sun: no sun format ends in .usd | allowed: .json, "
                ".usda");
  EXPECT_THAT(error_at("{harmonics: a.####.json, sun_disc: perhaps}"),
              HasSubstr("outputs.0.sun_disc = perhaps is neither on nor off"));
}

TEST(LibraryErrors, WhatIsShownMustBeAnOutputThatCanBe) {
  EXPECT_EQ(error_at("{dome: a.####.usda}"),
            kPlace + "{] outputs.0.map is missing | add \"map: {site}_{date}_{time}.exr\"");
  EXPECT_EQ(error_at("{image: sky.####.exr, projection: lat-long}, {dome: a.####.usda, map: "
                     "sky.###.exr}"),
            kPlace +
                "sky.###.exr] outputs.1.map: no image output has this name | did you mean "
                "sky.####.exr?");
  EXPECT_EQ(error_at("{image: sky.####.exr}, {dome: a.####.usda, map: sky.####.exr}"),
            kPlace +
                "sky.####.exr] outputs.1.map: sky.####.exr cannot be shown here: it is no "
                "lat-long map | ");
  EXPECT_EQ(error_at("{image: sky.####.png, projection: lat-long}, {dome: a.####.usda, map: "
                     "sky.####.png}"),
            kPlace +
                "sky.####.png] outputs.1.map: sky.####.png cannot be shown here: it is no "
                "scene-linear exr or hdr | ");
  EXPECT_EQ(error_at("{image: sky.####.exr}, {gallery: index.html, image: sky.####.exr}"),
            kPlace +
                "sky.####.exr] outputs.1.image: sky.####.exr cannot be shown here: it is no "
                "display-referred png or jpg | ");
  EXPECT_EQ(error_at("{sheet: s.png, image: sky.####.png}"),
            kPlace +
                "sky.####.png] outputs.0.image: no image output has this name | add an image "
                "output with this name");
  EXPECT_EQ(error_at("{gallery: index.html}"), kPlace +
                                                   "{] outputs.0.image is missing | add \"image: "
                                                   "preview/{site}_{date}_{time}.jpg\"");
  // An image output that is wrong itself is not reported twice.
  EXPECT_EQ(error_at("{image: sky.####.bmp}, {sheet: s.png, image: sky.####.bmp}"),
            error_at("{image: sky.####.bmp}"));
}

TEST(LibraryErrors, OneFileForTheWholeJob) {
  EXPECT_EQ(error_at(kImage + ", {gallery: \"{site}.html\", image: sky.####.png}"),
            kPlace +
                "{site}.html] outputs.1.gallery: one file for the whole job has no tokens in "
                "its name | such as index.html");
  EXPECT_EQ(error_at(kImage + ", {sheet: s.exr, image: sky.####.png}"),
            kPlace +
                "s.exr] outputs.1.sheet: no sheet format ends in .exr | allowed: .png, .jpg, "
                ".jpeg");
  EXPECT_EQ(error_at(kImage + ", {sheet: s.png, image: sky.####.png, columns: 201}"),
            kPlace + "201] outputs.1.columns = 201 is out of range | allowed: 0 to 200");
  EXPECT_EQ(error_at(kImage + ", {sheet: ../s.png, image: sky.####.png}"),
            kPlace +
                "../s.png] outputs.1.sheet: this leaves the output folder | use a name inside "
                "it, or add \"allow_outside_paths: on\" at the top level");
  EXPECT_EQ(error_at(kImage + ", {gallery: manifest.json, image: sky.####.png}"),
            kPlace +
                "manifest.json] outputs.1.gallery: this name belongs to the program's own "
                "records | manifest.json and .skylapse are kept at the top of the output "
                "folder");
  EXPECT_THAT(error_at("{specular: a.####.ktx2}, {irradiance: ./a.####.ktx2}"),
              HasSubstr("two outputs have this name | the first is on line 4"));
}

}  // namespace
}  // namespace skylapse::config
