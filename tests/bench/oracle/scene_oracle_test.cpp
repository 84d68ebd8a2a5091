#include "bench/oracle/scene_oracle.h"

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <utility>

#include <gmpxx.h>
#include <gtest/gtest.h>

namespace touchmark::bench::oracle {
namespace {

using Shapes = std::vector<std::shared_ptr<const TriangleMesh>>;

std::shared_ptr<const TriangleMesh> triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return std::make_shared<const TriangleMesh>(TriangleMesh({a, b, c}, {{0, 1, 2}}));
}

/// The image of a point in rational numbers, which know no rounding and no grid.
std::array<mpq_class, 3> image_of(const Pose& pose, const Vec3& v) {
  std::array<mpq_class, 3> image;
  for (int row = 0; row < 3; ++row) {
    mpq_class& sum = image[static_cast<std::size_t>(row)];
    sum = mpq_class(pose.translation[row]);
    for (int column = 0; column < 3; ++column)
      sum += mpq_class(pose.rotation(row, column)) * mpq_class(v[column]);
  }
  return image;
}

mpq_class squared(const std::array<mpq_class, 3>& a, const Vec3& b) {
  mpq_class sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const mpq_class d = a[i] - mpq_class(b[static_cast<Eigen::Index>(i)]);
    sum += d * d;
  }
  return sum;
}

Pose random_pose(std::mt19937_64& random, double far) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const Vec3 position(far * unit(random), far * unit(random), far * unit(random));
  const double w = unit(random), x = unit(random), y = unit(random), z = unit(random);
  return pose_of(position, w, x, y, z);
}

// A body that is one point: its distance is that of the image, as rational numbers have it, to the last
// digit.
TEST(SceneOracle, MeasuresToTheExactImageOfAPoint) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const double far : {0.0, 1.0, 1e6, 0x1p50, 1e-200}) {
    for (int i = 0; i < 40; ++i) {
      const Vec3 v(unit(random), unit(random), unit(random));
      const Pose pose = random_pose(random, far);
      const Vec3 center = image(pose, Vec3(unit(random), unit(random), unit(random)));
      const SceneOracle oracle(Shapes{triangle(v, v, v)}, {{0, pose}});
      const GroundTruth truth = oracle.solve(center);
      const mpq_class exact = squared(image_of(pose, v), center);
      // high is the distance rounded to nearest: its neighbours are on both sides of it.
      const auto below = [&](double x) { return mpq_class(x) * mpq_class(x) <= exact; };
      EXPECT_TRUE(below(std::nextafter(truth.high, 0)));
      EXPECT_FALSE(below(std::nextafter(truth.high, std::numeric_limits<double>::infinity())));
      EXPECT_EQ(oracle.within(truth, center, truth.high),
                exact <= mpq_class(truth.high) * mpq_class(truth.high));
      EXPECT_EQ(oracle.segment_within(center, center, truth.high),
                exact <= mpq_class(truth.high) * mpq_class(truth.high));
      EXPECT_EQ(oracle.segment_nearer(center, center, truth.high),
                exact < mpq_class(truth.high) * mpq_class(truth.high));
    }
  }
}

// A sphere's surface, of which both sides are outside: 3-4-5 triangles have roots that are whole numbers.
TEST(SceneOracle, MeasuresToASurfaceFromEitherSide) {
  const auto axis = triangle({-1, 0, 0}, {1, 0, 0}, {1, 0, 0});
  const Pose pose = pose_of({0, 0, 0}, 1, 0, 0, 0);
  const SceneOracle oracle(Shapes{axis}, {{0, pose, 2}});
  const auto at = [&](const Vec3& center) { return oracle.solve(center); };
  EXPECT_EQ(at({4, 4, 0}).high, 3);
  EXPECT_EQ(at({0, 1.5, 0}).high, 0.5);
  EXPECT_EQ(at({0, 1.5, 0}).direction, Vec3(0, -1, 0));
  EXPECT_EQ(at({0, 1.5, 0}).point, Vec3(0, 2, 0));
  EXPECT_EQ(at({0.5, 0, 0}).high, 2);
  const Vec3 inside(0, 1.5, 0);
  EXPECT_TRUE(oracle.within(at(inside), inside, 0.5));
  EXPECT_FALSE(oracle.within(at(inside), inside, std::nextafter(0.5, 0)));
  EXPECT_TRUE(oracle.segment_within({0, 1, 0}, {0, 3, 0}, 0));
  EXPECT_FALSE(oracle.segment_within({0, 1, 0}, {0, -1, 0}, 0.5)) << "inside all the way";
  EXPECT_TRUE(oracle.segment_within({-5, 2, 0}, {5, 2, 0}, 0)) << "it grazes";
  EXPECT_FALSE(oracle.segment_within({-5, std::nextafter(2, 3), 0}, {5, std::nextafter(2, 3), 0}, 0));
  const double more = std::nextafter(1, 2);
  for (const auto& [from, to] : {std::pair(Vec3(-5, 3, 0), Vec3(5, 3, 0)), {{0, 1, 0}, {0, -1, 0}}}) {
    EXPECT_TRUE(oracle.segment_within(from, to, 1));
    EXPECT_FALSE(oracle.segment_nearer(from, to, 1)) << "as near, and no nearer";
    EXPECT_TRUE(oracle.segment_nearer(from, to, more));
  }
  EXPECT_FALSE(oracle.segment_nearer({0, 1, 0}, {0, 3, 0}, 0)) << "it crosses, and nothing is nearer than 0";
  const Sweep out{{0, 0, 0}, {0, 4, 0}, 1};
  EXPECT_FALSE(oracle.touches_before(out, 0.25)) << "at 1 of 4 it is one radius below the surface";
  EXPECT_TRUE(oracle.touches_before(out, 0.26));
  EXPECT_TRUE(oracle.touches_soon_after(out, 0.25, 1));
  EXPECT_FALSE(oracle.touches_soon_after(out, 0.24, 1));
  EXPECT_TRUE(oracle.surely_crosses({0, 0, 0}, {0, 4, 0}, 1.5));
  EXPECT_FALSE(oracle.surely_crosses({0, 0, 0}, {0, 4, 0}, 2.5));
}

