// Where doubles say for certain that two triangles are equally near because they share their nearest point:
// the oracle agrees wherever they say so, and they say so wherever the point is well off the borders.
#include "core/search/ties/shared_nearest.h"

#include <vector>

#include <gtest/gtest.h>

#include "bench/experiments/stress/near_ties.h"
#include "bench/oracle/oracle.h"
#include "tests/bench/oracle/corner_case_meshes.h"

namespace touchmark {
namespace {

PreparedTriangle prepared(const CornerCases::Corners& t) { return prepare(t[0], t[1], t[2], 0); }

/// In either order: beside a border the one may be certain where the other is not.
bool share(const CornerCases::Corners& a, const CornerCases::Corners& b, const Vec3& point) {
  return surely_share_nearest(prepared(a), prepared(b), point) ||
         surely_share_nearest(prepared(b), prepared(a), point);
}

/// As whoever has measured the first asks.
bool share_corner(const CornerCases::Corners& a, const CornerCases::Corners& b, const Vec3& point) {
  return surely_share_corner(prepared(a), prepared(b), point, offset_from(prepared(a), point).vector);
}

/// The oracle names the first of exact ties.
bool are_equally_near(const CornerCases::Corners& a, const CornerCases::Corners& b, const Vec3& point) {
  const TriangleMesh one = mesh_of({a, b}), other = mesh_of({b, a});
  return bench::oracle::Oracle(one, 1).solve(point).triangle == 0 &&
         bench::oracle::Oracle(other, 1).solve(point).triangle == 0;
}

const Vec3 p(0, 0, 0), q(1, 0, 0), left(0.5, 1, -0.25), right(0.5, -1, -0.25);

TEST(SharedFeature, IsTheRidgeThatThePointIsOver) {
  EXPECT_TRUE(share({p, q, left}, {q, p, right}, {0.4, 0.01, 0.5}));
  EXPECT_TRUE(share({q, left, p}, {right, q, p}, {0.9, 0, 3}));
}

TEST(SharedFeature, IsTheEndOfTheRidge) {
  EXPECT_TRUE(share({p, q, left}, {q, p, right}, {-0.4, 0, 0.5}));
  EXPECT_TRUE(share({p, q, left}, {right, q, p}, {1.4, 0.1, 0.2}));
  EXPECT_TRUE(share({p, q, left}, {p, right, Vec3(-1, -1, -1)}, {-0.2, -0.1, 4}));
  EXPECT_TRUE(share_corner({p, q, left}, {q, p, right}, {-0.4, 0, 0.5}));
  EXPECT_TRUE(share_corner({p, q, left}, {right, q, p}, {1.4, 0.1, 0.2}));
  EXPECT_FALSE(share_corner({p, q, left}, {q, p, right}, {0.4, 0.01, 0.5})) << "beside the ridge";
}

TEST(SharedFeature, IsNoneOverAFaceOrOnABorder) {
  EXPECT_FALSE(share({p, q, left}, {q, p, right}, {0.5, 0.5, 0.5})) << "over a face";
  EXPECT_FALSE(share({p, q, left}, {q, p, right}, {0, 0, 0.5})) << "where the ridge ends";
  EXPECT_FALSE(share({p, q, Vec3(0, 1, 0)}, {q, p, Vec3(0, -1, 0)}, {0.5, 0, 0.5})) << "a flat ridge";
  EXPECT_FALSE(share({p, q, left}, {q, p, right}, {0.5, 0, 0})) << "on the ridge";
}

TEST(SharedFeature, IsNoneOfTrianglesThatMeetElsewhere) {
  EXPECT_FALSE(share({p, q, left}, {p, right, Vec3(-1, -1, -1)}, {1.3, 0, 0.2}));
  EXPECT_FALSE(share({p, q, left}, {right, Vec3(5, 5, 5), Vec3(4, 5, 5)}, {0.4, 0.01, 0.5}));
}

TEST(SharedFeature, IsAllOfTheSameTriangleTurnedOrOpposed) {
  for (const CornerCases::Corners& other :
       {CornerCases::Corners{q, left, p}, CornerCases::Corners{left, q, p}})
    EXPECT_TRUE(share({p, q, left}, other, {0.5, 0.3, 0.5}));
  EXPECT_FALSE(share({p, p, q}, {p, q, left}, {0.5, 0.3, 0.5})) << "its corners are among the other's only";
  EXPECT_TRUE(share({p, p, q}, {q, q, p}, {0.5, 0.3, 0.5}));
}

/// On the borders between features and beside them, and anywhere: what is said for certain is so.
TEST(SharedFeature, IsNeverClaimedWhereTheDistancesDiffer) {
  CornerCases cases(31);
  int claimed = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 a = cases.vector(), b = a + cases.magnitude(-3, 0) * cases.vector();
    const CornerCases::Corners one = {a, b, a + cases.magnitude(-3, 0) * cases.vector()};
    const CornerCases::Corners other = {b, a, i % 2 == 0 ? Vec3(cases.vector()) : Vec3(2 * a - one[2])};
    const TriangleMesh both = mesh_of({one, other});
    const bench::oracle::Oracle oracle(both, 1);
    const Vec3 from = cases.point_near(one);
    const Vec3 place =
        bench::experiments::stress::where_the_nearest_changes(oracle, from, from + 0.5 * cases.vector());
    std::vector<Vec3> points = bench::experiments::stress::with_neighbors(place, cases);
    points.push_back(from);
    for (const Vec3& point : points) {
      if (!share(one, other, point) && !share_corner(one, other, point)) continue;
      ++claimed;
      EXPECT_TRUE(are_equally_near(one, other, point)) << i;
    }
  }
  EXPECT_GT(claimed, 100);
}

}  // namespace
}  // namespace touchmark
