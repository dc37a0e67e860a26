#include "sky/sun_disc.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "image/camera/chart.h"
#include "image/irradiance.h"
#include "sun_disc_cameras.h"

namespace skylapse::sky {
namespace {

using image::Camera;
using image::CubeLayout;
using image::look_at;
using enum image::Projection;

constexpr double kPi = std::numbers::pi;

double worst_relative(const glm::dvec3& value, const glm::dvec3& expected) {
  double worst = 0;
  for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(value[c] / expected[c] - 1));
  return worst;
}

SunDisc uniform_sun(Angle azimuth, Angle elevation, Angle radius = kTestRadius) {
  return {enu_direction(azimuth, elevation), radius, [](Angle, double) { return glm::dvec3{1}; }};
}

// ---- the reference energy

TEST(DiscEnergy, OfAUniformDiscIsItsSolidAngle) {
  for (const double radius : {0.05, 0.2666, 5.0})
    for (const double el : {10.0, 45.0, 89.9, 90.0}) {
      const auto e = disc_energy(uniform_sun({}, el * deg, radius * deg));
      const double r = radius * kPi / 180;
      EXPECT_NEAR(e.normal_irradiance.x / (4 * kPi * std::pow(std::sin(r / 2), 2)), 1, 1e-9);
      // The projected solid angle of a whole disc, in closed form.
      const double projected = kPi * std::pow(std::sin(r), 2) * std::sin(el * kPi / 180);
      EXPECT_NEAR(e.horizontal_irradiance.x / projected, 1, 1e-9);
    }
}

TEST(DiscEnergy, OfTheHalfDiscOnTheHorizonIsHalf) {
  const auto e = disc_energy(uniform_sun(70 * deg, {}));
  const double r = kTestRadius.in(rad);
  EXPECT_NEAR(e.normal_irradiance.y / (2 * kPi * std::pow(std::sin(r / 2), 2)), 1, 1e-9);
  // Integral of sin^2(gamma) dgamma sin(phi) dphi; the difference cancels to 1e-11 relative.
  EXPECT_NEAR(e.horizontal_irradiance.y / (r - std::sin(r) * std::cos(r)), 1, 1e-9);
}

TEST(DiscEnergy, WithoutLimbDarkeningIsTheSame) {
  // Where the radiance does not change with elevation the flux is exactly kept.
  for (const double alpha : {0.0, 0.2, 0.72, 1.5}) {
    SunDisc disc = test_sun({}, 20 * deg);
    disc.radiance = [=](Angle, double m) { return glm::dvec3{std::pow(m, alpha)}; };
    const auto darkened = disc_energy(disc);
    disc.radiance = without_limb_darkening(disc.radiance);
    EXPECT_EQ(disc.radiance(20 * deg, 0.1), disc.radiance(20 * deg, 0.9));
    // The disc is flat to the square of its radius, 2e-5.
    EXPECT_LT(worst_relative(disc_energy(disc).normal_irradiance, darkened.normal_irradiance),
              3e-5);
  }
}

TEST(DiscEnergy, OfAFlattenedEvenDiscIsItsShareOfTheRoundOnes) {
  // dOmega = cos(lambda) dlambda dpsi, and flattening multiplies psi: exact at any radius.
  for (const double k : {0.83, 0.95, 0.9994})
    for (const double radius : {0.2666, 5.0})
      for (const double el : {10.0, 45.0, 80.0}) {
        SunDisc disc = uniform_sun({}, el * deg, radius * deg);
        const double round = disc_energy(disc).normal_irradiance.x;
        disc.flattening = k;
        EXPECT_NEAR(disc_energy(disc).normal_irradiance.x / round, k, 1e-9) << el;
      }
}

TEST(DiscEnergy, OfAFlattenedDiscBelowTheLevelIsTheSameAsAtIt) {
  // The same disc cut in the same place, by the two ways to integrate it: turned about the axis at
  // right angles to its vertical plane, all but the horizontal irradiance is the same. The horizon
  // is straight at the level and a small circle below: 0.1 deg down that is 1e-6 of a disc.
  for (const double k : {0.83, 0.97})
    for (const double cut : {-0.15, 0.0, 0.1}) {
      SunDisc level = test_sun({}, cut * deg), dipped = test_sun({}, (cut - 0.1) * deg);
      level.flattening = dipped.flattening = k;
      level.radiance = dipped.radiance = [](Angle, double m) { return glm::dvec3{std::sqrt(m)}; };
      dipped.horizon = -0.1 * deg;
      EXPECT_LT(worst_relative(disc_energy(dipped).normal_irradiance,
                               disc_energy(level).normal_irradiance),
                2e-5)
          << k << " " << cut;
    }
}

TEST(SunDisc, AFlattenedDiscKeepsItsFluxAndItsHeight) {
  Camera camera;
  camera.projection = perspective;
  camera.width = camera.height = 96;
  camera.field_of_view = 1 * deg;
  camera.camera_to_enu = look_at(90 * deg, 0.5 * deg, {});
  SunDisc disc = uniform_sun(90 * deg, 0.5 * deg);
  disc.flattening = 0.83;
  const auto projected = project_sun_disc(camera, disc);
  EXPECT_LT(worst_relative(projected.energy.normal_irradiance, disc_energy(disc).normal_irradiance),
            1e-9);
  int top = 96, bottom = 0, left = 96, right = 0;
  for (const PixelAddition& p : projected.pixels) {
    if (p.radiance.x < 0.5) continue;  // the pixel's centre is inside
    top = std::min(top, p.y), bottom = std::max(bottom, p.y);
    left = std::min(left, p.x), right = std::max(right, p.x);
  }
  const double width = 2 * kTestRadius.in(deg)*96;
  EXPECT_NEAR(right - left + 1, width, 1.01);  // a pixel more or less
  EXPECT_NEAR(bottom - top + 1, 0.83 * width, 1.01);
}

TEST(DiscEnergy, IsNothingBelowTheHorizon) {
  for (const double el : {-0.2667, -1.0, -90.0}) {
    const auto e = disc_energy(test_sun(10 * deg, el * deg));
    EXPECT_EQ(e.normal_irradiance, glm::dvec3{0});
    EXPECT_EQ(e.horizontal_irradiance, glm::dvec3{0});
  }
}

TEST(DiscPoints, HaveTheEnergyOfTheDiscAndLieOnIt) {
  for (const double horizon : {0.0, -0.1})
    for (const double flattening : {1.0, 0.85})
      for (const double el : {-0.2, -0.05, 0.0, 0.15, 3.0, 60.0, 90.0}) {
        SunDisc disc = test_sun(210 * deg, el * deg);
        disc.horizon = horizon * deg;
        disc.flattening = flattening;
        const DiscEnergy energy = disc_energy(disc);
        DiscEnergy sum;
        glm::dvec3 middle{0};
        for (const auto& [direction, irradiance] : disc_points(disc)) {
          sum.normal_irradiance += irradiance;
          sum.horizontal_irradiance += irradiance * std::max(0.0, direction.z());
          middle += direction.vec() * irradiance.g;
          ASSERT_LT(separation(direction, disc.centre), disc.radius + 1e-9 * rad);
          ASSERT_LE(4 * haversine_in_disc(disc, direction), std::pow(disc.radius.in(rad), 2));
          ASSERT_GT(elevation(direction), disc.horizon - 1e-9 * rad);
        }
        if (energy.normal_irradiance.g == 0) {
          EXPECT_EQ(sum.normal_irradiance.g, 0);
          continue;
        }
        EXPECT_LT(worst_relative(sum.normal_irradiance, energy.normal_irradiance), 1e-12) << el;
        EXPECT_NEAR(sum.horizontal_irradiance.g, energy.horizontal_irradiance.g,
                    1e-9 * energy.normal_irradiance.g);
        if (el < 60) continue;  // lower, the air dims the lower limb
        EXPECT_LT(separation(Direction<Enu>::from_vector(middle), disc.centre).in(arcsec), 5);
      }
}

// Independent sum over a fine grid of elevation and azimuth.
TEST(DiscEnergy, AgreesWithAGridWhereTheHorizonCutsTheDisc) {
  const double r = kTestRadius.in(rad);
  for (const double el : {-0.2, -0.05, 0.0, 0.1, 0.25, 0.4}) {
    const SunDisc sun = test_sun({}, el * deg);
    const int n = 1000;
    const double low = std::max(0.0, el * kPi / 180 - r), high = el * kPi / 180 + r;
    const double row = (high - low) / n, column = 2 * r / n;
    glm::dvec3 normal{0}, horizontal{0};
    for (int i = 0; i < n; ++i) {
      const double e = low + (i + 0.5) * row;
      for (int j = 0; j < n; ++j) {
        const auto d = enu_direction((-r + (j + 0.5) * column) * rad, e * rad);
        const double q = std::sin(separation(d, sun.centre).in(rad)) / std::sin(r);
        if (q >= 1) continue;
        const glm::dvec3 light =
            row * column * std::cos(e) * test_radiance(e * rad, std::sqrt(1 - q * q));
        normal += light;
        horizontal += light * std::sin(e);
      }
    }
    const DiscEnergy energy = disc_energy(sun);
    // The grid's own error is that of its cells at the limb, about n^(-3/2).
    EXPECT_LT(worst_relative(energy.normal_irradiance, normal), 2e-4) << el;
    EXPECT_LT(worst_relative(energy.horizontal_irradiance, horizontal), 2e-4) << el;
  }
}

// ---- energy in the picture

/// Adds the disc to a picture and takes it off again: one buffer serves sizes up to 8192.
DiscEnergy energy_in_picture(const Camera& camera, const SunDisc& sun) {
  const ProjectedDisc disc = project_sun_disc(camera, sun);
  DiscEnergy energy;
  for (const auto& [x, y, radiance] : disc.pixels) {
    // What a reader of the file does: float radiance, the pixel's solid angle, the centre's sine.
    const glm::dvec3 light =
        glm::dvec3(glm::vec3(radiance)) * pixel_solid_angle(camera, x, y).in(sr);
    const auto d = direction_at(camera, {x + 0.5, y + 0.5});
    EXPECT_TRUE(d) << x << ' ' << y;
    if (!d) continue;
    energy.normal_irradiance += light;
    energy.horizontal_irradiance += light * std::max(0.0, d->z());
  }
  return energy;
}

class EveryWidth : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(SunDisc, EveryWidth, testing::Values(64, 128, 256, 1024, 8192));

TEST_P(EveryWidth, FluxIsKeptAtAnyPlaceInEveryProjection) {
  const int width = GetParam();
  std::mt19937 rng(width);
  std::uniform_real_distribution<double> uniform;
  for (const double el : {-0.15, 0.0, 0.1, 0.27, 2.0, 30.0, 89.9})
    for (int k = 0; k < (width > 1024 ? 1 : 5); ++k) {
      const Angle azimuth = 360 * uniform(rng) * deg;
      const SunDisc sun = test_sun(azimuth, el * deg);
      const DiscEnergy reference = disc_energy(sun);
      for (const auto& [name, camera, fisheye] : cameras_around(width, azimuth, el * deg)) {
        const DiscEnergy energy = energy_in_picture(camera, sun);
        // Asked for: 1e-3. What is left is the float pixels' rounding.
        EXPECT_LT(worst_relative(energy.normal_irradiance, reference.normal_irradiance), 1e-6)
            << name << " elevation " << el << " azimuth " << azimuth.in(deg);
      }
    }
}

TEST_P(EveryWidth, GroundIrradianceIsKeptFromTwoPixelsAboveTheHorizon) {
  const int width = GetParam();
  std::mt19937 rng(width + 1);
  std::uniform_real_distribution<double> uniform;
  for (const double pixels_up : {2.0, 2.3, 3.0, 10.0, 1000.0})
    for (int k = 0; k < (width > 1024 ? 1 : 4); ++k) {
      const Angle azimuth = 360 * uniform(rng) * deg;
      for (size_t c = 0; c < cameras_around(width, {}, {}).size(); ++c) {
        // The elevation hangs on the camera's pixels, the camera on the elevation: two rounds.
        Angle el = 2 * deg;
        for (int round = 0; round < 3; ++round) {
          const Camera camera = cameras_around(width, azimuth, el)[c].camera;
          const auto centre = to_camera_frame(camera, enu_direction(azimuth, el));
          el = std::min(85 * deg, pixels_up * pixel_extent(camera, centre, kTestRadius).y);
        }
        const auto [name, camera, fisheye] = cameras_around(width, azimuth, el)[c];
        if (fisheye && width < 128) continue;
        const SunDisc sun = test_sun(azimuth, el);
        const DiscEnergy energy = energy_in_picture(camera, sun), reference = disc_energy(sun);
        EXPECT_LT(worst_relative(energy.horizontal_irradiance, reference.horizontal_irradiance),
                  5e-3)
            << name << " elevation " << el.in(deg) << " azimuth " << azimuth.in(deg);
      }
    }
}

TEST_P(EveryWidth, PixelsAreNeitherNegativeNorBrighterThanTheDisc) {
  const int width = GetParam();
  std::mt19937 rng(width + 2);
  std::uniform_real_distribution<double> uniform;
  for (const double el : {-0.2, 0.05, 0.27, 1.0, 40.0, 89.8}) {
    const Angle azimuth = 360 * uniform(rng) * deg;
    const glm::dvec3 brightest = test_radiance((el + 0.27) * deg, 1);
    for (const auto& [name, camera, fisheye] : cameras_around(width, azimuth, el * deg))
      for (const auto& [x, y, radiance] :
           project_sun_disc(camera, test_sun(azimuth, el * deg)).pixels)
        for (int c = 0; c < 3; ++c) {
          ASSERT_GE(radiance[c], 0) << name << ' ' << el;
          // Light of the row below the horizon moves up: at most half a row more.
          ASSERT_LE(radiance[c], 1.6 * brightest[c]) << name << ' ' << el;
        }
  }
}

TEST(SunDisc, EnergyReportedIsTheEnergyOfTheImage) {
  for (const double el : {0.0, 0.3, 30.0})
    for (const auto& [name, camera, fisheye] : cameras_around(256, 100 * deg, el * deg)) {
      image::FrameBuffer picture(camera.width, camera.height);
      const DiscEnergy energy = add_sun_disc(camera, test_sun(100 * deg, el * deg), picture);
      const auto flux = image_flux(camera, picture);
      EXPECT_LT(worst_relative(flux.total, energy.normal_irradiance), 1e-6) << name;
      EXPECT_LT(worst_relative(flux.horizontal_irradiance, energy.horizontal_irradiance), 1e-6)
          << name;
    }
}

TEST(SunDisc, IsAddedToWhatIsThere) {
  const auto camera = cameras_around(128, 100 * deg, 5 * deg)[3].camera;
  image::FrameBuffer picture(camera.width, camera.height);
  std::fill(picture.data().begin(), picture.data().end(), 7.0F);
  add_sun_disc(camera, test_sun(100 * deg, 5 * deg), picture);
  EXPECT_EQ(picture.pixel(0, 0)[1], 7.0F);
  const auto centre = position_of(camera, enu_direction(100 * deg, 5 * deg));
  EXPECT_GT(picture.pixel(int(centre->x), int(centre->y))[1], 1e5F);
}

// ---- its place

TEST(SunDisc, CentroidIsTheSunsDirection) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> uniform;
  for (const int width : {64, 1024})
    for (int k = 0; k < 6; ++k) {
      const Angle azimuth = 360 * uniform(rng) * deg, el = (20 + 40 * uniform(rng)) * deg;
      for (const auto& [name, camera, fisheye] : cameras_around(width, azimuth, el)) {
        const SunDisc sun = uniform_sun(azimuth, el);
        glm::dvec3 sum{0};
        for (const auto& [x, y, radiance] : project_sun_disc(camera, sun).pixels)
          sum += radiance.x * pixel_solid_angle(camera, x, y)
                                  .in(sr)*direction_at(camera, {x + 0.5, y + 0.5})
                                  ->vec();
        const auto extent = pixel_extent(camera, to_camera_frame(camera, sun.centre), sun.radius).y;
        // Within a pixel of angle h the grid's directions bend by up to 2 h (a cube's corner), so a
        // tent misses the place by h / 4, twice that across a cube's edge; the tilt that sets the
        // ground's irradiance may add as much again (0.7 h in all measured). The limb's light is
        // put at the middle of its cells: 1/16 of the radius, 0.003 pixels measured.
        EXPECT_LT(separation(Direction<Enu>::from_vector(sum), sun.centre) / extent,
                  extent.in(rad) + 5e-3)
            << name << ' ' << width;
      }
    }
}

