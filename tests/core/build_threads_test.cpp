// Built by any number of threads (std::thread, in core/search/threads/parallel.cpp), a detector is the same
// bits: answers, work and bytes say so.
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bench/support/random.h"
#include "bench/workload/answer.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/aabb_tree/float_tree.h"
#include "core/grid_group/grid_group.h"
#include "core/search/threads/parallel.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/sphere_cluster/test_meshes.h"

namespace touchmark {
namespace {

using bench::workload::Answer;

/// So large that what is built is shared out, in several shapes.
std::vector<TriangleMesh> meshes() {
  return {test::bumpy_sphere(50, 0.05, 1), test::soup(6000, 0.1, 2), test::plate(60), test::slivers(3000)};
}

/// What there is to see of a detector.
struct Seen {
  std::vector<Answer> answers;
  std::vector<std::uint64_t> work;
  std::size_t bytes;
};

/// Points all over the mesh's box and about it, one after the other near the one before.
std::vector<Vec3> path(const Aabb& bounds) {
  bench::support::Random random(5);
  std::vector<Vec3> points;
  for (int walk = 0; walk < 100; ++walk) {
    Vec3 at = bounds.center() + 0.7 * random.unit() * bounds.extent().norm() * random.direction();
    for (int step = 0; step < 8; ++step)
      points.push_back(at += 0.002 * bounds.diagonal() * random.direction());
  }
  return points;
}

template <class D>
Seen look_at(const D& detector, const Aabb& bounds) {
  Seen seen{{}, {}, detector.bytes()};
  typename D::Session session;
  const double radius = 0.01 * bounds.diagonal();
  const auto note = [&](const Answer& answer) {
    seen.answers.push_back(answer);
    const Work& work = session.work;
    for (const std::uint64_t count :
         {work.cells, work.spheres, work.boxes, work.triangles, work.exact_decisions})
      seen.work.push_back(count);
  };
  Vec3 before = bounds.center();
  for (const Vec3& point : path(bounds)) {
    const Probe probe{point, radius};
    for (const double reach : {radius, std::numeric_limits<double>::infinity()}) {
      const auto contact = detector.nearest(probe, reach, session);
      note(contact ? Answer::of(*contact) : Answer{});
    }
    Answer touch;
    touch.found = detector.touches(probe, session) ? 1 : 0;
    note(touch);
    if constexpr (requires { detector.first_hit(Sweep{before, point, radius}, session); }) {
      const auto impact = detector.first_hit({before, point, radius}, session);
      note(impact ? Answer::of(impact->contact, impact->fraction) : Answer{});
    }
    before = point;
  }
  return seen;
}

void expect_same(const Seen& found, const Seen& expected, const std::string& what) {
  ASSERT_EQ(found.answers.size(), expected.answers.size()) << what;
  EXPECT_EQ(std::memcmp(found.answers.data(), expected.answers.data(), found.answers.size() * sizeof(Answer)),
            0)
      << what;
  EXPECT_EQ(found.work, expected.work) << what;
  EXPECT_EQ(found.bytes, expected.bytes) << what;
}

template <class D>
class BuildThreads : public testing::Test {};
using Detectors = testing::Types<AabbTree, FloatTree, GridGroup, SphereCluster>;
TYPED_TEST_SUITE(BuildThreads, Detectors);

TYPED_TEST(BuildThreads, MakeNoDifferenceButOfTime) {
  int number = 0;
  for (const TriangleMesh& mesh : meshes()) {
    typename TypeParam::Options options;
    const Seen expected = look_at(TypeParam::build(mesh, options), mesh.bounds());
    for (const unsigned threads : {3U}) {
      options.threads = threads;
      expect_same(look_at(TypeParam::build(mesh, options), mesh.bounds()), expected,
                  "mesh " + std::to_string(number) + ", threads " + std::to_string(threads));
    }
    ++number;
  }
}

TYPED_TEST(BuildThreads, ServeMeshesOfATriangleOrTwo) {
  for (const std::uint32_t count : {1U, 2U, 9U}) {
    const TriangleMesh mesh = test::soup(count, 0.1, 4);
    typename TypeParam::Options options;
    const Seen expected = look_at(TypeParam::build(mesh, options), mesh.bounds());
    options.threads = 3;
    expect_same(look_at(TypeParam::build(mesh, options), mesh.bounds()), expected, std::to_string(count));
  }
}

TYPED_TEST(BuildThreads, ServeAMeshTooFarFromZeroForSamples) {
  const TriangleMesh near = test::plate(30);
  std::vector<Vec3> vertices(near.vertices().begin(), near.vertices().end());
  for (Vec3& vertex : vertices) vertex += Vec3(1e9, 1e9, 1e9);
  const TriangleMesh mesh(std::move(vertices), {near.triangles().begin(), near.triangles().end()});
  typename TypeParam::Options options;
  const Seen expected = look_at(TypeParam::build(mesh, options), mesh.bounds());
  options.threads = 2;
  expect_same(look_at(TypeParam::build(mesh, options), mesh.bounds()), expected, "far from zero");
}

TYPED_TEST(BuildThreads, MayNotBeTooMany) {
  typename TypeParam::Options options;
  options.threads = max_threads + 1;
  try {
    TypeParam::build(test::plate(2), options);
    ADD_FAILURE() << "it was built";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("threads is 257, more than 256"), std::string::npos)
        << error.what();
  }
}

template <class D>
void expect_same_update() {
  const TriangleMesh mesh = test::bumpy_sphere(50, 0.05, 1);
  std::vector<Vec3> vertices(mesh.vertices().begin(), mesh.vertices().end());
  for (std::size_t i = 0; i < vertices.size(); i += 3) vertices[i] *= 1.01;
  const TriangleMesh moved(std::move(vertices), {mesh.triangles().begin(), mesh.triangles().end()});
  std::array<Seen, 2> seen;
  for (unsigned i = 0; i < 2; ++i) {
    typename D::Options options;
    options.threads = 1 + i;
    D detector = D::build(mesh, options);
    detector.update(moved);
    seen[i] = look_at(detector, moved.bounds());
  }
  expect_same(seen[1], seen[0], "after an update");
}

TEST(BuildThreadsOfUpdates, MakeNoDifferenceEither) {
  expect_same_update<AabbTree>();
  expect_same_update<GridGroup>();
  expect_same_update<SphereCluster>();
}

TEST(BuildThreadsOfClusters, KeepClustersTogetherAlike) {
  const TriangleMesh mesh = test::bumpy_sphere(50, 0.05, 1);
  SphereCluster::Options options;
  options.clustering = 0.05 * mesh.diagonal();
  const Seen expected = look_at(SphereCluster::build(mesh, options), mesh.bounds());
  options.threads = 2;
  expect_same(look_at(SphereCluster::build(mesh, options), mesh.bounds()), expected, "clusters");
}

}  // namespace
}  // namespace touchmark
