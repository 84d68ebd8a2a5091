/// A certified field is wrong by no more than it says: the truth is brute force, which shares no tree and no
/// sample with it.
#include "core/field/certified_field.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/same_contact.h"
#include "tests/core/sphere_cluster/test_meshes.h"

namespace touchmark {
namespace {

using Field = CertifiedField<SphereCluster>;
using test::same_bits;

static_assert(AnswersTouches<Field> && AnswersNearest<Field>);

Field::Options with(double error, double band, bool refines = false) {
  Field::Options options;
  options.error = error;
  options.band = band;
  options.refines = refines;
  return options;
}

/// A needle that stands on a plate, thinner than any cube: samples at corners do not see it.
TriangleMesh plate_with_needle() {
  std::vector<Vec3> vertices = {{-1, -1, 0}, {1, -1, 0},      {1, 1, 0},
                                {-1, 1, 0},  {0.21, 0.17, 0}, {0.2101, 0.17, 0}};
  vertices.emplace_back(0.2137, 0.1741, 0.4);
  return {std::move(vertices), {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}}};
}

std::vector<test::NamedMesh> all_meshes() {
  std::vector<test::NamedMesh> all_meshes = test::test_meshes();
  all_meshes.push_back({"plate with needle", plate_with_needle(), 1.2});
  const Vec3 far = Vec3::Constant(0x1p44);
  all_meshes.push_back({"very far off", test::soup(100, 0.3, 2).transformed(1, far), 1.3, far});
  return all_meshes;
}

/// On the surface, about it, and as far as the band.
std::vector<Vec3> points_near(const test::NamedMesh& named, double band, test::Random& random) {
  std::vector<Vec3> points;
  for (int i = 0; i < 60; ++i) {
    const Vec3 near = test::random_point(named, random);
    points.push_back(near);
    points.push_back(near + random.point(band));
    points.push_back(near + random.point(0.05 * band));
  }
  return points;
}

TEST(CertifiedField, IsNeverWrongByMoreThanItsError) {
  test::Random random(1);
  for (const test::NamedMesh& named : all_meshes()) {
    const double diagonal = named.mesh.diagonal();
    const double error = 0.03 * diagonal, band = 0.1 * diagonal;
    if (!(diagonal > 1e-100 && diagonal < 1e100)) continue;  // there brute force loses digits, too
    const auto field = Field::build(named.mesh, with(error, band));
    EXPECT_LE(field.accuracy().absolute, error) << named.name;
    const auto truth = BruteForce::build(named.mesh);
    Field::Session session;
    BruteForce::Session other;
    for (const Vec3& point : points_near(named, band, random)) {
      const double reach = 0.99 * band, rounding = 1e-12 * (diagonal + point.norm());
      const auto right = truth.nearest({point, 0}, infinity, other);
      const auto answer = field.nearest({point, 0}, reach, session);
      if (answer) {
        EXPECT_GE(answer->distance, right->distance - field.error() - rounding) << named.name;
        EXPECT_LE(answer->distance, right->distance + field.error() + rounding) << named.name;
        EXPECT_NEAR((point - answer->point).norm(), answer->distance, rounding) << named.name;
      } else {
        EXPECT_GT(right->distance + field.error() + rounding, reach) << named.name;
      }
      for (const double sign : {-1.0, 1.0}) {
        const double radius = right->distance + sign * (field.error() + rounding);
        if (radius < 0 || radius >= band) continue;
        EXPECT_EQ(field.touches({point, radius}, session), sign > 0) << named.name;
      }
    }
  }
}

/// What it reports is near the triangle that it names, which is as near to the probe as it says.
TEST(CertifiedField, NamesATriangleThatItsPointIsNear) {
  for (const test::NamedMesh& given : all_meshes()) {
    const double diagonal = given.mesh.diagonal();
    if (!(diagonal > 1e-100 && diagonal < 1e100)) continue;
    const auto field = Field::build(given.mesh, with(0.02 * diagonal, 0.1 * diagonal));
    Field::Session session;
    test::Random random(2);
    for (const Vec3& point : points_near(given, 0.1 * diagonal, random)) {
      const auto answer = field.nearest({point, 0}, 0.09 * diagonal, session);
      if (!answer) continue;
      const double allowed = field.error() + 1e-12 * (diagonal + point.norm());
      const PreparedTriangle named = prepare(given.mesh, answer->triangle);
      EXPECT_LE(std::sqrt(squared_distance(named, answer->point)), allowed) << given.name;
      EXPECT_NEAR(std::sqrt(squared_distance(named, point)), answer->distance, allowed) << given.name;
      EXPECT_NEAR(answer->normal.norm(), 1, 1e-12) << given.name;
    }
  }
}

/// A plate with a square hole of this width that begins there along both axes.
TriangleMesh plate_with_hole(double from, double width) {
  const double to = from + width;
  const std::vector<Vec3> vertices = {{-1, -1, 0},     {1, -1, 0},    {1, 1, 0},   {-1, 1, 0},
                                      {from, from, 0}, {to, from, 0}, {to, to, 0}, {from, to, 0}};
  return {vertices, {{0, 1, 4}, {1, 5, 4}, {1, 2, 5}, {2, 6, 5}, {2, 3, 6}, {3, 7, 6}, {3, 0, 7}, {0, 4, 7}}};
}

TEST(CertifiedField, SeesHolesThatAreWiderThanItsError) {
  constexpr double error = 0.02;
  test::Random random(10);
  for (const double width : {0.01, 0.03, 0.04, 0.045, 0.05, 0.06, 0.08, 0.2}) {
    const double from = 0.1037 + 0.3 * width;
    const auto field = Field::build(plate_with_hole(from, width), with(error, 0.1));
    Field::Session session;
    for (int i = 0; i < 100; ++i) {
      Vec3 in_hole = 0.499 * random.point(1);
      if (i == 0) in_hole = Vec3::Zero();
      const Vec3 point =
          Vec3(from + width / 2, from + width / 2, 0) + width * Vec3(in_hole.x(), in_hole.y(), 0);
      const double distance = width * (0.5 - std::max(std::abs(in_hole.x()), std::abs(in_hole.y())));
      const auto answer = field.nearest({point, 0}, 0.095, session);
      if (distance > 0.09) continue;  // the plate ends beyond the reach, as far as the error goes
      ASSERT_TRUE(answer) << width;
      EXPECT_NEAR(answer->distance, distance, field.error() + 1e-12) << width;
    }
  }
}

/// A wall stands beside a flat floor, no higher than a probe over the floor may be: the floor's plane answers
/// for the probe only where the wall is farther.
TEST(CertifiedField, SeesWallsBesideAFloor) {
  constexpr double error = 0.02;
  test::Random random(11);
  for (const double height : {0.03, 0.1, 0.2}) {
    const TriangleMesh mesh({{-1, -1, 0}, {0, -1, 0}, {0, 1, 0}, {-1, 1, 0}, {0, -1, height}, {0, 1, height}},
                            {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}});
    const auto field = Field::build(mesh, with(error, 0.3));
    Field::Session session;
    for (int i = 0; i < 3000; ++i) {
      const Vec3 at = random.point(1);
      const Vec3 point(-0.1 + 0.1 * at.x(), 0.5 * at.y(), 0.15 + 0.15 * at.z());
      const double beyond_wall = std::max(point.z() - height, 0.0);
      const double distance = std::min(point.z(), std::hypot(point.x(), beyond_wall));
      const auto answer = field.nearest({point, 0}, 0.29, session);
      if (distance > 0.27) continue;
      ASSERT_TRUE(answer) << height;
      EXPECT_NEAR(answer->distance, distance, field.error() + 1e-12) << height;
    }
  }
}

