// After update() every detector gives the bits that brute force gives on the mesh as it is now: from the
// session it was asked with before, and from fresh ones.
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bench/support/random.h"
#include "bench/workload/answer.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/grid_group/grid_group.h"
#include "core/grid_group/published/published_grid_group.h"
#include "core/sign/signed_detector.h"
#include "core/sphere_cluster/published/published_sphere_cluster.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/sphere_cluster/test_meshes.h"

namespace touchmark {
namespace {

using bench::support::Random;
using bench::workload::Answer;

static_assert(Updates<BruteForce> && Updates<AabbTree> && Updates<SphereCluster> && Updates<GridGroup>);
static_assert(Updates<Signed<SphereCluster>>);

TriangleMesh with_vertices(const TriangleMesh& mesh, std::vector<Vec3> vertices) {
  return {std::move(vertices),
          {mesh.triangles().begin(), mesh.triangles().end()},
          {mesh.ids().begin(), mesh.ids().end()}};
}

/// Vertices within `part` of the diagonal from one of them move by as much at most, less towards the border.
TriangleMesh dented(const TriangleMesh& mesh, double part, Random& random) {
  std::vector<Vec3> vertices(mesh.vertices().begin(), mesh.vertices().end());
  const Vec3 middle = vertices[random.below(vertices.size())], direction = random.direction();
  const double radius = part * mesh.diagonal();
  for (Vec3& v : vertices) v += std::max(0.0, radius - (v - middle).norm()) * direction;
  return with_vertices(mesh, std::move(vertices));
}

/// Every vertex moves by up to `part` of the diagonal on its own: no tree fits well after that.
TriangleMesh shaken(const TriangleMesh& mesh, double part, Random& random) {
  std::vector<Vec3> vertices(mesh.vertices().begin(), mesh.vertices().end());
  for (Vec3& v : vertices) v += part * mesh.diagonal() * random.unit() * random.direction();
  return with_vertices(mesh, std::move(vertices));
}

/// One mesh after the other, all of the same triangles; the last is the first again.
std::vector<TriangleMesh> frames_of(const TriangleMesh& mesh) {
  Random random(11);
  std::vector<TriangleMesh> frames{mesh};
  frames.push_back(dented(frames.back(), 0.05, random));
  frames.push_back(dented(frames.back(), 0.2, random));
  frames.push_back(shaken(frames.back(), 0.01, random));
  frames.push_back(frames.back());
  frames.push_back(shaken(mesh, 0.3, random));
  frames.push_back(mesh.transformed(100, Vec3(0, 0, 0)));
  frames.push_back(mesh.transformed(1, Vec3(0.3, 0.2, 0) * mesh.diagonal()));
  frames.push_back(mesh);
  return frames;
}

/// A walk along the surface, as it is in this frame and the next one, with leaps now and then.
std::vector<Vec3> centers_for(const TriangleMesh& now, const TriangleMesh& next) {
  Random random(5);
  std::vector<Vec3> centers;
  for (int i = 0; i < 10; ++i) {
    const TriangleMesh& mesh = i % 2 == 0 ? now : next;
    const Vec3& v = mesh.vertices()[random.below(mesh.vertices().size())];
    const double away = (i % 5 == 0 ? 0.3 : 0.005) * mesh.diagonal();
    for (int step = 0; step < 3; ++step) centers.push_back(v + away * random.unit() * random.direction());
  }
  return centers;
}

template <class D>
std::vector<Answer> answers(const D& detector, const std::vector<Vec3>& centers, double radius,
                            typename D::Session& session) {
  std::vector<Answer> all;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const Probe probe{centers[i], radius};
    for (const double reach : {radius, infinity}) {
      const auto contact = detector.nearest(probe, reach, session);
      all.push_back(contact ? Answer::of(*contact) : Answer{});
    }
    Answer touch;
    touch.found = detector.touches(probe, session) ? 1 : 0;
    all.push_back(touch);
    const auto impact = detector.first_hit({centers[i > 0 ? i - 1 : 0], probe.center, radius}, session);
    all.push_back(impact ? Answer::of(impact->contact, impact->fraction) : Answer{});
  }
  return all;
}

/// The first answer that differs in any bit; none: their number.
std::size_t first_difference(const std::vector<Answer>& a, const std::vector<Answer>& b) {
  std::size_t i = 0;
  while (i < a.size() && i < b.size() && std::memcmp(&a[i], &b[i], sizeof(Answer)) == 0) ++i;
  return i;
}

/// A mesh as it becomes, with what is asked then and the right answers.
struct Frame {
  TriangleMesh mesh;
  std::vector<Vec3> centers;
  double radius;
  std::vector<Answer> expected;
};

std::vector<Frame> film_of(const TriangleMesh& mesh) {
  const std::vector<TriangleMesh> meshes = frames_of(mesh);
  std::vector<Frame> film;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const TriangleMesh &now = meshes[i], &next = meshes[std::min(i + 1, meshes.size() - 1)];
    Frame frame{now, centers_for(now, next), 0.005 * now.diagonal(), {}};
    BruteForce::Session session;
    frame.expected = answers(BruteForce::build(now), frame.centers, frame.radius, session);
    film.push_back(std::move(frame));
  }
  return film;
}

template <class D>
void expect_bits_of_brute_force(const std::vector<Frame>& film, const typename D::Options& options,
                                const std::string& name) {
  D detector = D::build(film.front().mesh, options);
  typename D::Session kept;
  for (std::size_t i = 0; i < film.size(); ++i) {
    SCOPED_TRACE(name + ", frame " + std::to_string(i));
    const Frame& frame = film[i];
    if (i > 0) detector.update(frame.mesh);
    typename D::Session fresh;
    const std::size_t all = frame.expected.size();
    EXPECT_EQ(first_difference(answers(detector, frame.centers, frame.radius, kept), frame.expected), all);
    EXPECT_EQ(first_difference(answers(detector, frame.centers, frame.radius, fresh), frame.expected), all);
  }
}

