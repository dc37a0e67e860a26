// Keys of the sky: model, accuracy, effects. The rows are explained in key_spec.h.
#include "config/key_sections.h"
#include "config/words.h"

namespace skylapse::config {
namespace {

using K = ValueKind;
using D = Dimension;

/// "auto", "all", and the effects by name.
std::vector<std::string_view> effect_words() {
  std::vector<std::string_view> words{"auto", "all"};
  for (const auto& [name, effect] : sky::kEffectNames) words.push_back(name);
  return words;
}

}  // namespace

const SectionSpec& sky_spec() {
  static const SectionSpec spec{
      .name = "sky",
      .doc = "How the sky is computed.",
      .keys =
          {
              {.name = "model",
               .kind = K::word,
               .words = words_of(kSkyModelWords),
               .default_text = "auto",
               .example = "bruneton",
               .doc = "Sky model. `auto` takes the cheapest that fits the scene and says why; "
                      "`bruneton` computes the atmosphere with all orders of scattering, "
                      "`single-scattering` with the first, `reference` by tracing paths, slow and "
                      "with noise; `hosek-wilkie`, `preetham` and `cie` are fits for the sun above "
                      "the horizon of an observer on the ground."},
              {.name = "accuracy",
               .kind = K::quantity,
               .dimension = D::share,
               .min = "0.1 %",
               .max = "100 %",
               .example = "2 %",
               .doc =
                   "The error that is accepted: rms of the relative error of the picture's sky "
                   "without the sun's disc, by solid angle. The cheapest way to keep it is taken."},
              {.name = "time_budget",
               .kind = K::quantity,
               .dimension = D::duration,
               .min = "1 ms",
               .max = "1 day",
               .example = "0.5 s",
               .doc = "Core seconds that a frame may take, its share of tables included; the most "
                      "accurate way within it is taken."},
              {.name = "effects",
               .kind = K::word,
               .words = effect_words(),
               .list = true,
               .default_text = "auto",
               .example = "[sun-disc, ozone, multiple-scattering]",
               .doc =
                   "What is computed: `auto` what the scene calls for, `all` everything whether it "
                   "shows or not, or a list of effects and no others."},
              {.name = "level",
               .kind = K::word,
               .words = words_of(kLevelWords),
               .default_text = "standard",
               .example = "fine",
               .doc = "How finely an atmosphere is computed."},
              {.name = "wavelengths",
               .kind = K::integer,
               .min = "3",
               .max = "32",
               .default_text = "16",
               .example = "8",
               .doc = "Bands of wavelengths in which an atmosphere is computed."},
              {.name = "orders",
               .kind = K::integer,
               .min = "1",
               .max = "100",
               .example = "4",
               .doc = "Orders of scattering that are computed; what lies beyond them is left out. "
                      "Default: until they converge."},
              {.name = "steps",
               .kind = K::integer,
               .min = "1",
               .max = "64",
               .example = "8",
               .doc = "Points on each piece of a view ray at which its light is gathered; fewer "
                      "than 8 cost up to 30 % of the radiance near the ground. Default: "
                      "the model's own."},
              {.name = "slice",
               .kind = K::image_size,
               .example = "32x64",
               .doc = "Azimuths and zenith angles of the table of directions that the pixels of a "
                      "frame are made from. Default: 64x128 near the ground, more rows above."},
              {.name = "precision",
               .kind = K::word,
               .words = words_of(kPrecisionWords),
               .default_text = "float",
               .example = "double",
               .doc =
                   "Arithmetic of an atmosphere: OpenGL in float, the same with tables rounded to "
                   "half floats, or the processor in double."},
              {.name = "samples",
               .kind = K::integer,
               .min = "2",
               .max = "1000000000",
               .example = "4096",
               .doc = "Paths a pixel of `reference`, 1024 if not given (one has no standard "
                      "error); beside "
                      "relative_error, at most."},
              {.name = "relative_error",
               .kind = K::quantity,
               .dimension = D::share,
               .min = "0.01 %",
               .max = "100 %",
               .example = "1 %",
               .doc =
                   "Each pixel of `reference` gets paths until its standard error is this share of "
                   "its radiance."},
              {.name = "seed",
               .kind = K::integer,
               .min = "0",
               .max = "1000000000",
               .example = "7",
               .doc = "Of the random numbers of `reference`; 1 if not given."},
              {.name = "cie_type",
               .kind = K::integer,
               .min = "1",
               .max = "15",
               .example = "5",
               .doc = "Which of the fifteen skies of the CIE general sky, 12 if not given: 1 "
                      "overcast, 5 uniform, 12 "
                      "clear, 15 clear and turbid with a broad corona."},
              {.name = "fit",
               .kind = K::word,
               .words = words_of(kFitWords),
               .default_text = "spectral",
               .example = "xyz",
               .doc = "Which of the three published Hosek-Wilkie fits."},
              {.name = "solar_flux",
               .kind = K::word,
               .words = words_of(kSolarFluxWords),
               .default_text = "reference",
               .example = "conserving",
               .doc = "Sun disc of Hosek-Wilkie as published, or with the full flux of direct "
                      "sunlight."},
              {.name = "sun_disc",
               .kind = K::on_off,
               .default_text = "on",
               .example = "off",
               .doc = "Whether the disc itself is drawn."},
              {.name = "sun_algorithm",
               .kind = K::word,
               .words = words_of(kSunAlgorithmWords),
               .default_text = "erfa",
               .example = "sg2",
               .doc = "Formulas for the sun's position; all but `erfa` are there to be compared."},
          },
      .alternatives = {{{"accuracy", "time_budget"}}}};
  return spec;
}

}  // namespace skylapse::config