TEST(CertifiedField, LooksAtNoTriangleOverWhatIsFlat) {
  const TriangleMesh mesh = test::plate(40);
  const auto field = Field::build(mesh, with(0.01, 0.1));
  const Aabb inner = mesh.bounds().padded(-0.1);
  Field::Session session;
  test::Random random(9);
  for (int i = 0; i < 1000; ++i) {
    Vec3 point = inner.center() + 0.5 * inner.extent().cwiseProduct(Vec3(random.point(1)));
    point.z() = mesh.bounds().center().z() + 0.01 * random.point(1).z();
    EXPECT_TRUE(field.nearest({point, 0}, 0.05, session)) << i;
  }
  EXPECT_EQ(session.work.triangles, 0U);
}

TEST(CertifiedField, AnswersAsIfItHadNoSession) {
  const TriangleMesh mesh = test::soup(200, 0.3, 3);
  for (const bool refines : {false, true}) {
    const auto field = Field::build(mesh, with(0.05, 0.3, refines));
    Field::Session kept;
    test::Random random(4);
    Vec3 at = Vec3::Zero();
    for (int i = 0; i < 3000; ++i) {
      at = i % 100 == 0 ? Vec3(random.point(1.4)) : Vec3(at + random.point(0.01));
      const double reach = i % 3 == 0 ? 0.02 : 0.29;
      Field::Session fresh;
      ASSERT_TRUE(same_bits(field.nearest({at, 0}, reach, kept), field.nearest({at, 0}, reach, fresh))) << i;
      ASSERT_EQ(field.touches({at, reach}, kept), field.touches({at, reach}, fresh)) << i;
    }
  }
}

