#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>

#include "baselines/openvdb/openvdb_detector.h"
#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "tests/baselines/asking.h"
#include "tests/baselines/meshes.h"
#include "tests/baselines/threads.h"

namespace touchmark::baselines {
namespace {

using Distances = OpenVdbDetector::Distances;
using Found = OpenVdbDetector::Found;

static_assert(AnswersTouches<OpenVdbDetector> && AnswersNearest<OpenVdbDetector> &&
              !AnswersSweep<OpenVdbDetector>);

/// The closed box of half the edges `half` about the origin, normals outward.
TriangleMesh box(const Vec3& half) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(half.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  return {corners,
          {{0, 4, 6},
           {0, 6, 2},
           {1, 3, 7},
           {1, 7, 5},
           {0, 1, 5},
           {0, 5, 4},
           {2, 6, 7},
           {2, 7, 3},
           {0, 2, 3},
           {0, 3, 1},
           {4, 5, 7},
           {4, 7, 6}}};
}

/// Asks about places within the band and a little beyond, and expects of distances, decisions and points what
/// the accuracy says.
void expect_to_keep_its_accuracy(const TriangleMesh& mesh, const OpenVdbDetector::Options& options) {
  const OpenVdbDetector field = OpenVdbDetector::build(mesh, options);
  const BruteForce reference = BruteForce::build(mesh);
  const double allowed = field.accuracy().absolute;
  OpenVdbDetector::Session session;
  BruteForce::Session other;
  Random random(7);
  int found = 0;
  for (std::size_t i = 0; i < 3000; ++i) {
    const Vec3 on = mesh.corner(i % mesh.size(), 0) * 0.5 + mesh.corner(i % mesh.size(), 1) * 0.3 +
                    mesh.corner(i % mesh.size(), 2) * 0.2;
    const Probe probe{on + 1.2 * options.band * random.point(), 0.7 * options.band};
    const auto contact = field.nearest(probe, 0.9 * options.band, session);
    const auto expected = reference.nearest(probe, infinity, other);
    if (std::abs(expected->distance - 0.9 * options.band) > allowed) {
      ASSERT_EQ(contact.has_value(), expected->distance <= 0.9 * options.band) << i;
    }
    if (std::abs(expected->distance - probe.radius) > allowed) {
      EXPECT_EQ(field.touches(probe, session), expected->distance <= probe.radius) << i;
    }
    if (!contact) continue;
    ++found;
    EXPECT_NEAR(contact->distance, expected->distance, allowed) << i;
    EXPECT_NEAR((probe.center - contact->point).norm(), contact->distance, 1e-9);
    EXPECT_NEAR(contact->normal.norm(), 1, 1e-9);
    EXPECT_GE(contact->normal.dot(probe.center - contact->point), -1e-12) << i;
  }
  EXPECT_GT(found, 500);
}

TEST(OpenVdb, KeepsItsAccuracyAboutAClosedMeshAtSeveralResolutions) {
  const TriangleMesh mesh = box({1, 0.7, 0.4});
  for (const double voxel : {0.1, 0.05, 0.02}) {
    SCOPED_TRACE(voxel);
    for (const Distances distances : {Distances::with_sign, Distances::without})
      expect_to_keep_its_accuracy(mesh, {.voxel = voxel, .band = 0.3, .distances = distances});
    expect_to_keep_its_accuracy(mesh, {.voxel = voxel, .band = 0.3, .contact = Found::polygon});
  }
}

TEST(OpenVdb, KeepsItsAccuracyAboutAnOpenSurface) {
  const TriangleMesh mesh = bumps(20);
  expect_to_keep_its_accuracy(mesh, {.voxel = 0.03, .band = 0.1, .distances = Distances::without});
  expect_to_keep_its_accuracy(mesh, {.voxel = 0.03, .band = 0.1, .contact = Found::polygon});
}

TEST(OpenVdb, TellsTheNormalOfAFaceFromBothSidesOfIt) {
  const OpenVdbDetector field = OpenVdbDetector::build(box({1, 1, 1}), {.voxel = 0.05, .band = 0.3});
  OpenVdbDetector::Session session;
  for (const double side : {0.123, -0.123}) {
    const auto contact = field.nearest({{0.2, 0.1, 1 + side}, 0}, 0.2, session);
    ASSERT_TRUE(contact);
    EXPECT_NEAR(contact->distance, 0.123, 1e-5);
    EXPECT_NEAR((contact->normal - Vec3(0, 0, side > 0 ? 1 : -1)).norm(), 0, 1e-5);
    EXPECT_NEAR((contact->point - Vec3(0.2, 0.1, 1)).norm(), 0, 1e-5);
    EXPECT_EQ(contact->triangle, std::numeric_limits<TriangleId>::max());
  }
}

TEST(OpenVdb, NamesTheFilesTriangleWhereItMeasuresPolygons) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}, {7, 90});
  const OpenVdbDetector field =
      OpenVdbDetector::build(mesh, {.voxel = 0.05, .band = 0.2, .contact = Found::polygon});
  OpenVdbDetector::Session session;
  const auto low = field.nearest({{0.2, 0.2, 0.1}, 0}, 0.2, session),
             high = field.nearest({{0.8, 0.8, -0.1}, 0}, 0.2, session);
  ASSERT_TRUE(low && high);
  EXPECT_EQ(low->triangle, 7u);
  EXPECT_EQ(high->triangle, 90u);
  EXPECT_DOUBLE_EQ(high->distance, 0.1);
  EXPECT_EQ(high->normal, Vec3(0, 0, -1));
}

