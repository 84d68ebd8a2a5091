#include "core/geometry/point_triangle_avx2.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "core/geometry/edge_cross.h"
#include "tests/core/sphere_cluster/test_meshes.h"

namespace touchmark {
namespace {

#if TOUCHMARK_HAS_AVX2

bool same_bits(const Offset& a, const Offset& b) {
  return std::memcmp(a.vector.data(), b.vector.data(), sizeof(double[3])) == 0 &&
         std::memcmp(&a.squared, &b.squared, sizeof(double)) == 0;
}

TEST(PointTriangleAvx2, GivesTheBitsOfTheScalarKernelOnEveryMesh) {
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "this processor has no AVX2";
  for (const auto& named : test::test_meshes()) {
    const std::vector<PreparedTriangle> triangles = prepare(named.mesh);
    test::Random random(41);
    for (int step = 0; step < 20000; ++step) {
      const Vec3 point = test::random_point(named, random);
      const PreparedTriangle& triangle = triangles[random.below(triangles.size())];
      ASSERT_TRUE(same_bits(avx2::offset_from(triangle, point), offset_from(triangle, point)))
          << named.name << ", step " << step;
    }
  }
}

TEST(PointTriangleAvx2, GivesTheBitsOfTheScalarKernelWhereCornersAreEquallyNear) {
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "this processor has no AVX2";
  // Points of a lattice that is symmetric to the triangle's: two or three corners at the same distance.
  const PreparedTriangle triangle = prepare({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0);
  for (int x = -4; x <= 4; ++x)
    for (int y = -4; y <= 4; ++y)
      for (int z = -4; z <= 4; ++z) {
        const Vec3 point(0.5 * x, 0.5 * y, 0.5 * z);
        ASSERT_TRUE(same_bits(avx2::offset_from(triangle, point), offset_from(triangle, point)))
            << x << ' ' << y << ' ' << z;
      }
}

TEST(PointTriangleAvx2, GivesTheBitsOfTheScalarCrossProductOfEdges) {
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "this processor has no AVX2";
  test::Random random(43);
  const auto corner = [&] { return Vec3(random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5); };
  for (int step = 0; step < 20000; ++step) {
    const Vec3 a = corner(), b = corner();
    // From a triangle of any shape to one so thin that all of its normal is rounding.
    const Vec3 c = a + random.unit() * (b - a) + std::ldexp(1.0, -(step % 60)) * corner();
    ASSERT_EQ(avx2::edge_cross(a, b, c), edge_cross(a, b, c)) << "step " << step;
  }
}

#endif

}  // namespace
}  // namespace touchmark