/// Ids that polygons share: it finds the triangle of the polygon.
TriangleMesh with_shared_ids(const TriangleMesh& mesh) {
  std::vector<TriangleId> ids;
  for (std::uint32_t i = 0; i < mesh.size(); ++i) ids.push_back(7 + i / 2);
  return {{mesh.vertices().begin(), mesh.vertices().end()},
          {mesh.triangles().begin(), mesh.triangles().end()},
          std::move(ids)};
}

TEST(CertifiedField, IsExactWhereThatIsAskedForAndBeyondTheBand) {
  const TriangleMesh mesh = with_shared_ids(test::soup(200, 0.3, 5));
  const auto field = Field::build(mesh, with(0.05, 0.2)),
             refining = Field::build(mesh, with(0.05, 0.2, true));
  EXPECT_TRUE(refining.accuracy().names_exactly);
  EXPECT_EQ(field.accuracy().guarantee, Guarantee::approximate);
  Field::Session session, other;
  test::Random random(6);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 point = random.point(2);
    SphereCluster::Session exact;
    for (const double reach : {0.01, 0.1, 0.5, infinity}) {
      const auto right = field.exact().nearest({point, 0}, reach, exact);
      ASSERT_TRUE(same_bits(refining.nearest({point, 0}, reach, session), right)) << i << ", " << reach;
      if (reach > 0.2 && right && right->distance > 0.2 + 0.1) {
        ASSERT_TRUE(same_bits(field.nearest({point, 0}, reach, other), right)) << i << ", " << reach;
      }
    }
  }
}

TEST(CertifiedField, IsTheSameOfAnyNumberOfThreads) {
  const TriangleMesh mesh = test::bumpy_sphere(12, 0.05, 7);
  Field::Options options = with(0.05, 0.2);
  const auto one = Field::build(mesh, options);
  options.threads = 3;
  const auto three = Field::build(mesh, options);
  EXPECT_EQ(one.bytes(), three.bytes());
  EXPECT_EQ(one.error(), three.error());
  test::Random random(8);
  Field::Session session, other;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 point = random.point(1.2);
    ASSERT_TRUE(same_bits(one.nearest({point, 0}, 0.19, session), three.nearest({point, 0}, 0.19, other)))
        << i;
  }
}

TEST(CertifiedField, AnswersNothingToWhatIsNotANumber) {
  const auto field = Field::build(test::plate(4), with(0.05, 0.2));
  Field::Session session;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double reach : {0.1, infinity}) {
    EXPECT_FALSE(field.nearest({Vec3(nan, 0, 0), 0}, reach, session));
    EXPECT_FALSE(field.nearest({Vec3(0, infinity, 0), 0}, reach, session));
    EXPECT_FALSE(field.touches({Vec3(0, 0, nan), reach}, session));
  }
  EXPECT_FALSE(field.nearest({Vec3::Zero(), 0}, nan, session));
  EXPECT_FALSE(field.touches({Vec3::Zero(), -1}, session));
}

TEST(CertifiedField, RefusesLengthsThatMakeNoSense) {
  const TriangleMesh mesh = test::plate(2);
  const auto expect_refused = [&](const Field::Options& options, const std::string& name) {
    try {
      Field::build(mesh, options);
      ADD_FAILURE() << name << ": it was built";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  };
  expect_refused(with(-1, 0.1), "error is -1");
  expect_refused(with(0.1, std::numeric_limits<double>::quiet_NaN()), "band is ");
  Field::Options options;
  options.threads = 257;
  expect_refused(options, "threads is 257");
}

}  // namespace
}  // namespace touchmark
