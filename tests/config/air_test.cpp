// The air of a job: presets, layers, haze for models that compute the atmosphere, keyframes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/air_conversion.h"
#include "config/air_presets.h"
#include "config/job_text.h"

namespace skylapse::config {
namespace {

using test::error_of;
using test::errors_of;
using test::kSmallJob;
using test::underlined;
using test::with;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

JobConfig job_with(const std::string& lines, const std::vector<Override>& overrides = {}) {
  const auto job = parse_job(kSmallJob + lines, "job.yaml", overrides);
  EXPECT_TRUE(job.ok()) << error_of(kSmallJob + lines, overrides);
  return job ? *job : JobConfig{};
}
std::string error_after(const std::string& lines) { return error_of(kSmallJob + lines); }

TEST(AirOfAJob, SaysNothingButDefaultsWhenNothingIsWritten) {
  for (const std::string lines : {"", "air:\n", "air: {turbidity: 2.5, ozone: 300 DU}\n"}) {
    const Air air = job_with(lines).air;
    EXPECT_FALSE(air.needs_atmosphere.has_value());
    EXPECT_NEAR(air.description.aerosol_optical_depth, aerosol_depth_from_turbidity(2.5), 1e-15);
    EXPECT_EQ(air.description.ground_albedo.at(550.0 * nm), 0.2);
    EXPECT_EQ(air.description.ozone_du, 300);
    EXPECT_THAT(air.keyframes, IsEmpty());
    EXPECT_FALSE(air.observer_pressure_given);
  }
}

TEST(AirOfAJob, TakesEveryKey) {
  const Air air = job_with(
                      "air:\n"
                      "  aerosol_optical_depth: 0.3\n"
                      "  aerosol: {angstrom_exponent: 0.5, single_scattering_albedo: 0.8, g: 0.6, "
                      "scale_height: 2 km}\n"
                      "  stratosphere: {optical_depth: 0.15, bottom: 16 km, top: 26 km}\n"
                      "  ozone: 350 DU\n"
                      "  surface_pressure: 990 hPa\n"
                      "  planet_radius: 6360 km\n"
                      "  top_height: 60 km\n"
                      "  ground_albedo: snow\n"
                      "  pressure: 700 hPa\n")
                      .air;
  const auto& d = air.description;
  EXPECT_NEAR(d.aerosol_optical_depth, 0.3, 1e-12);
  EXPECT_EQ(d.angstrom_exponent, 0.5);
  EXPECT_EQ(d.aerosol_single_scattering_albedo, 0.8);
  EXPECT_EQ(d.aerosol_g, 0.6);
  EXPECT_EQ(d.aerosol_scale_height.in(km), 2);
  EXPECT_EQ(d.stratospheric_optical_depth, 0.15);
  EXPECT_EQ(d.stratospheric_bottom.in(km), 16);
  EXPECT_EQ(d.stratospheric_top.in(km), 26);
  EXPECT_EQ(d.ozone_du, 350);
  EXPECT_EQ(d.surface_pressure.in(hPa), 990);
  EXPECT_EQ(d.planet_radius.in(km), 6360);
  EXPECT_EQ(d.top_height.in(km), 60);
  EXPECT_NEAR(d.ground_albedo.at(360.0 * nm), 0.9754, 1e-12);
  EXPECT_TRUE(air.observer_pressure_given);
  EXPECT_EQ(air.refraction.pressure.in(hPa), 700);
  ASSERT_TRUE(air.needs_atmosphere.has_value());
  EXPECT_EQ(air.needs_atmosphere->value, "air.aerosol");
  EXPECT_EQ(underlined(air.needs_atmosphere->span), "aerosol");
}

TEST(AirOfAJob, FirstKeyThatNeedsAnAtmosphereIsNamed) {
  const std::pair<std::string, std::string> cases[] = {
      {"preset: clear", "air.preset"},
      {"ozone: 250 DU", "air.ozone"},
      {"surface_pressure: 900 hPa", "air.surface_pressure"},
      {"top_height: 80 km", "air.top_height"},
      {"stratosphere: {optical_depth: 0.1}", "air.stratosphere"},
      {"visibility: 2 km", "air.visibility"},
      {"aerosol_optical_depth: 0", "air.aerosol_optical_depth"},
      {"keyframes: [{time: 06:00, ozone: 300 DU}]", "air.keyframes"},
  };
  for (const auto& [lines, key] : cases) {
    const Air air = job_with("air: {" + lines + "}\n").air;
    ASSERT_TRUE(air.needs_atmosphere.has_value()) << lines;
    EXPECT_EQ(air.needs_atmosphere->value, key);
  }
}

TEST(Presets, AreTheFilesOfTheirFolderAndAllAreAir) {
  EXPECT_THAT(preset_names(), ElementsAre("clear", "dusty", "maritime", "mountain", "rural",
                                          "urban", "volcanic dusk", "volcanic-dusk"));
  for (const std::string_view name : preset_names()) {
    const JobConfig job = job_with("air: {preset: " + std::string(name) + "}\n");
    const auto atmosphere = sky::atmosphere::atmosphere_of(job.air.description);
    ASSERT_TRUE(atmosphere.ok()) << name;
    EXPECT_TRUE(check(medium_at(*atmosphere, sky::atmosphere::band_edges(16))).ok()) << name;
  }
}

TEST(Presets, GiveWhatTheyPromise) {
  const auto urban = job_with("air: {preset: urban}\n").air.description;
  EXPECT_NEAR(urban.aerosol_optical_depth, 0.643, 1e-12);
  EXPECT_EQ(urban.aerosol_single_scattering_albedo, 0.817);
  const auto volcano = job_with("air: {preset: volcanic dusk}\n").air.description;
  EXPECT_EQ(volcano.stratospheric_optical_depth, 0.15);
  EXPECT_EQ(job_with("air: {preset: maritime}\n").air.ground_albedo[0].value.name, "water");
}

TEST(Presets, GiveWayToWhatIsWrittenBesideThem) {
  const Air air = job_with(
                      "air: {preset: maritime, visibility: 10 km, aerosol: {g: 0.5}, "
                      "ground_albedo: [0.1, sand]}\n")
                      .air;
  EXPECT_EQ(air.description.aerosol_g, 0.5);
  EXPECT_EQ(air.description.angstrom_exponent, 0.1);          // the preset's
  EXPECT_EQ(air.description.aerosol_scale_height.in(km), 1);  // the preset's
  sky::atmosphere::AirDescription shallow;
  shallow.aerosol_scale_height = 1.0 * km;
  EXPECT_NEAR(air.description.aerosol_optical_depth,
              aerosol_depth_from_visibility(10 * km, shallow), 1e-12);
  EXPECT_EQ(air.ground_albedo.size(), 2u);
}

TEST(Presets, WorkFromTheCommandLine) {
  const Air air = job_with("air: {turbidity: 3}\n", {{"air.preset", "urban"}}).air;
  EXPECT_EQ(air.turbidity[0].value, 3);
  EXPECT_EQ(air.description.aerosol_single_scattering_albedo, 0.817);
}

TEST(Presets, UnknownOnesShowTheNearest) {
  EXPECT_EQ(error_after("air: {preset: rual}\n"),
            "5 [rual] air.preset = rual is not known | allowed: clear, dusty, maritime, "
            "mountain, rural, urban, volcanic dusk, volcanic-dusk; did you mean rural?");
  EXPECT_THAT(error_after("air: {preset: {a: 1}}\n"), StartsWith("5 [{] air.preset is a section"));
}

TEST(Haze, ReachesFrom200MetresTo300KmInComputedAir) {
  for (const std::string model : {"auto", "bruneton", "single-scattering"})
    for (const std::string visibility : {"200 m", "1 km", "5 km", "40 km", "300 km", "340 km"}) {
      const Air air =
          job_with("air: {visibility: " + visibility + "}\nsky: {model: " + model + "}\n").air;
      EXPECT_TRUE(sky::atmosphere::atmosphere_of(air.description).ok());
      EXPECT_NEAR(turbidity_from_aerosol_depth(air.description.aerosol_optical_depth),
                  air.turbidity[0].value, 1e-9);
    }
  EXPECT_NEAR(job_with("air: {visibility: 200 m}\n").air.description.aerosol_optical_depth,
              (3.912 / 200 - 1.15e-5) * 1200, 1e-9);
}

TEST(Haze, BeyondTurbidity10IsRefusedByHosekWilkieAlone) {
  const std::string hosek_wilkie = "sky: {model: hosek-wilkie}\n";
  EXPECT_EQ(error_after("air: {visibility: 2 km}\n" + hosek_wilkie),
            "5 [2 km] air.visibility is turbidity 24.3, beyond the Hosek-Wilkie sky | allowed: "
            "5.13 km to 328 km; or use sky.model bruneton");
  EXPECT_EQ(error_after("air: {aerosol_optical_depth: 2}\n" + hosek_wilkie),
            "5 [2] air.aerosol_optical_depth is turbidity 20.9, beyond the Hosek-Wilkie sky | "
            "allowed: 0.0005 to 0.902; or use sky.model bruneton");
  EXPECT_EQ(error_after("air: {visibility: 2 km}\n"), "no error");
}

TEST(Haze, ClearerThanAirWithoutHazeIsRefused) {
  EXPECT_EQ(error_after("air: {visibility: 400 km}\n"),
            "5 [400 km] air.visibility is beyond that of air without haze | allowed: 200 m to 340 "
            "km");
  EXPECT_EQ(error_after("air: {visibility: 400 km, surface_pressure: 800 hPa}\n"), "no error");
}

TEST(Haze, TooThickForAnyLightIsRefused) {
  EXPECT_EQ(
      error_after("air: {visibility: 200 m, aerosol: {scale_height: 10 km}}\n"),
      "5 [200 m] air.visibility makes an aerosol optical depth of 195 | allowed: at most 100");
}

TEST(AirErrors, NonsenseHasItsPlaceAndRange) {
  EXPECT_EQ(
      error_after("air: {visibility: 1 m}\n"),
      "5 [1 m] air.visibility = 1 m is out of range | allowed: 200 m to 1000 km; did you mean "
      "1 km?");
  EXPECT_EQ(error_after("air: {aerosol_optical_depth: -0.1}\n"),
            "5 [-0.1] air.aerosol_optical_depth = -0.1 is out of range | allowed: 0 to 30");
  EXPECT_THAT(error_after("air: {ozone: .nan DU}\n"), StartsWith("5 [.nan DU] air.ozone: "));
  EXPECT_EQ(error_after("air: {ozone: 300}\n"),
            "5 [300] air.ozone: 300 has no unit | write 300 DU; allowed units: DU");
  EXPECT_EQ(error_after("air: {ground_albedo: 2}\n"),
            "5 [2] air.ground_albedo = 2 is out of range | allowed: 0 to 1");
  EXPECT_EQ(error_after("air: {top_height: -10 km}\n"),
            "5 [-10 km] air.top_height = -10 km is out of range | allowed: 1 km to 200 km");
  EXPECT_EQ(error_after("air: {aerosol: {single_scattering_albedo: 2}}\n"),
            "5 [2] air.aerosol.single_scattering_albedo = 2 is out of range | allowed: 0 to 1");
  EXPECT_EQ(error_after("air: {aerosol: {angstrom: 1}}\n"),
            "5 [angstrom] the key \"angstrom\" is not known in air.aerosol | known keys: "
            "angstrom_exponent, single_scattering_albedo, g, scale_height");
  EXPECT_THAT(error_after("air: {ozon: 300 DU}\n"), HasSubstr("did you mean ozone?"));
  EXPECT_EQ(error_after("sky: {model: brunetton}\n"),
            "5 [brunetton] sky.model = brunetton is not known | allowed: auto, cie, preetham, "
            "hosek-wilkie, hosek-wilkie-gl, single-scattering, bruneton, reference; did you mean "
            "bruneton?");
  EXPECT_EQ(error_after("sky: {wavelengths: 2}\n"),
            "5 [2] sky.wavelengths = 2 is out of range | allowed: 3 to 32");
}

TEST(AirErrors, LayersMustFitIntoTheAtmosphere) {
  EXPECT_EQ(error_after("air: {top_height: 30 km}\n"),
            "5 [30 km] air: the top of the ozone layer of 40 km is above the top of the atmosphere "
            "of 30 km | raise the top of the atmosphere, or lower the top of the ozone layer");
  EXPECT_EQ(error_after("air: {top_height: 30 km, ozone: 0 DU}\n"), "no error");
  EXPECT_THAT(
      error_after("air: {stratosphere: {optical_depth: 0.1, bottom: 20 km, top: 18 km}}\n"),
      StartsWith("5 [18 km] air: the stratospheric layer ends at 18 km, not above its bottom"));
}

TEST(AirErrors, KeysThatADemandedModelMakesNothingOf) {
  EXPECT_THAT(errors_of(kSmallJob + "air: {ozone: 350 DU, planet_radius: 6360 km}\n"
                                    "sky: {model: hosek-wilkie, level: fine}\n"),
              ElementsAre("5 [ozone] air.ozone means nothing to the Hosek-Wilkie sky | use "
                          "sky.model bruneton, single-scattering or auto",
                          "5 [planet_radius] air.planet_radius means nothing to the Hosek-Wilkie "
                          "sky | use sky.model bruneton, single-scattering or auto",
                          "6 [level] sky.level has no effect here | it belongs to the model "
                          "bruneton"));
  EXPECT_EQ(error_after("air: {preset: urban}\nsky: {model: hosek-wilkie-gl}\n"),
            "5 [preset] air.preset means nothing to the Hosek-Wilkie sky | use sky.model bruneton, "
            "single-scattering or auto");
  EXPECT_EQ(error_after("sky: {model: bruneton, fit: xyz}\n"),
            "5 [fit] sky.fit has no effect here | it belongs to the models hosek-wilkie and "
            "hosek-wilkie-gl");
}

TEST(AirErrors, EachFittedModelIsNamedWithItsRange) {
  EXPECT_EQ(error_after("air: {ozone: 350 DU}\nsky: {model: preetham}\n"),
            "5 [ozone] air.ozone means nothing to the Preetham sky | use sky.model bruneton, "
            "single-scattering or auto");
  EXPECT_EQ(error_after("air: {turbidity: 1.5}\nsky: {model: preetham}\n"),
            "5 [1.5] air.turbidity is turbidity 1.5, beyond the Preetham sky | allowed: 1.7 to 10; "
            "or use sky.model bruneton");
  EXPECT_THAT(error_after("air: {visibility: 2 km}\nsky: {model: cie}\n"),
              HasSubstr("is turbidity 24.3, beyond the CIE general sky"));
  EXPECT_EQ(error_after("air: {turbidity: 3}\nsky: {model: cie, cie_type: 2}\n"),
            "5 [turbidity] air.turbidity means nothing to a covered sky | sky.cie_type 7 to 15 are "
            "skies with the sun in them");
  EXPECT_EQ(error_after("sky: {model: cie, cie_type: 16}\n"),
            "5 [16] sky.cie_type = 16 is out of range | allowed: 1 to 15");
}

TEST(AirOfAJob, ACieSkyHasTheTurbidityOfItsType) {
  EXPECT_EQ(job_with("sky: {model: cie}\n").air.turbidity[0].value, 2.5);
  EXPECT_EQ(job_with("sky: {model: cie, cie_type: 14}\n").air.turbidity[0].value, 5);
  EXPECT_EQ(
      job_with("air: {turbidity: 3}\nsky: {model: cie, cie_type: 14}\n").air.turbidity[0].value, 3);
}

TEST(Keyframes, KeepTheirTimesAndTakeTheRestFromTheAir) {
  const Air air = job_with(
                      "air:\n"
                      "  visibility: 30 km\n"
                      "  ozone: 320 DU\n"
                      "  keyframes:\n"
                      "    - {time: 06:00, visibility: 5 km}\n"
                      "    - {time: solar_noon, ozone: 350 DU}\n"
                      "    - {time: 2026-06-21T20:00+02:00, turbidity: 4}\n")
                      .air;
  ASSERT_EQ(air.keyframes.size(), 3u);
  EXPECT_NEAR(air.keyframes[0].state.aerosol_optical_depth, (3.912 / 5000 - 1.15e-5) * 1200, 1e-9);
  EXPECT_EQ(air.keyframes[0].state.ozone_du, 320);
  EXPECT_NEAR(air.keyframes[1].state.aerosol_optical_depth, air.description.aerosol_optical_depth,
              1e-15);
  EXPECT_EQ(air.keyframes[1].state.ozone_du, 350);
  EXPECT_NEAR(air.keyframes[2].state.aerosol_optical_depth, aerosol_depth_from_turbidity(4), 1e-12);
  EXPECT_EQ(underlined(air.keyframes[1].time.span), "solar_noon");
}

TEST(Keyframes, BadOnesAreReportedWithTheirPlace) {
  EXPECT_EQ(error_after("air: {keyframes: [{visibility: 5 km}]}\n"),
            "5 [{] air.keyframes.0.time is missing | add \"time: 06:00\"");
  EXPECT_THAT(error_after("air: {keyframes: [{time: 06:00, visibility: 5 km, turbidity: 3}]}\n"),
              HasSubstr("exclude each other"));
  EXPECT_THAT(error_after("air: {keyframes: [{time: 06:00, visibility: 500 km}]}\n"),
              StartsWith("5 [500 km] air.keyframes.0.visibility is beyond that of air without"));
  EXPECT_EQ(error_after("air: {turbidity: [2, 3], keyframes: [{time: 06:00, visibility: 5 km}]}\n"),
            "5 [5 km] air.keyframes.0.visibility and a list of hazes exclude each other | give "
            "`air` one haze, or make a job for each");
  const std::string without_zone =
      with(kSmallJob, "{zone: Europe/Prague, date: 2026-06-21, step: 10 min}",
           "{from: 2026-06-21T04:00Z, to: 2026-06-21T20:00Z, step: 10 min}");
  EXPECT_EQ(error_of(without_zone + "air: {keyframes: [{time: 06:00}, {time: 09:00Z}]}\n"),
            "5 [06:00] air.keyframes.0.time has neither a time zone nor an offset | add \"zone: "
            "Europe/Prague\" (an IANA name, UTC or +02:00) to time or to the location");
}

TEST(Keyframes, TooManyAreRefusedBeforeAnythingIsSearched) {
  const std::string long_job =
      with(kSmallJob, "date: 2026-06-21", "dates: 2000-01-01 .. 2099-12-31");
  EXPECT_THAT(errors_of(with(long_job, "step: 10 min", "at: 12:00") +
                        "air: {keyframes: [{time: sunrise, ozone: 310 DU}]}\n"),
              ElementsAre(HasSubstr("the events of up to 36525 days would have to be found")));
  const std::string far_apart =
      with(kSmallJob, "date: 2026-06-21, step: 10 min", "at: [1900-01-01 12:00, 2199-12-31 12:00]");
  EXPECT_THAT(errors_of(far_apart + "air: {keyframes: [{time: sunrise, ozone: 310 DU}]}\n"),
              ElementsAre(HasSubstr("the events of up to 109573 days would have to be found")));
  std::string keyframes;
  for (int i = 0; i < 30; ++i)
    keyframes +=
        fmt::format("{}{{time: {:02}:00 + {} s, ozone: 310 DU}}", i ? ", " : "", i % 24, i);
  EXPECT_THAT(errors_of(with(long_job, "step: 10 min", "at: 12:00") + "air: {keyframes: [" +
                        keyframes + "]}\n"),
              ElementsAre(HasSubstr("the keyframes fall on 1.1e+06 moments")));
}

TEST(SkyOfAJob, TakesModelLevelAndWavelengths) {
  const Sky sky = job_with("sky: {model: bruneton, level: draft, wavelengths: 3}\n").sky;
  EXPECT_EQ(sky.model, SkyModel::bruneton);
  EXPECT_EQ(sky.level, sky::bruneton::Level::draft);
  EXPECT_EQ(sky.wavelengths, 3);
  EXPECT_EQ(job_with("sky: {model: single-scattering}\n").sky.model, SkyModel::single_scattering);
}

}  // namespace
}  // namespace skylapse::config
