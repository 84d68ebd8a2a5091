// Sweeps while the mesh moves: every form against the oracle for points, against samples of both motions for
// balls, and against geometry where that is known.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bench/oracle/exact/moving_meeting.h"
#include "bench/support/random.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/geometry/moving_triangle_sweep.h"
#include "core/geometry/point_triangle.h"
#include "core/geometry/sphere_triangle_sweep.h"
#include "core/mesh_motion.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark {
namespace {

using bench::support::Random;

static_assert(AnswersMovingSweep<BruteForce> && AnswersMovingSweep<AabbTree> &&
              AnswersMovingSweep<SphereCluster>);

TriangleMesh with_vertices(const TriangleMesh& mesh, std::vector<Vec3> vertices) {
  return {std::move(vertices), {mesh.triangles().begin(), mesh.triangles().end()}};
}

/// Every vertex goes somewhere else, by as much as `shift`.
TriangleMesh shaken(const TriangleMesh& mesh, Random& random, double shift) {
  std::vector<Vec3> vertices(mesh.vertices().begin(), mesh.vertices().end());
  for (Vec3& v : vertices) v += shift * random.unit() * random.direction();
  return with_vertices(mesh, std::move(vertices));
}

TriangleMesh shifted(const TriangleMesh& mesh, const Vec3& by) {
  std::vector<Vec3> vertices(mesh.vertices().begin(), mesh.vertices().end());
  for (Vec3& v : vertices) v += by;
  return with_vertices(mesh, std::move(vertices));
}

/// The unit sphere by n rings of 2 n squares, cut in two; those at the poles have no area.
TriangleMesh ball(std::uint32_t n) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  const double step = std::acos(-1.0) / n;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t k = 0; k < 2 * n; ++k) {
      vertices.emplace_back(std::sin(i * step) * std::cos(k * step), std::sin(i * step) * std::sin(k * step),
                            std::cos(i * step));
      if (i == n) continue;
      const std::uint32_t v = 2 * n * i + k, beside = k + 1 < 2 * n ? v + 1 : v + 1 - 2 * n;
      triangles.push_back({v, v + 2 * n, beside + 2 * n});
      triangles.push_back({v, beside + 2 * n, beside});
    }
  return {std::move(vertices), std::move(triangles)};
}

/// A level sheet about the middle.
TriangleMesh sheet(double height) {
  return {{Vec3(-2, -2, height), Vec3(2, -2, height), Vec3(2, 2, height), Vec3(-2, 2, height)},
          {{0, 1, 2}, {0, 2, 3}}};
}

TriangleCorners corners_of(const TriangleMesh& mesh, std::size_t i) {
  return {mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2)};
}

template <class D>
std::optional<Impact> asked(const TriangleMesh& before, const TriangleMesh& after, const Sweep& sweep) {
  typename D::Session session;
  return D::build(before).first_hit_moving(sweep, MeshMotion(before, after), session);
}

/// Fails unless all three tell the same bits.
std::optional<Impact> asked_of_all(const TriangleMesh& before, const TriangleMesh& after,
                                   const Sweep& sweep) {
  const std::optional<Impact> by_scan = asked<BruteForce>(before, after, sweep);
  for (const std::optional<Impact>& other :
       {asked<AabbTree>(before, after, sweep), asked<SphereCluster>(before, after, sweep)}) {
    EXPECT_EQ(other.has_value(), by_scan.has_value());
    if (!other || !by_scan) continue;
    EXPECT_EQ(other->fraction, by_scan->fraction);
    EXPECT_EQ(other->contact.triangle, by_scan->contact.triangle);
    EXPECT_EQ(other->contact.point, by_scan->contact.point);
  }
  return by_scan;
}

