// What good jobs mean.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "config/air_conversion.h"
#include "config/job_text.h"
#include "support/temporary_folder.h"

namespace skylapse::config {
namespace {

using namespace std::chrono_literals;
using test::kSmallJob;
using test::with;

JobConfig job_of(const std::string& text, const std::vector<Override>& overrides = {}) {
  auto job = parse_job(text, "job.yaml", overrides);
  EXPECT_TRUE(job.ok()) << test::error_of(text, overrides);
  return job.ok() ? *job : JobConfig{};
}

const std::string kSmallTime = "{zone: Europe/Prague, date: 2026-06-21, step: 10 min}";

JobConfig job_at(const std::string& time) { return job_of(with(kSmallJob, kSmallTime, time)); }

TEST(LoadJob, TheSmallestJobHasTheDefaultsOfItsStructs) {
  const JobConfig job = job_of(kSmallJob);
  ASSERT_EQ(job.sites.size(), 1u);
  EXPECT_EQ(job.sites[0].name, "site1");
  EXPECT_NEAR(job.sites[0].position.latitude.in(deg), 50.0755, 1e-12);
  EXPECT_EQ(job.sites[0].position.height.in(metre), 0);
  EXPECT_EQ(job.time.from->clock, 0h);
  EXPECT_EQ(job.time.to->clock, 24h);
  EXPECT_EQ(std::get<FixedStep>(job.time.sampling).step.in(minute), 10);
  ASSERT_EQ(job.air.turbidity.size(), 1u);
  EXPECT_EQ(job.air.turbidity[0].value, Air{}.turbidity[0].value);
  ASSERT_EQ(job.cameras.size(), 1u);
  EXPECT_EQ(job.cameras[0].camera.width, 1920);
  EXPECT_EQ(job.exposure.mode, color::ExposureMode::sun_curve);
  ASSERT_EQ(job.outputs.size(), 1u);
  const auto& png = std::get<ImageOutput>(job.outputs[0]);
  EXPECT_EQ(png.format, "png");
  EXPECT_EQ(png.sample_type, output::SampleType::u8);
  EXPECT_EQ(png.view, "");
  EXPECT_EQ(png.path.span.line, 4);
  EXPECT_EQ(png.path.span.column, 19);
}

TEST(LoadJob, LocationsKeepTheirZonesAndNames) {
  const JobConfig job =
      job_of(with(kSmallJob, "location: {latitude: 50.0755 deg, longitude: 14.4378 deg}",
                  "locations:\n"
                  "  - {name: A, latitude: 1, longitude: 2, height: -400 m}\n"
                  "  - {latitude: 3 S, longitude: 359, zone: Asia/Tokyo}"));
  ASSERT_EQ(job.sites.size(), 2u);
  EXPECT_EQ(job.sites[0].position.height.in(metre), -400);
  EXPECT_FALSE(job.sites[0].zone.has_value());
  EXPECT_EQ(job.sites[1].name, "site2");
  EXPECT_EQ(job.sites[1].zone->value, "Asia/Tokyo");
  EXPECT_EQ(job.sites[1].zone->span.line, 3);
  EXPECT_NEAR(job.sites[1].position.latitude.in(deg), -3, 1e-14);
  EXPECT_EQ(job.sites[1].span.line, 3);
}

TEST(LoadJob, ExactlyTheSamplingThatIsWrittenIsUsed) {
  EXPECT_EQ(std::get<FrameCount>(job_at("{zone: UTC, date: 2026-06-21, frames: 240}").time.sampling)
                .count,
            240);
  EXPECT_NEAR(
      std::get<ElevationStep>(job_at("{zone: UTC, date: 2026-06-21, every: 1 deg}").time.sampling)
          .step.in(deg),
      1, 1e-15);
  const JobConfig list =
      job_at("{zone: UTC, date: 2026-06-21, at: [sunrise, 18:30, solar_noon - 1 h]}");
  const auto& times = std::get<ExplicitTimes>(list.time.sampling).times;
  ASSERT_EQ(times.size(), 3u);
  EXPECT_EQ(times[1].clock, 18h + 30min);
  EXPECT_EQ(times[2].offset.in(hour), -1);
  EXPECT_EQ(times[2].span.line, 2);
  EXPECT_EQ(test::underlined(times[2].span), "solar_noon - 1 h");
  EXPECT_EQ(
      std::get<ExplicitTimes>(job_at("{zone: UTC, date: 2026-06-21, at: sunrise}").time.sampling)
          .times.size(),
      1u);
}

TEST(LoadJob, TimesMayCarryTheirOwnDay) {
  const JobConfig job = job_at(
      "{zone: Europe/Prague, from: 2026-06-21 sunrise - 45 min, to: 2026-06-21 sunset + 45 min, "
      "step: 2 min}");
  EXPECT_TRUE(job.time.dates.empty());
  EXPECT_EQ(job.time.from->date, std::chrono::year(2026) / 6 / 21);
  EXPECT_EQ(job.time.from->anchor, astro::EventKind::sunrise);
  EXPECT_EQ(job.time.to->offset.in(minute), 45);
  const JobConfig open_end = job_at("{zone: UTC, from: 2026-06-21 18:00, step: 2 min}");
  EXPECT_EQ(open_end.time.to->date, open_end.time.from->date);
  EXPECT_EQ(open_end.time.to->clock, 24h);
}

TEST(LoadJob, TimesWithTheirOwnOffsetNeedNoZone) {
  const JobConfig job = job_at("{from: 2026-06-21T04:30+02:00, to: 2026-06-21T20:00Z, step: 1 h}");
  EXPECT_FALSE(job.time.zone.has_value());
  EXPECT_EQ(job.time.from->utc_offset, 2h);
  EXPECT_EQ(job.time.to->utc_offset, 0s);
}

TEST(LoadJob, DaysAreWrittenInManyWays) {
  const auto dates = [](const std::string& text) {
    return job_at("{zone: UTC, at: 12:00, " + text + "}").time.dates;
  };
  EXPECT_EQ(dates("dates: 2026-06-01 .. 2026-06-30")[0].last, std::chrono::year(2026) / 6 / 30);
  EXPECT_EQ(dates("dates: [2026-03-20, 2026-06-21, 2026-07-01 .. 2026-07-05]").size(), 3u);
  const auto stepped = dates("dates: {from: 2026-01-01, to: 2026-12-31, step: 7 days}");
  ASSERT_EQ(stepped.size(), 1u);
  EXPECT_EQ(stepped[0].step_days, 7);
  EXPECT_EQ(dates("dates: [{from: 2026-01-01, to: 2026-02-01}, 2026-05-01]").size(), 2u);
}

TEST(LoadJob, HazeIsConvertedAndListsAreKept) {
  EXPECT_NEAR(job_of(kSmallJob + "air: {visibility: 40 km}\n").air.turbidity[0].value,
              turbidity_from_visibility(40 * km), 1e-12);
  EXPECT_NEAR(job_of(kSmallJob + "air: {aerosol_optical_depth: 0.1}\n").air.turbidity[0].value,
              turbidity_from_aerosol_depth(0.1), 1e-12);
  const Air air =
      job_of(kSmallJob +
             "air: {turbidity: [2, 4.5, 8], ground_albedo: [0.1, grass], refraction: off, "
             "pressure: 700 hPa, temperature: 0 degC}\n")
          .air;
  ASSERT_EQ(air.turbidity.size(), 3u);
  EXPECT_EQ(air.turbidity[1].value, 4.5);
  EXPECT_EQ(air.turbidity[1].span.column, 22);
  ASSERT_EQ(air.ground_albedo.size(), 2u);
  EXPECT_FALSE(air.ground_albedo[0].value.spectral);
  EXPECT_EQ(air.ground_albedo[0].value.value, 0.1);
  EXPECT_TRUE(air.ground_albedo[1].value.spectral);
  EXPECT_EQ(air.ground_albedo[1].value.name, "grass");
  EXPECT_GT(air.ground_albedo[1].value.value, 0);
  EXPECT_FALSE(air.refraction.enabled);
  EXPECT_EQ(air.refraction.pressure.in(hPa), 700);
  EXPECT_EQ(air.refraction.temperature.in(degC), 0);
}

TEST(LoadJob, CamerasLookWhereTheyAreTold) {
  const auto camera = [](const std::string& text) {
    return job_of(with(kSmallJob, "{look_at: west}", text)).cameras.at(0);
  };
  const auto forward = [](const CameraConfig& c) {
    return Direction<Enu>::from_vector(c.camera.camera_to_enu[2]);
  };
  const CameraConfig west = camera("{look_at: west}");
  EXPECT_NEAR(azimuth(forward(west)).in(deg), 270, 1e-9);
  EXPECT_NEAR(elevation(forward(west)).in(deg), 0, 1e-9);
  const CameraConfig tilted =
      camera("{look_at: {azimuth: south-west, elevation: 15 deg}, fov: 75 deg}");
  EXPECT_NEAR(azimuth(forward(tilted)).in(deg), 225, 1e-9);
  EXPECT_NEAR(elevation(forward(tilted)).in(deg), 15, 1e-9);
  EXPECT_NEAR(tilted.camera.field_of_view.in(deg), 75, 1e-12);
  const CameraConfig all_sky = camera("{projection: fisheye}");
  EXPECT_NEAR(elevation(forward(all_sky)).in(deg), 90, 1e-6);
  EXPECT_GT(all_sky.camera.camera_to_enu[1].y, 0.999);  // the upper edge is north
  EXPECT_NEAR(all_sky.camera.field_of_view.in(deg), 180, 1e-12);
}

TEST(LoadJob, CubesAreSizedByTheirFaces) {
  const auto cube = [](const std::string& layout) {
    return job_of(with(with(kSmallJob, "{look_at: west}",
                            "{projection: cube, size: 64, layout: " + layout + "}"),
                       "sky.####.png", layout == "faces" ? "\"{face}.####.png\"" : "sky.####.png"))
        .cameras.at(0);
  };
  EXPECT_EQ(cube("vertical-strip").camera.height, 384);
  EXPECT_EQ(cube("horizontal-strip").camera.width, 384);
  EXPECT_EQ(cube("cross").camera.width, 256);
  EXPECT_EQ(cube("cross").camera.height, 192);
  EXPECT_TRUE(cube("faces").cube_faces_apart);
}

TEST(LoadJob, FormatsDecideWhatIsDisplayReferred) {
  const auto image = [](const std::string& keys) {
    return std::get<ImageOutput>(
        job_of(with(kSmallJob, "{image: sky.####.png}", "{image: sky.####." + keys + "}"))
            .outputs.at(0));
  };
  EXPECT_FALSE(image("exr").view.has_value());
  EXPECT_EQ(image("exr").sample_type, output::SampleType::float32);
  EXPECT_EQ(image("exr, type: half, sun: split").sun_policy, output::SunPolicy::split);
  EXPECT_EQ(image("exr, view: ACES SDR").view, "ACES SDR");
  EXPECT_EQ(image("exr, display: sRGB").view, "");
  EXPECT_FALSE(image("hdr").view.has_value());
  EXPECT_EQ(image("jpeg, quality: 80").format, "jpg");
  EXPECT_TRUE(image("jpg").view.has_value());
  EXPECT_EQ(image("tiff").sample_type, output::SampleType::u16);
  EXPECT_TRUE(image("tif").view.has_value());
  EXPECT_FALSE(image("tif, type: float").view.has_value());
  EXPECT_EQ(image("PNG, type: u16").sample_type, output::SampleType::u16);
}

TEST(LoadJob, OutputsKeepThePlacesOfTheirViewAndSun) {
  const auto output = [](const std::string& text) {
    return job_of(with(kSmallJob, "{image: sky.####.png}", text)).outputs.at(0);
  };
  const auto image = [&](const std::string& text) { return std::get<ImageOutput>(output(text)); };
  const auto movie = [&](const std::string& text) { return std::get<MovieOutput>(output(text)); };
  EXPECT_EQ(test::underlined(image("{image: '####.exr', view: Raw}").view_span), "Raw");
  EXPECT_EQ(test::underlined(image("{image: '####.exr', display: sRGB}").view_span), "sRGB");
  EXPECT_EQ(test::underlined(image("{image: '####.png'}").view_span), "####.png");
  const ImageOutput half = image("{image: '####.exr', type: half, sun: refuse}");
  EXPECT_EQ(test::underlined(half.sun_policy_span), "refuse");
  EXPECT_EQ(test::underlined(image("{image: '####.exr'}").sun_policy_span), "####.exr");
  EXPECT_EQ(test::underlined(movie("{movie: day.mp4, view: Raw}").view_span), "Raw");
  EXPECT_EQ(test::underlined(movie("{movie: day.mp4}").view_span), "day.mp4");
}

TEST(LoadJob, AnExposureValueMeansModeFixed) {
  const auto exposure =
      job_of(kSmallJob + "exposure: {ev: 14.5 EV, compensation: -0.5}\n").exposure;
  EXPECT_EQ(exposure.mode, color::ExposureMode::fixed);
  EXPECT_EQ(exposure.ev, 14.5);
  EXPECT_EQ(exposure.compensation, -0.5);
}

TEST(LoadJob, AnEmptySectionIsTheSameAsNone) {
  job_of(kSmallJob + "air:\nsky:\n  # model: auto\n");
}

TEST(LoadJob, FilesThatCannotBeReadAreMissingInput) {
  for (const char* path : {"/nonexistent/job.yaml", SKYLAPSE_SOURCE_DIR}) {
    const auto job = load_job(path);
    ASSERT_FALSE(job.ok());
    ASSERT_EQ(job.error().size(), 1u);
    EXPECT_EQ(job.error()[0].code, ErrorCode::missing_input);
    EXPECT_FALSE(job.error()[0].hint.empty());
  }
}

TEST(LoadJob, APipeIsRefusedInsteadOfWaitedFor) {
  const TemporaryFolder folder;
  const std::string pipe = folder.path() / "job.yaml", link = folder.path() / "link.yaml";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::filesystem::create_symlink(pipe, link);
  for (const std::string& path : {pipe, link, std::string("/dev/null")}) {
    const auto job = load_job(path);
    ASSERT_FALSE(job.ok());
    EXPECT_EQ(job.error()[0].code, ErrorCode::missing_input);
    EXPECT_EQ(job.error()[0].message, path + ": this is not a regular file");
  }
}

TEST(LoadJob, ALinkToAConfigIsRead) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "job.yaml") << kSmallJob;
  std::filesystem::create_symlink("job.yaml", folder.path() / "link.yaml");
  EXPECT_TRUE(load_job(folder.path() / "link.yaml").ok());
}

TEST(LoadJob, OutputNamesHaveOneSpelling) {
  for (const char* name :
       {"a/b.####.png", "./a/b.####.png", "a//b.####.png", "a/./c/../b.####.png"})
    EXPECT_EQ(std::get<ImageOutput>(job_of(with(kSmallJob, "sky.####.png", name)).outputs.at(0))
                  .path.value,
              "a/b.####.png");
}

TEST(LoadJob, TheColourConfigIsSoughtBesideTheJob) {
  const TemporaryFolder folder;
  const std::string name = folder.path() / "job.yaml";
  std::ofstream(folder.path() / "studio.ocio") << "x";
  std::ofstream(name) << kSmallJob + "color: {space: acescg, ocio: studio.ocio}\n";
  const auto job = load_job(name);
  ASSERT_TRUE(job.ok()) << format_error(job.error()[0]);
  EXPECT_TRUE(std::ifstream(job->color.ocio->value).good()) << job->color.ocio->value;
  std::ofstream(name) << kSmallJob + "color: {ocio: other.ocio}\n";
  const auto missing = load_job(name);
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error()[0].code, ErrorCode::missing_input);
  EXPECT_EQ(missing.error()[0].span.line, 5);
}

}  // namespace
}  // namespace skylapse::config
