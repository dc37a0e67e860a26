// The compass image, looked up as each renderer does: every mark must be found where the renderer
// looks for it. The lookups are the programs' own formulas, not ours.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "image/compass_image.h"
#include "image/orientation.h"

namespace skylapse::image {
namespace {

constexpr double kPi = std::numbers::pi;

/// A position on a map: u to the right, v downwards, both from 0 to 1.
struct MapPosition {
  double u, v;
};

double turn(double u) { return u - std::floor(u); }

/// The published lookup of a direction in the program's world axes; v turned to point down.
MapPosition program_lookup(Orientation orientation, const glm::dvec3& d) {
  switch (orientation) {
    case Orientation::openexr:
    case Orientation::usd:  // refers to OpenEXR
      // ImfEnvmap.cpp, LatLongMap::latLong and pixelPosition: longitude atan2(x, z), +pi at the
      // left edge; latitude +pi/2 at the upper one.
      return {turn(0.5 - std::atan2(d.x, d.z) / (2 * kPi)),
              0.5 - std::atan2(d.y, std::hypot(d.x, d.z)) / kPi};
    case Orientation::blender:
      // Cycles: u = (atan2(y, x) - pi) / (-2 pi); v = (acos(z) - pi) / -pi from below.
      return {turn((std::atan2(d.y, d.x) - kPi) / (-2 * kPi)), std::acos(d.z) / kPi};
    case Orientation::three:
      // equirectUv; v from below, as a texture with flipY has it.
      return {turn(std::atan2(d.z, d.x) / (2 * kPi) + 0.5), 1 - (std::asin(d.y) / kPi + 0.5)};
    case Orientation::gltf: {
      // "The center of the image is where the +X axis points, the top of the image is where the +Y
      // axis points, and moving left in the image is equivalent to a positive rotation about Y":
      // a positive rotation about Y turns +X to -Z.
      const double rotation = std::atan2(-d.z, d.x);
      return {turn(0.5 - rotation / (2 * kPi)), std::acos(d.y) / kPi};
    }
    case Orientation::unreal:
      return {turn((1 + std::atan2(d.x, -d.y) / kPi) / 2), std::acos(d.z) / kPi};
    case Orientation::unity:
      // ToRadialCoords: (0.5, 1) - (atan2(z, x) / (2 pi), acos(y) / pi), v from below.
      return {turn(0.5 - std::atan2(d.z, d.x) / (2 * kPi)), std::acos(d.y) / kPi};
    case Orientation::pbrt:
      return {turn(std::atan2(d.y, d.x) / (2 * kPi)), std::acos(d.z) / kPi};
    case Orientation::mitsuba:
      return {turn(std::atan2(d.x, -d.z) / (2 * kPi)), std::acos(d.y) / kPi};
  }
  return {};
}

struct Mark {
  CompassMark mark;
  glm::dvec3 enu;
};
const std::array<Mark, 6> kMarks{{{CompassMark::north, {0, 1, 0}},
                                  {CompassMark::east, {1, 0, 0}},
                                  {CompassMark::south, {0, -1, 0}},
                                  {CompassMark::west, {-1, 0, 0}},
                                  {CompassMark::up, {0, 0, 1}},
                                  {CompassMark::down, {0, 0, -1}}}};

/// 9 deg from the mark to one side or the other: in its disc of 12 deg, but beside the letter.
glm::dvec3 beside(const glm::dvec3& mark, double way) {
  const glm::dvec3 side =
      std::abs(mark.z) > 0.5 ? glm::dvec3{1, 0, 0} : glm::dvec3{-mark.y, mark.x, 0};
  return glm::normalize(mark + way * std::tan(9 * kPi / 180) * side);
}

glm::vec3 pixel(const FrameBuffer& image, int x, int y) {
  const float* p =
      image.pixel(std::clamp(x, 0, image.width() - 1), std::clamp(y, 0, image.height() - 1));
  return {p[0], p[1], p[2]};
}

Camera map_of(Orientation orientation, Projection projection, int width, int height) {
  Camera camera;
  camera.projection = projection;
  camera.width = width, camera.height = height;
  camera.camera_to_enu = look_at(map_heading(projection, orientation), {}, {});
  return camera;
}

class RendererOrientation : public testing::TestWithParam<Orientation> {};

TEST_P(RendererOrientation, FindsEveryMarkOfALatLongMapWhereItLooksForIt) {
  const FrameBuffer map = compass_image(map_of(GetParam(), Projection::lat_long, 720, 360));
  for (const Mark& m : kMarks)
    for (const double way : {1.0, -1.0}) {
      const glm::dvec3 enu = beside(m.enu, way);
      const MapPosition at = program_lookup(GetParam(), enu_to_world(GetParam()) * enu);
      const double u = convention_of(GetParam()).lat_long_mirrored ? 1 - at.u : at.u;
      EXPECT_EQ(pixel(map, int(u * 720), int(at.v * 360)), compass_color(m.mark))
          << name_of(GetParam()) << ", mark " << int(m.mark);
    }
}

// Marks tell turns by 90 deg apart; this tells any turn, and mirrors.
TEST_P(RendererOrientation, SeesEveryDirectionWithinRounding) {
  const Camera camera = map_of(GetParam(), Projection::lat_long, 720, 360);
  for (double azimuth = 3; azimuth < 360; azimuth += 17)
    for (double elevation = -85; elevation < 90; elevation += 10) {
      const auto d = enu_direction(azimuth * deg, elevation * deg);
      MapPosition at = program_lookup(GetParam(), enu_to_world(GetParam()) * d.vec());
      if (convention_of(GetParam()).lat_long_mirrored) at.u = 1 - at.u;
      const auto seen = direction_at(camera, {at.u * 720, at.v * 360});
      ASSERT_TRUE(seen);
      EXPECT_LT(separation(*seen, d).in(deg), 1e-6) << name_of(GetParam());
    }
}

TEST_P(RendererOrientation, HasOrthonormalAxesOfItsOwnHandedness) {
  const glm::dmat3 m = enu_to_world(GetParam());
  const glm::dmat3 unit = glm::transpose(m) * m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_EQ(unit[i][j], i == j ? 1 : 0);
  const bool left = GetParam() == Orientation::unreal || GetParam() == Orientation::unity;
  EXPECT_EQ(glm::determinant(m), left ? -1 : 1);
}

TEST_P(RendererOrientation, IsFoundByItsName) {
  EXPECT_EQ(orientation_from_name(name_of(GetParam())), GetParam());
  EXPECT_EQ(convention_of(GetParam()).orientation, GetParam());
}

/// OpenGL 4.6, table 8.19: the image that a lookup vector meets, and s, t in [0, 1] from its first
/// texel, the upper left one of a file that is uploaded as it is.
struct CubeTexel {
  int image;
  double s, t;
};
CubeTexel opengl_lookup(const glm::dvec3& r) {
  const glm::dvec3 a = glm::abs(r);
  const auto at = [](int image, double sc, double tc, double ma) {
    return CubeTexel{image, (sc / ma + 1) / 2, (tc / ma + 1) / 2};
  };
  if (a.x >= a.y && a.x >= a.z) return r.x > 0 ? at(0, -r.z, -r.y, a.x) : at(1, r.z, -r.y, a.x);
  if (a.y >= a.z) return r.y > 0 ? at(2, r.x, r.z, a.y) : at(3, r.x, -r.z, a.y);
  return r.z > 0 ? at(4, r.x, -r.y, a.z) : at(5, -r.x, -r.y, a.z);
}

/// ImfEnvmap.cpp, CubeMap::faceAndPixelPosition and pixelPosition, of the same form.
CubeTexel openexr_lookup(const glm::dvec3& d) {
  const glm::dvec3 a = glm::abs(d);
  // Positions in a face run over (1 + ratio) / 2 of these; the file's face orientation follows.
  if (a.x >= a.y && a.x >= a.z) {
    const double x = (d.y / a.x + 1) / 2, y = (d.z / a.x + 1) / 2;
    return d.x > 0 ? CubeTexel{0, y, 1 - x} : CubeTexel{1, 1 - y, 1 - x};
  }
  if (a.y >= a.z) {
    const double x = (d.x / a.y + 1) / 2, y = (d.z / a.y + 1) / 2;
    return d.y > 0 ? CubeTexel{2, x, 1 - y} : CubeTexel{3, x, y};
  }
  const double x = (d.x / a.z + 1) / 2, y = (d.y / a.z + 1) / 2;
  return d.z > 0 ? CubeTexel{4, 1 - x, 1 - y} : CubeTexel{5, x, 1 - y};
}

/// The lookup of the programs that read six images.
CubeTexel program_cube(Orientation orientation, const glm::dvec3& d) {
  if (orientation == Orientation::openexr || orientation == Orientation::usd)
    return openexr_lookup(d);
  // Unity is left-handed itself. three.js: vec3(flipEnvMap * x, y, z), flipEnvMap being -1 for cube
  // textures; glTF has left-handed KTX 2 images in a right-handed world just so.
  return opengl_lookup(orientation == Orientation::unity ? d : glm::dvec3{-d.x, d.y, d.z});
}

class RendererCube : public testing::TestWithParam<Orientation> {};

TEST_P(RendererCube, HoldsEveryDirectionWhereTheProgramLooksItUp) {
  constexpr int kSize = 64;
  const Camera camera = map_of(GetParam(), Projection::cube, kSize, 6 * kSize);
  const auto& faces = faces_in(convention_of(GetParam()).cube_order);
  for (double azimuth = 3; azimuth < 360; azimuth += 17)
    for (double elevation = -85; elevation < 90; elevation += 10) {
      const auto d = enu_direction(azimuth * deg, elevation * deg);
      const auto texel = program_cube(GetParam(), enu_to_world(GetParam()) * d.vec());
      const auto [x, y] = cube_face_origin(camera, faces[texel.image]);
      const auto seen = direction_at(camera, {x + texel.s * kSize, y + texel.t * kSize});
      ASSERT_TRUE(seen);
      EXPECT_LT(separation(*seen, d).in(deg), 1e-6)
          << name_of(GetParam()) << " image " << texel.image;
    }
}

std::string test_name(const testing::TestParamInfo<Orientation>& info) {
  return std::string(name_of(info.param));
}
INSTANTIATE_TEST_SUITE_P(All, RendererOrientation, testing::ValuesIn(kOrientations), test_name);
INSTANTIATE_TEST_SUITE_P(WithCubes, RendererCube,
                         testing::Values(Orientation::openexr, Orientation::usd, Orientation::three,
                                         Orientation::gltf, Orientation::unity),
                         test_name);

TEST(RendererOrientations, AreNotFoundByOtherNames) {
  for (const char* name : {"", "houdini", "Blender", "usd "})
    EXPECT_FALSE(orientation_from_name(name)) << name;
}

// USD's orientToStageUpAxis turns a Y-up dome about X by 90 deg: Y to Z, Z to -Y.
TEST(RendererOrientations, UsdOnAStageWithZUpHasEastAlongXAndNorthAlongY) {
  const auto z_up = [](const glm::dvec3& v) { return glm::dvec3{v.x, -v.z, v.y}; };
  const glm::dmat3 m = enu_to_world(Orientation::usd);
  EXPECT_EQ(z_up(m * glm::dvec3(1, 0, 0)), glm::dvec3(1, 0, 0));
  EXPECT_EQ(z_up(m * glm::dvec3(0, 1, 0)), glm::dvec3(0, 1, 0));
}

}  // namespace
}  // namespace skylapse::image
