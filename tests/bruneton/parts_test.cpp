// The pieces that the twin and the GPU share.
#include <gtest/gtest.h>

#include <cmath>

#include "bruneton/twins.h"
#include "sky/bruneton/columns.h"
#include "sky/bruneton/harmonics.h"
#include "sky/bruneton/march_lists.h"
#include "sky/bruneton/order_tail.h"
#include "sky/bruneton/sun_rows.h"

namespace skylapse::sky::bruneton {
namespace {

using text::PI;

TEST(GaussNodes, IntegratePolynomialsUpToTwiceTheirNumberExactly) {
  for (const int count : {1, 2, 5, 16, 33}) {
    double sum = 0;
    for (const glm::dvec2& node : gauss_nodes(count))
      sum += node.y * std::pow(node.x, 2 * count - 1);
    EXPECT_NEAR(sum, 1.0 / (2 * count), 1e-14) << count;
  }
}

TEST(PhaseFunctions, IntegrateToOneAndHaveTheirClosedMoments) {
  for (const double g : {-0.5, 0.0, 0.8, 0.95, 0.99})
    for (const double rho : {0.0, 0.03, 0.5}) {
      atmosphere::Medium medium = atmosphere::reference_medium();
      medium.aerosol_g = g;
      medium.rayleigh_depolarization = rho;
      const PhysicsData data = physics_data(medium, Settings{}, 2);
      Geometry text(data);
      const std::vector<double> aerosol = aerosol_moments(g, 3), air = rayleigh_moments(rho, 3);
      std::vector<double> aerosol_sum(4), air_sum(4);
      // Nodes gather at nu = 1, where g = 0.99 is 2e4 times its mean.
      for (const glm::dvec2& node : gauss_nodes(400)) {
        const double away = 2 * std::pow(node.x, 6), nu = 1 - away;
        const double weight = 2 * PI * 12 * std::pow(node.x, 5) * node.y;
        const double legendre[4] = {1, nu, (3 * nu * nu - 1) / 2, (5 * nu * nu - 3) * nu / 2};
        for (int l = 0; l < 4; ++l) {
          aerosol_sum[l] += weight * text.aerosol_phase(nu) * legendre[l];
          air_sum[l] += weight * text.rayleigh_phase(nu) * legendre[l];
        }
      }
      for (int l = 0; l < 4; ++l) {
        EXPECT_NEAR(aerosol_sum[l], aerosol[l], 1e-6) << g << ' ' << l;
        EXPECT_NEAR(air_sum[l], air[l], 1e-9) << rho << ' ' << l;
      }
    }
}

TEST(Harmonics, AreOrthonormal) {
  constexpr int kDegree = 9, kAzimuths = 12;
  const HarmonicIndex index{kDegree};
  std::vector<std::vector<double>> products(index.count(), std::vector<double>(index.count()));
  for (const glm::dvec2& node : gauss_nodes(kDegree + 1)) {
    const std::vector<double> factors = legendre_factors(kDegree, 2 * node.x - 1);
    for (int a = 0; a < kAzimuths; ++a) {
      const double phi = PI * (a + 0.5) / kAzimuths;
      for (int m1 = 0; m1 <= kDegree; ++m1)
        for (int l1 = m1; l1 <= kDegree; ++l1)
          for (int m2 = 0; m2 <= kDegree; ++m2)
            for (int l2 = m2; l2 <= kDegree; ++l2)
              products[index.at(l1, m1)][index.at(l2, m2)] +=
                  2 * node.y * (2 * PI / kAzimuths) * factors[index.at(l1, m1)] *
                  std::cos(m1 * phi) * factors[index.at(l2, m2)] * std::cos(m2 * phi);
    }
  }
  for (int i = 0; i < index.count(); ++i)
    for (int j = 0; j < index.count(); ++j)
      EXPECT_NEAR(products[i][j], i == j ? 1 : 0, 1e-12) << i << ' ' << j;
}

TEST(SunRows, UpsamplingKeepsNodesAndNeverOvershoots) {
  Settings settings;
  settings.suns = 6;
  settings.sun_rows_per_interval = 4;
  const std::vector<double> nodes{1, 1, 5, 0.1, 0.001, 0};
  std::vector<double> rows(settings.sun_rows());
  upsample_suns(nodes.data(), 1, rows.data(), 1, 1, settings, true);
  for (int i = 0; i < settings.suns; ++i) EXPECT_EQ(rows[i * 4], nodes[i]);
  for (int row = 0; row < settings.sun_rows(); ++row) {
    const int i = std::min(row / 4, settings.suns - 2);
    EXPECT_GE(rows[row], std::min(nodes[i], nodes[i + 1])) << row;
    EXPECT_LE(rows[row], std::max(nodes[i], nodes[i + 1])) << row;
  }
}

TEST(SunWarp, OfEarthsAirIsThatOfTheMeasuredScheme) {
  const SunWarp warp = sun_warp(atmosphere::reference_medium());
  EXPECT_NEAR(warp.centre_rad * 180 / PI, 94, 0.2);
  EXPECT_NEAR(warp.width_rad * 180 / PI, 5, 0.1);
  EXPECT_NEAR(warp.end_rad * 180 / PI, 114.8, 0.5);
  EXPECT_TRUE(warp.dark_end);
}

TEST(SunWarp, OfASmallPlanetReachesItsMidnight) {
  atmosphere::Medium medium = atmosphere::reference_medium();
  medium.bottom_radius_km = 400;
  const SunWarp warp = sun_warp(medium);
  EXPECT_DOUBLE_EQ(warp.end_rad, PI);
  EXPECT_FALSE(warp.dark_end);
  EXPECT_NEAR(warp.zenith_at(1), PI, 1e-12);
  EXPECT_NEAR(warp.zenith_at(0), 0, 1e-12);
}

/// What a bilinear lookup may be off: 1.5 % where a layer's edge lies between two heights, which
/// is 0.1 % of light (SingleScattering); 0.2 % of the air's own column near the ground.
TEST(Columns, OfTheTableAgreeWithQuadrature) {
  const Columns columns(atmosphere::reference_medium());
  PhysicsData data = physics_data(columns.medium(), Settings{}, 2);
  data.columns = columns.nodes().data();
  Geometry text(data);
  for (const double h : {0.0, 0.001, 0.3, 2.0, 11.0, 26.0, 59.0})
    for (const double share : {0.0, 1e-4, 0.01, 0.1, 0.4, 1.0}) {
      const double horizon = text.horizon_mu(h), mu = horizon + (1 - horizon) * share;
      const glm::dvec3 exact = columns.paths().columns_to_top(h, mu);
      const glm::dvec3 table = text.columns_to_top(h, mu);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(table[c], exact[c], 0.015 * exact[c] + 0.01) << h << ' ' << mu;
      if (h < 1) {
        EXPECT_NEAR(table.x, exact.x, 0.002 * exact.x) << h << ' ' << mu;
      }
    }
}

TEST(Geometry, HeightsAlongARayMatchTheLawOfCosines) {
  const PhysicsData data = physics_data(atmosphere::reference_medium(), Settings{}, 2);
  Geometry text(data);
  const long double R = 6360;
  for (const double h : {0.0, 1e-5, 0.001, 10.0})
    for (const double mu : {-0.01, 0.0, 1e-6, 0.3, 1.0})
      for (const double t : {1e-3, 1.0, 20.0}) {
        const long double r = R + h;
        const long double there = std::sqrt(r * r + 2 * r * mu * t + (long double)(t)*t) - R;
        if (there < 0) continue;
        EXPECT_NEAR(text.height_along(h, mu, t), double(there), 1e-12 + 1e-12 * double(there));
      }
}

TEST(MarchLists, LoseAsMuchLightAsTheirRayTakesAway) {
  atmosphere::Medium medium = conservative_medium(0);
  medium.bands[0].aerosol_extinction_per_km *= 300;
  medium.bands[0].aerosol_scattering_per_km *= 300;
  const Columns columns(medium);
  const Settings settings = settings_for(Level::draft, medium);
  const MarchLists lists = march_lists(columns, settings, settings.samples);
  for (size_t i = 0; i < lists.rays.size(); ++i) {
    const MarchRay& ray = lists.rays[i];
    double scattered = 0;
    for (int s = ray.first; s < ray.first + ray.count; ++s)
      scattered += lists.scattering_weight(s, 0);
    if (ray.hits_ground) {
      EXPECT_NEAR(scattered + lists.ground_transmittance[i], 1, 1e-9) << i;
    } else {
      EXPECT_LE(scattered, 1 + 1e-9) << i;
    }
  }
}

TEST(OrderTail, SumsAGeometricSeries) {
  Settings settings;
  settings.heights = 1;
  settings.suns = 2;
  settings.sun_rows_per_interval = 1;
  settings.stop_below = 0.01;
  OrderTail tail(settings);
  double sum = 0, order = 1;
  for (; !tail.done(); order *= 0.6) {
    tail.add(OrderSums(2, glm::dvec4(order)));
    sum += order;
  }
  order /= 0.6;
  EXPECT_LT(order / sum, 0.01);
  EXPECT_NEAR(sum + order * tail.tail_factors()[0].x, 1 / (1 - 0.6), 1e-12);
}

}  // namespace
}  // namespace skylapse::sky::bruneton
