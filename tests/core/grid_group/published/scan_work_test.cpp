// The published scan looks at every group and at every member of those that hold the probe: never at more,
// and never at less, however many groups there are.
#include <cmath>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "core/brute_force/brute_force.h"
#include "core/grid_group/published/published_grid_group.h"
#include "tests/core/grid_group/meshes.h"

namespace touchmark {
namespace {

using Shape = PublishedGridGroup::Shape;

bool holds(const Aabb& box, const Vec3& center, double reach) {
  for (int k = 0; k < 3; ++k)
    if (center[k] < box.min[k] - reach || center[k] > box.max[k] + reach) return false;
  return true;
}

bool holds(const Sphere& sphere, const Vec3& center, double reach) {
  return (center - sphere.center).norm() <= sphere.radius + reach;
}

struct Counted {
  std::uint64_t groups = 0;
  std::uint64_t members = 0;  ///< of the groups that hold the probe
};

bool operator==(const Counted& a, const Counted& b) { return a.groups == b.groups && a.members == b.members; }

std::ostream& operator<<(std::ostream& out, const Counted& counted) {
  return out << counted.groups << " groups, " << counted.members << " members";
}

Counted expected(const PublishedGridGroup& scan, const Vec3& center, double reach) {
  Counted counted{scan.groups(), 0};
  for (std::size_t group = 0; group < scan.groups(); ++group) {
    const bool held = scan.boxes().empty() ? holds(scan.spheres()[group], center, reach)
                                           : holds(scan.boxes()[group], center, reach);
    if (held) counted.members += scan.members(group).size();
  }
  return counted;
}

Counted counted(const Work& work) { return {work.cells, work.triangles}; }

template <class Check>
void with_every_count_of_groups(const TriangleMesh& mesh, const Check& check) {
  std::size_t most = 0;
  for (const Shape shape : {Shape::cube, Shape::sphere}) {
    for (const std::size_t groups : {1u, 20u, 300u, 3'000u, 30'000u}) {
      const auto scan = PublishedGridGroup::build(mesh, {shape, 0, groups});
      SCOPED_TRACE(std::to_string(scan.groups()) + (shape == Shape::cube ? " cuboids" : " spheres"));
      most = std::max(most, scan.groups());
      check(scan);
    }
  }
  EXPECT_GT(most, 10 * mesh.size()) << "the counts tried shall go far beyond the number of triangles";
}

TEST(GridGroupScanWork, IsEveryGroupAndTheMembersOfThoseThatHoldAProbeThatTouchesNothing) {
  const TriangleMesh mesh = testing::icosphere(2);
  const BruteForce brute_force = BruteForce::build(mesh);
  with_every_count_of_groups(mesh, [&](const PublishedGridGroup& scan) {
    testing::Random random(71);
    for (int i = 0; i < 40; ++i) {
      const Vec3 center = random.point(1.1);
      BruteForce::Session session;
      // Nothing is in reach, so that no search ends early and none is made again to break a tie.
      const double reach = 0.9 * brute_force.nearest({center, 0}, 10, session)->distance;
      const Counted all = expected(scan, center, reach);
      PublishedGridGroup::Session touches, nearest, sweep;
      EXPECT_FALSE(scan.touches({center, reach}, touches));
      EXPECT_EQ(counted(touches.work), all);
      EXPECT_FALSE(scan.nearest({center, 0}, reach, nearest));
      EXPECT_EQ(counted(nearest.work), all);
      EXPECT_FALSE(scan.first_hit({center, center, reach}, sweep));
      EXPECT_EQ(counted(sweep.work), all);
    }
  });
}

TEST(GridGroupScanWork, IsTheSameWhereATriangleIsNearest) {
  const TriangleMesh mesh = testing::icosphere(2);
  with_every_count_of_groups(mesh, [&](const PublishedGridGroup& scan) {
    for (std::size_t triangle = 0; triangle < mesh.size(); triangle += 9) {
      const Vec3 middle =
          (mesh.corner(triangle, 0) + mesh.corner(triangle, 1) + mesh.corner(triangle, 2)) / 3;
      const Vec3 center = 1.01 * middle;  // above the middle of a face of a convex mesh: no other is as near
      PublishedGridGroup::Session session;
      const std::optional<Contact> contact = scan.nearest({center, 0}, 0.2, session);
      ASSERT_TRUE(contact);
      EXPECT_EQ(contact->triangle, triangle);
      EXPECT_EQ(counted(session.work), expected(scan, center, 0.2));
    }
  });
}

}  // namespace
}  // namespace touchmark
