#include "core/aabb.h"

#include <utility>

#include <gtest/gtest.h>

namespace touchmark {
namespace {

TEST(Aabb, ComesWithinTheGapToAnotherAndNotWithinLess) {
  const Aabb unit{{0, 0, 0}, {1, 1, 1}};
  for (const int axis : {0, 1, 2}) {
    Aabb other = unit;
    other.min[axis] = 1.5;
    other.max[axis] = 2;
    for (const auto& [a, b] : {std::pair{unit, other}, std::pair{other, unit}}) {
      EXPECT_TRUE(a.comes_within(0.5, b)) << axis;
      EXPECT_FALSE(a.comes_within(0.499, b)) << axis;
    }
  }
}

TEST(Aabb, ComesWithinNothingOfABoxThatItTouchesOrHolds) {
  const Aabb box{{0, 0, 0}, {4, 4, 4}};
  EXPECT_TRUE(box.comes_within(0, {{4, 0, 0}, {5, 1, 1}}));
  EXPECT_TRUE(box.comes_within(0, {{1, 1, 1}, {2, 2, 2}}));
}

TEST(Aabb, TellsAGapThatIsLostInItsCoordinates) {
  // Beside 2^53 the next double is 2 away: a corner moved by the gap would round onto the other box.
  const double far = 0x1p53;
  const Aabb box{{far, 0, 0}, {far, 1, 1}}, other{{far + 2, 0, 0}, {far + 2, 1, 1}};
  EXPECT_FALSE(box.comes_within(1.5, other));
  EXPECT_TRUE(box.comes_within(2, other));
}

TEST(Aabb, ComesNowhereNearAnEmptyBox) {
  const Aabb box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_FALSE(box.comes_within(1e300, Aabb{}));
  EXPECT_FALSE(Aabb{}.comes_within(1e300, box));
}

}  // namespace
}  // namespace touchmark