TEST(Update, GivesTheBitsOfBruteForceOnTheMeshAsItIsNow) {
  for (const test::NamedMesh& named : test::test_meshes()) {
    // Where squares of lengths leave the range of double, detectors are built anew, and sweeps not exact.
    if (named.size < 1e-100 || named.size > 1e100) continue;
    const std::vector<Frame> film = film_of(named.mesh);
    expect_bits_of_brute_force<BruteForce>(film, {}, "brute-force, " + named.name);
    expect_bits_of_brute_force<AabbTree>(film, {}, "aabb-tree, " + named.name);
    expect_bits_of_brute_force<SphereCluster>(film, {}, "sphere-cluster, " + named.name);
    expect_bits_of_brute_force<SphereCluster>(film, {.widest = Simd::portable}, "portable, " + named.name);
    expect_bits_of_brute_force<SphereCluster>(film, {.construction = SphereCluster::Construction::lazy},
                                              "sphere-cluster, lazy, " + named.name);
    expect_bits_of_brute_force<GridGroup>(film, {}, "grid-group, " + named.name);
    expect_bits_of_brute_force<GridGroup>(film, {.construction = GridGroup::Construction::lazy},
                                          "lazy, " + named.name);
  }
}

TEST(Update, OfTheFormsAsPublishedDoesTheSame) {
  const std::vector<Frame> film = film_of(test::bumpy_sphere(8, 0.05, 1));
  expect_bits_of_brute_force<PublishedSphereCluster>(film, {}, "spheres");
  expect_bits_of_brute_force<PublishedGridGroup>(film, {}, "groups");
}

/// The free room that a session knows of is not free when the mesh has come there.
template <class D>
void expect_to_notice_what_came(const typename D::Options& options) {
  const TriangleMesh mesh = test::bumpy_sphere(12, 0, 1);
  D detector = D::build(mesh, options);
  typename D::Session session;
  const Vec3 outside(1.3, 0, 0);
  EXPECT_FALSE(detector.touches({outside, 0.05}, session));
  EXPECT_FALSE(detector.nearest({outside, 0.05}, 0.05, session));
  std::vector<Vec3> vertices(mesh.vertices().begin(), mesh.vertices().end());
  for (Vec3& v : vertices)
    if (v.x() > 0.8) v += Vec3(0.3, 0, 0);
  detector.update(with_vertices(mesh, vertices));
  EXPECT_TRUE(detector.touches({outside, 0.05}, session));
  detector.update(mesh);
  EXPECT_FALSE(detector.touches({outside, 0.05}, session));
  EXPECT_FALSE(detector.nearest({outside, 0.05}, 0.05, session));
  detector.update(with_vertices(mesh, vertices));
  EXPECT_TRUE(detector.nearest({outside, 0.05}, 0.05, session));
}

TEST(Update, IsNoticedBySessionsThatWereInFreeSpace) {
  expect_to_notice_what_came<AabbTree>({});
  expect_to_notice_what_came<SphereCluster>({});
  expect_to_notice_what_came<GridGroup>({});
  expect_to_notice_what_came<Signed<SphereCluster>>({});
}

template <class D>
void expect_to_refuse_other_triangles() {
  const std::vector<Vec3> vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}};
  const TriangleMesh mesh(vertices, {{0, 1, 2}, {1, 3, 2}}, {4, 7});
  D detector = D::build(mesh, {});
  const auto refuses = [&](const TriangleMesh& other) {
    EXPECT_THROW(detector.update(other), std::invalid_argument);
  };
  refuses({vertices, {{0, 1, 2}}, {4}});
  refuses({vertices, {{0, 1, 2}, {1, 2, 3}}, {4, 7}});
  refuses({vertices, {{0, 1, 2}, {1, 3, 2}}, {4, 8}});
  refuses({vertices, {{0, 1, 2}, {1, 3, 2}}});
  refuses({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}, {1, 3, 2}}, {4, 7}});
  typename D::Session session;
  EXPECT_EQ(detector.nearest({{1, 1, 2}, 0}, infinity, session)->triangle, 7U);
}

TEST(Update, RefusesOtherTrianglesAndStaysAsItWas) {
  expect_to_refuse_other_triangles<BruteForce>();
  expect_to_refuse_other_triangles<AabbTree>();
  expect_to_refuse_other_triangles<SphereCluster>();
  expect_to_refuse_other_triangles<GridGroup>();
}

/// There and back, a query takes the same work as of what is built.
template <class D>
void expect_the_work_of_what_is_built() {
  const TriangleMesh mesh = test::bumpy_sphere(40, 0.02, 1);
  const D built = D::build(mesh);
  D updated = D::build(mesh);
  Random dents(7);
  updated.update(dented(mesh, 0.1, dents));
  updated.update(mesh);
  typename D::Session a, b;
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const Vec3 center = 1.2 * random.unit() * random.direction();
    built.nearest({center, 0}, infinity, a);
    updated.nearest({center, 0}, infinity, b);
  }
  EXPECT_NEAR(static_cast<double>(b.work.total()), static_cast<double>(a.work.total()),
              0.01 * static_cast<double>(a.work.total()));
}

TEST(Update, LeavesBoundsAsTightAsTheyWere) {
  expect_the_work_of_what_is_built<SphereCluster>();  // but for samples that were bounded by others
  expect_the_work_of_what_is_built<GridGroup>();
}

}  // namespace
}  // namespace touchmark