TEST(MovingMesh, MeetsAPointExactlyWhereTheOracleMeetsIt) {
  Random random(1);
  std::size_t met = 0, apart = 0;
  for (int i = 0; i < 150; ++i) {
    const TriangleMesh before = ball(5);
    const TriangleMesh after = shaken(before, random, i % 3 == 0 ? 0.02 : 0.5);
    const Vec3 from = random.between(0.9, 1.1) * random.direction();
    const Sweep sweep{from, i % 2 == 0 ? from : Vec3(from + 0.1 * random.direction())};
    std::optional<bench::oracle::MeetingTime> truth;
    for (std::size_t t = 0; t < before.size(); ++t) {
      // What is not in the box of both motions is not met.
      const TriangleCorners a = corners_of(before, t), b = corners_of(after, t);
      bool is_outside = false;
      for (int k = 0; k < 3; ++k) {
        double low = infinity, high = -infinity;
        for (const TriangleCorners* at : {&a, &b})
          for (const Vec3& corner : *at) low = std::min(low, corner[k]), high = std::max(high, corner[k]);
        is_outside = is_outside || std::max(sweep.from[k], sweep.to[k]) < low ||
                     std::min(sweep.from[k], sweep.to[k]) > high;
      }
      if (is_outside) continue;
      const auto found = bench::oracle::first_meeting(a, b, sweep.from, sweep.to);
      if (found && !(truth && truth->high <= found->high)) truth = found;
    }
    const std::optional<Impact> told = asked_of_all(before, after, sweep);
    ASSERT_EQ(told.has_value(), truth.has_value()) << i;
    ++(truth ? met : apart);
    if (!truth) continue;
    ASSERT_LE(told->fraction, truth->high);
    ASSERT_GE(told->fraction, truth->low - 0x1p-48);
    ASSERT_LT(told->contact.distance, 1e-12);
  }
  EXPECT_GT(met, 30U);
  EXPECT_GT(apart, 40U);
}

/// Samples of the motion can miss a ball's touch. A touch that they find must be told before it, and one that
/// is told is as near as it may be.
TEST(MovingMesh, MissesNoBallAndTellsNoneThatIsFarther) {
  Random random(2);
  std::size_t met = 0, made_up = 0, apart = 0;
  for (int i = 0; i < 20'000; ++i) {
    TriangleCorners a, b;
    for (Vec3& corner : a) corner = 2 * random.unit() * random.direction();
    for (std::size_t k = 0; k < 3; ++k)
      b[k] = i % 4 == 0 ? Vec3(a[k] + Vec3(0.5, -0.3, 0.7)) : Vec3(a[k] + random.direction());
    const Sweep sweep{random.direction(), random.unit() * random.direction(),
                      0.3 * random.unit() * random.unit()};
    std::uint64_t decisions = 0;
    const std::optional<double> told = moving_sweep_hit(a, b, sweep, 1, decisions);
    const auto gap_at = [&](double t) {
      TriangleCorners c;
      for (std::size_t k = 0; k < 3; ++k) c[k] = a[k] + t * (b[k] - a[k]);
      return std::sqrt(squared_distance(prepare(c[0], c[1], c[2], 0), position_at(sweep, t))) - sweep.radius;
    };
    double least = infinity;
    for (int step = 0; step <= 256; ++step) {
      const double gap = gap_at(step / 256.0);
      least = std::min(least, gap);
      if (gap > 1e-14) continue;
      ASSERT_TRUE(told && *told <= step / 256.0) << i;
      break;
    }
    if (!told) {
      ++apart;
      continue;
    }
    ++met;
    if (least > 0) ++made_up;
    double speed = 0;
    for (std::size_t k = 0; k < 3; ++k)
      speed = std::max(speed, (b[k] - a[k] - (sweep.to - sweep.from)).norm());
    ASSERT_LE(gap_at(*told), max_early_moving_gap(speed, 8)) << i;
  }
  RecordProperty("touches that 257 samples do not show", static_cast<int>(made_up));
  EXPECT_GT(met, 3000U);
  EXPECT_GT(apart, 3000U);
  EXPECT_LT(made_up, met / 50);
}

TEST(MovingMesh, ASheetMeetsABallThatRestsWhereItComesToItsRadius) {
  const TriangleMesh before = sheet(-1), after = sheet(3);
  const std::optional<Impact> hit = asked_of_all(before, after, {Vec3::Zero(), Vec3::Zero(), 0.5});
  ASSERT_TRUE(hit);
  EXPECT_LE(hit->fraction, 0.125);
  EXPECT_NEAR(hit->fraction, 0.125, 0x1p-20);
  EXPECT_NEAR(hit->contact.normal.z(), 1, 1e-9);
  EXPECT_FALSE(asked_of_all(before, after, {Vec3::Zero(), Vec3(0, 0, 4), 0.5}));  // which keeps ahead of it
}