TEST(OpenVdb, KnowsNothingBeyondItsBandWhateverTheReach) {
  for (const Found contact : {Found::gradient, Found::polygon}) {
    const OpenVdbDetector field =
        OpenVdbDetector::build(box({1, 1, 1}), {.voxel = 0.05, .band = 0.3, .contact = contact});
    OpenVdbDetector::Session session;
    for (const double side : {1.0, -1.0}) {
      EXPECT_TRUE(field.nearest({{0, 0, 1 + 0.29 * side}, 0}, infinity, session));
      EXPECT_FALSE(field.nearest({{0, 0, 1 + 0.31 * side}, 0}, infinity, session));
      EXPECT_FALSE(field.touches({{0, 0, 1 + 0.31 * side}, 5}, session));
    }
    EXPECT_FALSE(field.nearest({{0, 0, 0}, 0}, infinity, session));
  }
}

TEST(OpenVdb, GivesTheSameAnswerWhateverItIsAskedFirst) {
  expect_asking_changes_no_answer<OpenVdbDetector>(bumps(20), {.voxel = 0.03, .band = 0.2});
  expect_asking_changes_no_answer<OpenVdbDetector>(bumps(20),
                                                   {.voxel = 0.03, .band = 0.2, .contact = Found::polygon});
}

TEST(OpenVdb, AnswersThreadsWithASessionEach) {
  expect_threads_to_get_the_same_bits(OpenVdbDetector::build(bumps(20), {.voxel = 0.03, .band = 0.3}));
  expect_threads_to_get_the_same_bits(
      OpenVdbDetector::build(bumps(20), {.voxel = 0.03, .band = 0.3, .contact = Found::polygon}));
}

TEST(OpenVdb, ASessionMayAskAnotherDetectorNext) {
  OpenVdbDetector::Session session;
  for (const double half : {1.0, 0.5, 1.0}) {
    for (const Found contact : {Found::gradient, Found::polygon}) {
      const OpenVdbDetector field =
          OpenVdbDetector::build(box({half, half, half}), {.voxel = 0.05, .band = 0.2, .contact = contact});
      const auto found = field.nearest({{0, 0, half + 0.125}, 0}, 0.2, session);
      ASSERT_TRUE(found);
      EXPECT_NEAR(found->distance, 0.125, 1e-5);
    }
  }
}

/// The lattice is about the mesh's own box and its numbers are in voxels: no unit and no place is special.
TEST(OpenVdb, AnswersTheSameAtAnyScaleAndFarFromTheOrigin) {
  const TriangleMesh mesh = box({1, 0.5, 0.25});
  const OpenVdbDetector field = OpenVdbDetector::build(mesh);
  for (const double scale : {0x1p-300, 0x1p-30, 0x1p30, 0x1p300}) {
    for (const double offset : {0.0, 0x1p40}) {
      const Vec3 shift = Vec3::Constant(offset);
      const OpenVdbDetector other = OpenVdbDetector::build(mesh.transformed(scale, shift));
      OpenVdbDetector::Session session, other_session;
      for (const double z : {0.25, 0.2578125, 0.265625, 0.2421875}) {
        const Vec3 center(0.3125, -0.125, z);
        const auto expected = field.nearest({center, 0}, infinity, session),
                   contact = other.nearest({scale * (center + shift), 0}, infinity, other_session);
        ASSERT_TRUE(expected && contact) << scale << ' ' << offset << ' ' << z;
        EXPECT_EQ(contact->distance, scale * expected->distance) << scale << ' ' << offset << ' ' << z;
      }
    }
  }
}

