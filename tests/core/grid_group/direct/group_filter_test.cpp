/// Both ways of the group filter: the processor's own and the portable one.
#include "core/grid_group/direct/group_filter.h"

#include <bit>
#include <vector>

#include <gtest/gtest.h>

#include "core/grid_group/direct/triangle_store.h"
#include "tests/core/grid_group/meshes.h"

namespace touchmark::grid {
namespace {

using touchmark::testing::Random;

struct RandomGroup {
  std::vector<std::uint32_t> places;
  std::size_t count;
};

RandomGroup some_group(const TriangleStore& store, Random& random) {
  RandomGroup group{{}, 1 + random.below(Groups::max_members)};
  while (group.places.size() < group.count) group.places.push_back(random.below(store.size()));
  group.places.resize(Groups::rounded_up(group.count), group.places.back());
  return group;
}

Vec3 some_point(const TriangleStore& store, Random& random) {
  const PreparedTriangle& triangle = store.exact[random.below(store.size())];
  const Vec3 middle = (triangle.corner[0] + triangle.corner[1] + triangle.corner[2]) / 3;
  return random.below(4) == 0 ? middle : Vec3(middle + random.point(0.2));
}

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }

TEST(GroupFilter, GivesTheSameBitsOnEveryProcessor) {
  for (const TriangleMesh& mesh : {touchmark::testing::soup(700, 0.15, 5), touchmark::testing::plate(16),
                                   touchmark::testing::sliver_fan(400)}) {
    const TriangleStore store = TriangleStore::build(mesh);
    Random random(3);
    int over = 0;
    for (int step = 0; step < 5000; ++step) {
      const RandomGroup group = some_group(store, random);
      const FilterPoint point = store.frame.point(some_point(store, random));
      const GroupBounds chosen = filter_group(store.planes.data(), group.places.data(), group.count, point);
      const GroupBounds portable =
          filter_group_portably(store.planes.data(), group.places.data(), group.count, point);
      for (std::size_t i = 0; i < group.count; ++i)
        ASSERT_EQ(bits(chosen.squared[i / 4][i % 4]), bits(portable.squared[i / 4][i % 4])) << step;
      ASSERT_EQ(bits(chosen.least), bits(portable.least)) << step;
      ASSERT_EQ(chosen.over_face, portable.over_face) << step;
      ASSERT_EQ(bits(chosen.height), bits(portable.height)) << step;
      ASSERT_EQ(chosen.guess, portable.guess) << step;
      over += chosen.over_face ? 1 : 0;
    }
    EXPECT_GT(over, 0);
    EXPECT_LT(over, 5000);
  }
}

TEST(GroupFilter, BoundsEveryMembersDistanceFromBelow) {
  const TriangleStore store = TriangleStore::build(touchmark::testing::soup(700, 0.15, 5));
  Random random(4);
  for (int step = 0; step < 5000; ++step) {
    const RandomGroup group = some_group(store, random);
    const Vec3 center = some_point(store, random);
    const GroupBounds bounds =
        filter_group(store.planes.data(), group.places.data(), group.count, store.frame.point(center));
    for (std::size_t i = 0; i < group.count; ++i) {
      const double squared = squared_distance(store.exact[group.places[i]], center);
      ASSERT_LE(bounds.squared[i / 4][i % 4], store.frame.limit(squared)) << step;
      ASSERT_LE(bounds.least, store.frame.limit(squared)) << step;
    }
  }
}

}  // namespace
}  // namespace touchmark::grid