/// The sheet is on the same side before and after, and a sweep of either mesh meets nothing.
TEST(MovingMesh, ASheetThatIsMovedOverAndBackIsMetBothTimes) {
  const Sweep rest{Vec3(0, 0, 0), Vec3(0, 0, 0)};
  EXPECT_TRUE(asked_of_all(sheet(-1), sheet(1), rest));
  EXPECT_TRUE(asked_of_all(sheet(1), sheet(-1), rest));
  EXPECT_FALSE(asked_of_all(sheet(1), sheet(0x1p-40), rest));
  EXPECT_TRUE(asked_of_all(sheet(1), sheet(0), rest));
}

TEST(MovingMesh, OneThatMovesAsTheProbeDoesIsNotMet) {
  const TriangleMesh mesh = ball(8);
  const Vec3 by(1, -3, 0.5);
  const Vec3 outside(0, 0, 1.25);
  EXPECT_FALSE(asked_of_all(mesh, shifted(mesh, by), {outside, outside + by, 0.125}));
  EXPECT_TRUE(asked_of_all(mesh, shifted(mesh, by), {outside, outside + by, 0.25}));
}

/// An update that moves nothing looks at no more than the sweep does.
TEST(MovingMesh, OneThatRestsCostsNothingMore) {
  const TriangleMesh mesh = ball(16), same = mesh;
  const MeshMotion motion(mesh, same);
  EXPECT_EQ(motion.max_shift(), 0);
  const SphereCluster detector = SphereCluster::build(mesh);
  SphereCluster::Session once, again;
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    const Sweep sweep{1.5 * random.direction(), 1.5 * random.direction(), 0.05};
    const auto hit = detector.first_hit(sweep, once);
    const auto moving = detector.first_hit_moving(sweep, motion, again);
    ASSERT_EQ(hit.has_value(), moving.has_value());
    if (hit) {
      ASSERT_EQ(hit->fraction, moving->fraction);
    }
  }
  EXPECT_EQ(once.work.total(), again.work.total());
}

TEST(MovingMesh, NumbersThatAreNoneAnswerNothing) {
  const TriangleMesh before = sheet(-1), after = sheet(1);
  const double nan = std::nan("");
  EXPECT_FALSE(asked_of_all(before, after, {Vec3::Zero(), Vec3::Zero(), nan}));
  EXPECT_FALSE(asked_of_all(before, after, {Vec3(nan, 0, 0), Vec3::Zero(), 1}));
  EXPECT_FALSE(asked_of_all(before, after, {Vec3::Zero(), Vec3(0, infinity, 0), 1}));
  EXPECT_TRUE(asked_of_all(before, after, {Vec3::Zero(), Vec3::Zero(), infinity}));
}

/// Lengths near both ends of what a double holds.
TEST(MovingMesh, AnyUnitWillDo) {
  for (const double unit : {0x1p-1020, 0x1p-600, 0x1p600, 0x1p1020}) {
    const TriangleMesh before = sheet(-1).transformed(unit, Vec3::Zero());
    const TriangleMesh after = sheet(3).transformed(unit, Vec3::Zero());
    for (const double radius : {0.0, 0.5}) {
      const auto hit = asked_of_all(before, after, {Vec3::Zero(), Vec3::Zero(), unit * radius});
      ASSERT_TRUE(hit) << unit;
      EXPECT_NEAR(hit->fraction, radius > 0 ? 0.125 : 0.25, 0x1p-20) << unit;
      EXPECT_FALSE(asked_of_all(before, after,
                                {unit * Vec3::UnitX() * 2.75, unit * Vec3::UnitX() * 2.75, unit * radius}));
    }
  }
}

TEST(MovingMesh, OfOtherTrianglesIsRefused) {
  EXPECT_THROW(MeshMotion(sheet(0), ball(5)), std::invalid_argument);
}

}  // namespace
}  // namespace touchmark