TEST(OpenVdb, RefusesWhatMakesNoLattice) {
  const auto build = [](double voxel, double band) {
    OpenVdbDetector::build(box({1, 1, 1}), {.voxel = voxel, .band = band});
  };
  for (const double no_length : {-1.0, infinity, std::nan("")}) {
    EXPECT_THROW(build(no_length, 0.1), std::invalid_argument);
    EXPECT_THROW(build(0.1, no_length), std::invalid_argument);
  }
  EXPECT_THROW(build(1e-5, 0.1), std::invalid_argument);   // voxels along the box
  EXPECT_THROW(build(2e-4, 0.1), std::invalid_argument);   // memory
  EXPECT_THROW(build(0.1, 1e300), std::invalid_argument);  // voxels along the band
  const TriangleMesh dot({{1, 1, 1}}, {{0, 0, 0}});
  EXPECT_THROW(OpenVdbDetector::build(dot), std::invalid_argument);
}

TEST(OpenVdb, RefusesProbesThatCannotBeSquared) {
  const OpenVdbDetector field = OpenVdbDetector::build(bumps(4));
  OpenVdbDetector::Session session;
  EXPECT_FALSE(field.touches({{1e200, 0, 0}, 1}, session));
  EXPECT_FALSE(field.touches({{0, 0, 0}, std::nan("")}, session));
  EXPECT_FALSE(field.touches({{0, 0, 0}, -1}, session));
  EXPECT_FALSE(field.nearest({{std::nan(""), 0, 0}, 1}, 1, session));
}

/// Traps of the library itself, which README.md names.
class OpenVdbTraps : public testing::Test {
 protected:
  /// The level set of the library's own call, of voxels of edge 1.
  static openvdb::FloatGrid::Ptr level_set(const TriangleMesh& mesh) {
    openvdb::initialize();
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec3I> triangles;
    for (const Vec3& v : mesh.vertices())
      points.emplace_back(static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()));
    for (const auto& c : mesh.triangles()) triangles.emplace_back(c[0], c[1], c[2]);
    return openvdb::tools::meshToLevelSet<openvdb::FloatGrid>(
        *openvdb::math::Transform::createLinearTransform(1), points, triangles);
  }
};

TEST_F(OpenVdbTraps, TheBandIsThreeVoxelsAndWhatIsFartherHasItsWidth) {
  const auto grid = level_set(box({20, 20, 20}));
  EXPECT_EQ(grid->tree().getValue({0, 0, 22}), 2);
  EXPECT_EQ(grid->tree().getValue({0, 0, 23}), 3);
  EXPECT_EQ(grid->tree().getValue({0, 0, 40}), 3);
  EXPECT_EQ(grid->tree().getValue({0, 0, 0}), -3);
}

/// Nothing is inside of what is thinner than a voxel, so the distance has no zero there.
TEST_F(OpenVdbTraps, APlateThinnerThanAVoxelHasNoInside) {
  const auto grid = level_set(box({20, 20, 0.25}).transformed(1, {0, 0, 0.5}));
  for (int z = -3; z <= 4; ++z) EXPECT_GT(grid->tree().getValue({0, 0, z}), 0) << z;
}

/// A box in a box: the distance to the inner one is left out, which `unsigned` has.
TEST_F(OpenVdbTraps, ALevelSetLeavesOutWhatLiesInsideOfAClosedMesh) {
  const TriangleMesh outer = box({20, 20, 20}), inner = box({8, 8, 8});
  std::vector<Vec3> vertices(outer.vertices().begin(), outer.vertices().end());
  vertices.insert(vertices.end(), inner.vertices().begin(), inner.vertices().end());
  std::vector<TriangleMesh::Corners> triangles(outer.triangles().begin(), outer.triangles().end());
  for (const auto& c : inner.triangles()) triangles.push_back({c[0] + 8, c[1] + 8, c[2] + 8});
  const TriangleMesh both(vertices, triangles);
  const auto grid = level_set(both);
  EXPECT_EQ(grid->tree().getValue({0, 0, 9}), -3);
  const OpenVdbDetector field =
      OpenVdbDetector::build(both, {.voxel = 1, .band = 3, .distances = Distances::without});
  OpenVdbDetector::Session session;
  EXPECT_TRUE(field.nearest({{0, 0, 9}, 0}, 3, session));
}

TEST_F(OpenVdbTraps, ALevelSetOfAnOpenSurfaceHasNoSign) {
  const auto grid = level_set(square().transformed(40, {-0.5, -0.5, 0.0125}));
  for (int z = -2; z <= 3; ++z) EXPECT_NEAR(grid->tree().getValue({0, 0, z}), std::abs(z - 0.5), 1e-6) << z;
}

}  // namespace
}  // namespace touchmark::baselines