// Roots of which no double is the difference: the nearer one by a hair, and the first of those as far.
TEST(SceneOracle, TellsTheNearerOfTwoSurfaces) {
  const auto point = triangle({0, 0, 0}, {0, 0, 0}, {0, 0, 0});
  const auto stands = [](const Vec3& position) { return pose_of(position, 1, 0, 0, 0); };
  SceneOracle oracle(Shapes{point}, {{0, stands({1, 1, 0}), 0.25}, {0, stands({-1, 1, 0}), 0.25}});
  EXPECT_EQ(oracle.solve(Vec3(0, 0, 0)).triangle, 0U);
  EXPECT_EQ(oracle.solve(Vec3(-0x1p-300, 0, 0)).triangle, 1U);
  // From within a large one and without a small one, by square roots of 2.
  SceneOracle nested(Shapes{point}, {{0, stands({0, 0, 0}), 2}, {0, stands({2, 2, 0}), 0.5}});
  const double within = 2 - std::sqrt(2), without = std::sqrt(2) - 0.5;
  EXPECT_LT(within, without);
  EXPECT_EQ(nested.solve(Vec3(1, 1, 0)).triangle, 0U);
  EXPECT_NEAR(nested.solve(Vec3(1, 1, 0)).high, within, 1e-15);
}

TEST(SceneOracle, NamesTheLowestBodyOfThoseAtOnePlace) {
  const auto shape = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  std::mt19937_64 random(2);
  const Pose pose = random_pose(random, 10);
  SceneOracle oracle(Shapes{shape}, {{0, random_pose(random, 1e3)}, {0, pose}, {0, pose}, {0, pose}});
  const Vec3 center = image(pose, Vec3(0.2, 0.3, 0.4));
  EXPECT_EQ(oracle.name_of(oracle.solve(center).triangle), std::pair(std::uint32_t{1}, TriangleId{0}));
  oracle.place(1, random_pose(random, 1e3));
  EXPECT_EQ(oracle.name_of(oracle.solve(center).triangle), std::pair(std::uint32_t{2}, TriangleId{0}));
}

// Two bodies whose images are a last digit apart: the second is nearer by what no double distance tells.
TEST(SceneOracle, TellsBodiesApartByLessThanRounding) {
  const auto shape = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  Pose farther, nearer;
  farther.translation = {0, 0, 1};
  nearer.translation = {0, 0, std::nextafter(1.0, 0)};
  const SceneOracle oracle(Shapes{shape}, {{0, farther}, {0, nearer}});
  EXPECT_EQ(oracle.name_of(oracle.solve({0.25, 0.25, -0x1p60}).triangle).first, 1U);
}

TEST(SceneOracle, FindsAMovedBodyWhereItIs) {
  const auto shape = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  SceneOracle oracle(Shapes{shape}, {{0, Pose()}});
  Pose there;
  there.translation = {0, 0, 5};
  oracle.place(0, there);
  EXPECT_EQ(oracle.solve({0.25, 0.25, 0}).high, 5);
  EXPECT_TRUE(oracle.segment_within({0.25, 0.25, 4}, {0.25, 0.25, 6}, 0));
  EXPECT_FALSE(oracle.segment_within({0.25, 0.25, -1}, {0.25, 0.25, 4.5}, 0.25));
  EXPECT_TRUE(oracle.touches_before({{0.25, 0.25, 0}, {0.25, 0.25, 8}, 1}, 0.51));
  EXPECT_FALSE(oracle.touches_before({{0.25, 0.25, 0}, {0.25, 0.25, 8}, 1}, 0.5));
  EXPECT_TRUE(oracle.touches_soon_after({{0.25, 0.25, 0}, {0.25, 0.25, 8}, 1}, 0.5, 1));
}

}  // namespace
}  // namespace touchmark::bench::oracle
