// Colours of different spaces do not mix: proved at compile time, with a positive case beside.
#include <gtest/gtest.h>

#include "color/rgb_space.h"

namespace skylapse::color {
namespace {

template <class A, class B>
concept Addable = requires(A a, B b) {
  a + b;
};
template <class A>
concept Scalable = requires(A a) {
  2.0 * a;
};

static_assert(Addable<Color<Xyz>, Color<Xyz>>);
static_assert(Addable<Color<SceneRgb>, Color<SceneRgb>>);
static_assert(!Addable<Color<Xyz>, Color<SceneRgb>>);
static_assert(!Addable<Color<Xyz>, double>);
static_assert(!std::is_convertible_v<Color<Xyz>, Color<SceneRgb>>);
static_assert(Scalable<Color<Xyz>>);

TEST(ColorTypes, SumsAndScalingsStayInTheirSpace) {
  const Color<Xyz> sum = Color<Xyz>{{1, 2, 3}} + 2.0 * Color<Xyz>{{1, 1, 1}};
  EXPECT_EQ(sum.value, glm::dvec3(3, 4, 5));
}

}  // namespace
}  // namespace skylapse::color