TEST(SunDisc, LeavesPixelsBelowTheHorizonAlone) {
  for (const int width : {64, 256, 1024})
    for (const double el : {-0.2, 0.0, 0.1, 0.3, 1.0})
      for (const auto& [name, camera, fisheye] : cameras_around(width, 33 * deg, el * deg))
        for (const auto& [x, y, radiance] :
             project_sun_disc(camera, test_sun(33 * deg, el * deg)).pixels) {
          const auto d = direction_at(camera, {x + 0.5, y + 0.5});
          ASSERT_GT(image::horizon_coverage(elevation(*d), pixel_solid_angle(camera, x, y)), 0)
              << name << ' ' << width << ' ' << el;
        }
}

TEST(SunDisc, LargeDiscIsSmoothInside) {
  // 90 and 9 pixels across, uniform: interior pixels show the disc's radiance.
  for (const double fov : {1.5, 15.0}) {
    const Camera camera{perspective, 256, 256, fov * deg, {}, look_at(10 * deg, 20 * deg, {})};
    const SunDisc sun = uniform_sun(10.1 * deg, 20.05 * deg);
    int inside = 0;
    for (const auto& [x, y, radiance] : project_sun_disc(camera, sun).pixels) {
      const auto d = direction_at(camera, {x + 0.5, y + 0.5});
      if (separation(*d, sun.centre) > sun.radius - 2 * fov / 256 * deg) continue;
      ++inside;
      ASSERT_NEAR(radiance.x, 1, 2e-3) << x << ' ' << y;
    }
    EXPECT_GT(inside, 20);
  }
}

TEST(SunDisc, ChannelsOutsideTheGamutKeepTheirFlux) {
  // A deep red sun in a small gamut: blue negative, green passing through zero across the disc.
  const SunDisc sun{enu_direction(40 * deg, 3 * deg), kTestRadius, [](Angle e, double m) {
                      return (0.5 + 0.5 * m) * glm::dvec3{1, e.in(deg)-3.0001, -0.2};
                    }};
  const auto reference = disc_energy(sun);
  for (const auto& [name, camera, fisheye] : cameras_around(512, 40 * deg, 3 * deg)) {
    const auto energy = project_sun_disc(camera, sun).energy;
    const double scale = reference.normal_irradiance.x;
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(energy.normal_irradiance[c] / scale, reference.normal_irradiance[c] / scale, 1e-9)
          << name << ' ' << c;
  }
}

}  // namespace
}  // namespace skylapse::sky
