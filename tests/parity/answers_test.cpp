// Single directions in float on GL against the twin, and over the whole domain.
#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "parity/twins.h"

namespace skylapse::sky::bruneton {
namespace {

/// Heights from the ground to far outside, half of them within the air, any directions.
std::vector<Query> random_queries(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Query> queries;
  for (int i = 0; i < count; ++i) {
    const double u = share(random);
    const double height_km = u < 0.1   ? 0
                             : u < 0.6 ? 60 * std::pow(share(random), 3)
                                       : 60 + 1e5 * std::pow(share(random), 4);
    queries.push_back({height_km * km, 180 * share(random) * deg, 180 * share(random) * deg,
                       360 * share(random) * deg});
  }
  return queries;
}

class AnyAnswer : public gpu::AnyContext {
 protected:
  std::vector<Answer> ask(const Tables& tables, const std::vector<Query>& queries,
                          SliceContent content) {
    const auto model = GpuModel::create(context_, tables);
    EXPECT_TRUE(model.ok()) << model.error().message;
    return model ? value_of(model->answer(queries, content)) : std::vector<Answer>(queries.size());
  }
};

std::string text_of(const Query& q) {
  return testing::PrintToString(std::vector<double>{q.height.in(km), q.sun_zenith.in(deg),
                                                    q.view_zenith.in(deg), q.azimuth.in(deg)});
}

TEST_P(AnyAnswer, IsTheTwinsOverTheWholeDomain) {
  const auto tables = reference_tables();
  const Twin twin(tables);
  const auto queries = random_queries(2000, 1);
  const auto answers = ask(*tables, queries, {.multiple_scattering = true, .ground = true});
  ASSERT_EQ(answers.size(), queries.size());
  for (size_t i = 0; i < queries.size(); ++i) {
    const Answer expected = twin.answer(queries[i], {.ground = true});
    ASSERT_EQ(answers[i].radiance.size(), expected.radiance.size());
    for (size_t b = 0; b < expected.radiance.size(); ++b) {
      // Seen in 1e5 draws: 7e-5 (bench_atmosphere --draws); 1e-7 is a millionth of a bright sky.
      EXPECT_NEAR(answers[i].radiance[b], expected.radiance[b],
                  3e-4 * std::max(expected.radiance[b], 1e-7))
          << text_of(queries[i]);
      EXPECT_NEAR(answers[i].transmittance[b], expected.transmittance[b], 1e-4)
          << text_of(queries[i]);
      // The table of columns between its nodes against quadrature.
      EXPECT_NEAR(answers[i].sun_transmittance[b], expected.sun_transmittance[b], 2e-3)
          << text_of(queries[i]);
    }
  }
}

TEST_P(AnyAnswer, IsFiniteAndPhysicalEverywhere) {
  const auto tables = reference_tables();
  const auto queries = random_queries(30000, 2);
  size_t wrong = 0;
  for (const Answer& answer : ask(*tables, queries, {.multiple_scattering = true, .ground = true}))
    for (size_t b = 0; b < answer.radiance.size(); ++b) {
      const bool ok = std::isfinite(answer.radiance[b]) && answer.radiance[b] >= 0 &&
                      answer.transmittance[b] >= 0 && answer.transmittance[b] <= 1 &&
                      answer.sun_transmittance[b] >= 0 && answer.sun_transmittance[b] <= 1;
      wrong += ok ? 0 : 1;
    }
  EXPECT_EQ(wrong, 0u);
}

TEST_P(AnyAnswer, NoQueriesHaveNoAnswers) { EXPECT_TRUE(ask(*reference_tables(), {}, {}).empty()); }

SKYLAPSE_ON_EVERY_CONTEXT(AnyAnswer);

}  // namespace
}  // namespace skylapse::sky::bruneton
