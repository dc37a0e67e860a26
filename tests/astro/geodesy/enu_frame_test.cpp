#include "astro/geodesy/enu_frame.h"

#include <gtest/gtest.h>

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>
#include <random>

#include "../measured.h"

namespace skylapse::astro::test {
namespace {

EnuFrame frame_at(double latitude, double longitude, double height_m = 0) {
  return enu_frame({latitude * deg, longitude * deg, height_m * metre});
}

std::string place(double latitude, double longitude) {
  return std::to_string(latitude) + " " + std::to_string(longitude);
}

/// Direction to an Earth-fixed point through GeographicLib's own local frame.
Direction<Enu> by_local_cartesian(double lat, double lon, double h, const glm::dvec3& point_m) {
  double point_lat = 0, point_lon = 0, point_h = 0;
  GeographicLib::Geocentric::WGS84().Reverse(point_m.x, point_m.y, point_m.z, point_lat, point_lon,
                                             point_h);
  glm::dvec3 enu;
  GeographicLib::LocalCartesian(lat, lon, h)
      .Forward(point_lat, point_lon, point_h, enu.x, enu.y, enu.z);
  return Direction<Enu>::from_vector(enu);
}

TEST(EnuFrame, AgreesWithLocalCartesianToAMillionthOfAnArcsecAtTheSunsDistance) {
  std::mt19937_64 random(20260621);
  std::uniform_real_distribution<double> unit(-1, 1);
  Largest largest;
  for (int i = 0; i < 2000; ++i) {
    const double lat = i < 20 ? (i % 2 ? 90 : -90) : 90 * unit(random);
    const double lon = 180 * unit(random);
    const double h = 9000 * unit(random);
    const auto direction =
        Direction<EarthFixed>::from_vector({unit(random), unit(random), unit(random)});
    const glm::dvec3 sun_m = direction.vec() * 1.496e11;
    const EnuFrame f = frame_at(lat, lon, h);
    const auto ours = Direction<Enu>::from_vector(f.to_enu(sun_m - f.origin_m));
    largest.see(separation(ours, by_local_cartesian(lat, lon, h, sun_m)).in(arcsec),
                place(lat, lon));
  }
  expect_within(largest, 1e-6, "direction against LocalCartesian, arcsec");
}

TEST(EnuFrame, AxesAreOrthonormalAndRightHandedEverywhere) {
  for (int lat = -90; lat <= 90; lat += 15)
    for (int lon = -720; lon <= 720; lon += 45) {
      const EnuFrame f = frame_at(lat, lon);
      EXPECT_NEAR(glm::length(glm::cross(f.east, f.north) - f.up), 0, 1e-15) << place(lat, lon);
      EXPECT_NEAR(glm::length(f.up), 1, 1e-15) << place(lat, lon);
      EXPECT_NEAR(glm::dot(f.east, f.north), 0, 1e-16) << place(lat, lon);
    }
}

TEST(EnuFrame, TurnsOfLongitudeChangeNothing) {
  for (const double lat : {-90.0, -33.5, 0.0, 48.80921, 90.0}) {
    EXPECT_EQ(frame_at(lat, 180).east, frame_at(lat, -180).east);
    EXPECT_EQ(frame_at(lat, 180).north, frame_at(lat, -180).north);
    EXPECT_EQ(frame_at(lat, 180).origin_m, frame_at(lat, -180).origin_m);
    EXPECT_NEAR(glm::length(frame_at(lat, 14.5).east - frame_at(lat, 374.5).east), 0, 1e-15);
  }
}

TEST(EnuFrame, NorthAtThePolesIsTheLimitAlongTheMeridian) {
  for (const double lon : {0.0, 37.5, 90.0, -120.0, 180.0}) {
    const double a = lon * M_PI / 180;
    EXPECT_NEAR(glm::length(frame_at(90, lon).north - glm::dvec3(-std::cos(a), -std::sin(a), 0)), 0,
                1e-15)
        << lon;
    EXPECT_NEAR(glm::length(frame_at(-90, lon).north - glm::dvec3(std::cos(a), std::sin(a), 0)), 0,
                1e-15)
        << lon;
    EXPECT_NEAR(glm::length(frame_at(90, lon).north - frame_at(89.9999999, lon).north), 0, 2e-9)
        << lon;
  }
}

TEST(EnuFrame, MirrorsInEquatorAndMeridian) {
  const glm::dvec3 v(0.3, -0.5, 0.7);
  for (const double lat : {0.0, 12.5, 66.0, 90.0})
    for (const double lon : {0.0, 33.0, 120.0}) {
      const glm::dvec3 plain = frame_at(lat, lon).to_enu(v);
      const glm::dvec3 south = frame_at(-lat, lon).to_enu({v.x, v.y, -v.z});
      EXPECT_NEAR(glm::length(south - glm::dvec3(plain.x, -plain.y, plain.z)), 0, 1e-15);
      const glm::dvec3 west = frame_at(lat, -lon).to_enu({v.x, -v.y, v.z});
      EXPECT_NEAR(glm::length(west - glm::dvec3(-plain.x, plain.y, plain.z)), 0, 1e-15);
    }
}

}  // namespace
}  // namespace skylapse::astro::test
