// First meetings of moving triangles and points against an oracle of rational numbers and Sturm chains.
#include "core/exact/moving_triangle.h"

#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "bench/oracle/exact/moving_meeting.h"
#include "bench/support/random.h"

namespace touchmark {
namespace {

using bench::support::Random;

struct Case {
  TriangleCorners start, end;
  Vec3 from, to;
};

struct Counts {
  std::size_t met = 0, apart = 0;
};

void judge(const Case& c, Counts& counts) {
  const auto truth = bench::oracle::first_meeting(c.start, c.end, c.from, c.to);
  const std::optional<double> told = first_meeting(c.start, c.end, c.from, c.to);
  ASSERT_EQ(told.has_value(), truth.has_value());
  const auto mesh = [](const auto& corners) {
    return TriangleMesh({corners.begin(), corners.end()}, {{0, 1, 2}});
  };
  ASSERT_EQ(bench::oracle::any_meets(mesh(c.start), mesh(c.end), c.from, c.to), truth.has_value());
  ++(truth ? counts.met : counts.apart);
  if (!truth) return;
  ASSERT_LE(*told, truth->high);
  ASSERT_GE(*told, truth->low - 0x1p-50);
}

Vec3 on_grid(Random& random, int steps) {
  Vec3 v;
  for (double& x : v) x = std::floor(random.between(-steps, steps + 1));
  return v;
}

Vec3 any(Random& random) { return {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)}; }

/// `corner` draws both triangles, then `point` the ends of the point's way.
template <class Corner, class Point>
Case drawn_by(const Corner& corner, const Point& point) {
  Case c;
  for (Vec3& at : c.start) at = corner();
  for (Vec3& at : c.end) at = corner();
  c.from = point();
  c.to = point();
  return c;
}
Case any_case(Random& random) {
  return drawn_by([&] { return any(random); }, [&] { return Vec3(0.3 * any(random)); });
}

TEST(FirstMeeting, IsTheOraclesForAnyTriangles) {
  Random random(1);
  Counts counts;
  for (int i = 0; i < 500; ++i) {
    judge(any_case(random), counts);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(counts.met, 20U);
  EXPECT_GT(counts.apart, 300U);
}

/// On coarse grids points meet sides and corners, triangles lose their area on the way, and planes are
/// touched and left again.
TEST(FirstMeeting, IsTheOraclesOnSidesAndCornersAndWhereAnAreaVanishes) {
  Random random(2);
  for (const int steps : {1, 2, 5}) {
    Counts counts;
    for (int i = 0; i < 800; ++i) {
      const auto drawn = [&] { return on_grid(random, steps); };
      judge(drawn_by(drawn, drawn), counts);
      if (HasFatalFailure()) return;
    }
    EXPECT_GT(counts.met, 20U);
    EXPECT_GT(counts.apart, 20U);
  }
}

TEST(FirstMeeting, IsTheOraclesInAPlaneAndOnALine) {
  Random random(3);
  for (const int free : {1, 2}) {
    Counts counts;
    for (int i = 0; i < 500; ++i) {
      const auto drawn = [&] {
        Vec3 v = Vec3::Zero();
        const Vec3 g = on_grid(random, 4);
        for (int k = 0; k < free; ++k) v[(i + k) % 3] = g[k];
        return v;
      };
      judge(drawn_by(drawn, drawn), counts);
      if (HasFatalFailure()) return;
    }
    EXPECT_GT(counts.met, 20U);
    EXPECT_GT(counts.apart, 20U);
  }
}

/// The point is on a side, at a third of it, at a third of the way: no double is there, and one ulp decides.
TEST(FirstMeeting, TellsAnUlpAtASideThatIsMetAtAThirdOfTheWay) {
  Case c{{Vec3(0, 0, -1), Vec3(3, 0, -1), Vec3(0, 3, -1)},
         {Vec3(0, 0, 2), Vec3(3, 0, 2), Vec3(0, 3, 2)},
         Vec3(1, 0, 0),
         Vec3(1, 0, 0)};
  EXPECT_TRUE(first_meeting(c.start, c.end, c.from, c.to));
  c.from.y() = c.to.y() = -0x1p-1074;
  EXPECT_FALSE(first_meeting(c.start, c.end, c.from, c.to));
  c.from.y() = 0x1p-52;
  c.to.y() = -0x1p-51;
  EXPECT_TRUE(first_meeting(c.start, c.end, c.from, c.to));
  c.to.y() = std::nextafter(-0x1p-51, -1);
  EXPECT_FALSE(first_meeting(c.start, c.end, c.from, c.to));
}

/// Its area vanishes half way, where a point beside it is missed by 2^-40.
TEST(FirstMeeting, IsTheOraclesWhereATriangleTurnsOverThroughThePoint) {
  Random random(4);
  Counts counts;
  for (int i = 0; i < 500; ++i) {
    const double x = random.between(1, 2), y = random.between(1, 2);
    Case c{{Vec3(-x, -1, 1), Vec3(x, -1, 1), Vec3(0, y, -1)},
           {Vec3(-x, -1, -1), Vec3(x, -1, -1), Vec3(0, y, 1)},
           Vec3::Zero(),
           Vec3::Zero()};
    if (i % 2 == 1) c.to.z() = c.from.z() = random.between(-1, 1) * 0x1p-40;
    judge(c, counts);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(counts.met, 20U);
}

TEST(FirstMeeting, IsTheSameInAnyUnitOfDouble) {
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const Case c = any_case(random);
    const auto told = first_meeting(c.start, c.end, c.from, c.to);
    for (const double unit : {0x1p-900, 0x1p1000}) {
      Case scaled = c;
      for (std::size_t k = 0; k < 3; ++k) {
        scaled.start[k] *= unit;
        scaled.end[k] *= unit;
      }
      ASSERT_EQ(first_meeting(scaled.start, scaled.end, unit * c.from, unit * c.to), told);
    }
  }
}

}  // namespace
}  // namespace touchmark
