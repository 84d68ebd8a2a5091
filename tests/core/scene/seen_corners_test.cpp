// How a point sees the corners of a posed body: the bits are those of the formula in scalars, by whatever
// instructions they are computed.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "core/exact/double_double.h"
#include "core/scene/seen_body.h"
#include "tests/core/scene/random_pose.h"

namespace touchmark {
namespace {

using test::Random, test::random_pose;

Vec3 random_point(Random& random, double size) {
  const double x = random.between(-size, size), y = random.between(-size, size);
  return {x, y, random.between(-size, size)};
}

/// The way from the point to the image of `center`: a compensated sum an axis.
Vec3 rest_by_scalars(const Pose& pose, const Vec3& center, const Vec3& point) {
  Vec3 rest;
  for (int k = 0; k < 3; ++k) {
    DoubleDouble sum = two_sum(pose.translation[k], -point[k]);
    for (int j = 0; j < 3; ++j) {
      const DoubleDouble product = two_product(pose.rotation(k, j), center[j]);
      const DoubleDouble next = two_sum(sum.high, product.high);
      sum = {next.high, sum.low + (next.low + product.low)};
    }
    rest[k] = sum.rounded();
  }
  return rest;
}

TEST(SeenCorners, HaveTheBitsOfTheFormulaInScalars) {
  Random random(31);
  for (const double size : {1.0, 1e-6, 1e12}) {
    for (int i = 0; i < 3000; ++i) {
      const Pose pose = random_pose(random, random_point(random, 100 * size));
      const Vec3 point = pose.translation + random_point(random, size);
      const SeenBody body(pose, rigid_error(pose.rotation), point);
      const TriangleCorners triangle = {random_point(random, size), random_point(random, size),
                                        random_point(random, size)};
      const SeenTriangle seen = SeenCorners(body)(triangle);
      const Vec3 rest = rest_by_scalars(pose, body.center(), point);
      double squared = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 way = triangle[k] - body.center();
        const Vec3 corner = pose.rotation * way + rest;
        EXPECT_EQ(seen.corner[k], corner) << size << " " << i;
        squared = std::max({squared, way.squaredNorm(), corner.squaredNorm()});
      }
      EXPECT_EQ(seen.largest, std::sqrt(squared)) << size << " " << i;
    }
  }
}

}  // namespace
}  // namespace touchmark
