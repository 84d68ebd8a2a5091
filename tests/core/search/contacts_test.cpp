// Every detector's contacts against the oracle: which triangles are within the reach, in which order, and
// what is written of them, where doubles do not tell: equal distances, reaches that are a distance or an ulp
// off it, no area, far away, tiny, huge.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/oracle/exact/exact_distance.h"
#include "bench/oracle/oracle.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/geometry/point_triangle.h"
#include "core/grid_group/grid_group.h"
#include "core/grid_group/published/published_grid_group.h"
#include "core/sign/signed_detector.h"
#include "core/sphere_cluster/published/published_sphere_cluster.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/bench/oracle/corner_case_meshes.h"

namespace touchmark {
namespace {

static_assert(AnswersContacts<BruteForce> && AnswersContacts<AabbTree> && AnswersContacts<GridGroup> &&
              AnswersContacts<SphereCluster> && AnswersContacts<Signed<SphereCluster>>);

std::vector<NamedMesh> meshes() {
  std::vector<NamedMesh> all = corner_case_meshes();
  CornerCases cases(90);
  std::vector<CornerCases::Corners> soup;
  for (int i = 0; i < 30; ++i) soup.push_back(i % 2 == 0 ? cases.plain() : cases.needle());
  for (const int exponent : {-1060, -131, 199, 1000})
    all.push_back({"soup by 2^" + std::to_string(exponent),
                   mesh_of(soup).transformed(std::ldexp(1.0, exponent), Vec3::Zero())});
  all.push_back({"plate at 2^50", plate(4).transformed(1, Vec3::Constant(0x1p50))});
  all.push_back({"ids of a file",
                 TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}, {7, 9})});
  return all;
}

bool same_bits(const Contact& a, const Contact& b) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  bool equal = a.triangle == b.triangle && bits(a.distance) == bits(b.distance);
  for (int k = 0; k < 3; ++k)
    equal = equal && bits(a.point[k]) == bits(b.point[k]) && bits(a.normal[k]) == bits(b.normal[k]);
  return equal;
}

/// A point, all triangles in the exact order of their distances from it, and reaches to ask for.
struct Question {
  Vec3 center;
  std::vector<std::uint32_t> order;
  std::vector<double> reaches;
  std::vector<std::size_t> counts;  ///< how many are within each reach
};

Question question_at(const bench::oracle::Oracle& oracle, const Vec3& center) {
  const TriangleMesh& mesh = oracle.mesh();
  Question q{center, {}, {0, infinity, 0.3 * mesh.diagonal()}, {}};
  for (std::uint32_t i = 0; i < mesh.size(); ++i) q.order.push_back(i);
  std::stable_sort(q.order.begin(), q.order.end(), [&](std::uint32_t a, std::uint32_t b) {
    // Of two that are as far the oracle names the one listed first.
    const std::array<bench::oracle::Triangle, 2> pair = {bench::oracle::triangle_of(mesh, b),
                                                         bench::oracle::triangle_of(mesh, a)};
    return bench::oracle::nearest_exactly(center, pair).which == 1;
  });
  for (const std::size_t at : {std::size_t{0}, mesh.size() / 3, mesh.size() - 1}) {
    const double distance = oracle.solve(center, q.order[at]).high;
    for (const double reach : {distance, std::nextafter(distance, 0.0), std::nextafter(distance, infinity)})
      q.reaches.push_back(reach);
  }
  for (const double reach : q.reaches)
    q.counts.push_back(static_cast<std::size_t>(
        std::ranges::count_if(q.order, [&](std::uint32_t i) { return oracle.within(i, center, reach); })));
  return q;
}

template <class D>
void examine(const D& detector, const BruteForce& reference, const TriangleMesh& mesh, const Question& q,
             const std::string& what) {
  typename D::Session session;
  std::vector<Contact> room(mesh.size() + 1), expected(mesh.size());
  for (std::size_t i = 0; i < q.reaches.size(); ++i) {
    const double reach = q.reaches[i];
    const std::string where = what + ", reach " + std::to_string(reach);
    BruteForce::Session plain;
    reference.contacts({q.center, 0}, reach, plain, expected);
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{1}, std::size_t{3}, std::size_t{16}, room.size()}) {
      const std::span<Contact> into = std::span(room).first(std::min(size, room.size()));
      ASSERT_EQ(detector.contacts({q.center, 0}, reach, session, into), q.counts[i]) << where;
      for (std::size_t k = 0; k < std::min(into.size(), q.counts[i]); ++k) {
        ASSERT_EQ(into[k].triangle, mesh.id(q.order[k])) << where << ", contact " << k << " of " << size;
        ASSERT_TRUE(same_bits(into[k], expected[k])) << where << ", contact " << k;
        ASSERT_LE(into[k].distance, reach) << where;
      }
      if constexpr (AnswersNearestContacts<D>) {
        const std::size_t fit = std::min(into.size(), q.counts[i]);
        std::ranges::fill(into, Contact{});
        ASSERT_EQ(detector.nearest_contacts({q.center, 0}, reach, session, into), fit) << where;
        for (std::size_t k = 0; k < fit; ++k)
          ASSERT_TRUE(same_bits(into[k], expected[k])) << where << ", contact " << k << " of the nearest";
      }
    }
    const auto nearest = detector.nearest({q.center, 0}, reach, session);
    ASSERT_EQ(nearest.has_value(), q.counts[i] > 0) << where;
    if (nearest) {
      ASSERT_TRUE(same_bits(*nearest, expected[0])) << where;
    }
  }
}

TEST(Contacts, AreThoseOfTheOracleInItsOrderForEveryDetector) {
  CornerCases cases(91);
  for (const NamedMesh& named : meshes()) {
    const TriangleMesh& mesh = named.mesh;
    const bench::oracle::Oracle oracle(mesh, 1);
    const BruteForce brute = BruteForce::build(mesh);
    const AabbTree tree = AabbTree::build(mesh);
    const GridGroup direct = GridGroup::build(mesh);
    const auto scan = PublishedGridGroup::build(mesh);
    const SphereCluster spheres = SphereCluster::build(mesh),
                        portable = SphereCluster::build(mesh, {.widest = Simd::portable});
    const auto published = PublishedSphereCluster::build(mesh);
    int point = 0;
    for (const Vec3& center : corner_case_points(mesh, cases, 9)) {
      const std::string where = named.name + ", point " + std::to_string(point++);
      if (std::isinf(oracle.solve(center).high)) continue;
      const Question q = question_at(oracle, center);
      examine(brute, brute, mesh, q, where + ", brute force");
      examine(tree, brute, mesh, q, where + ", aabb tree");
      examine(direct, brute, mesh, q, where + ", grid group");
      examine(scan, brute, mesh, q, where + ", grid group scan");
      examine(spheres, brute, mesh, q, where + ", sphere cluster");
      examine(portable, brute, mesh, q, where + ", sphere cluster, portable");
      examine(published, brute, mesh, q, where + ", sphere cluster scan");
      if (HasFatalFailure()) return;
    }
  }
}

/// Triangles that touch a ball about 0 from without: doubles do not tell which is nearer.
TriangleMesh tangents_of_ball(std::uint32_t count) {
  CornerCases cases(92);
  std::vector<CornerCases::Corners> all;
  for (std::uint32_t i = 0; i < count; ++i) {
    const CornerCases::Corners plain = cases.plain();
    const Vec3 normal = (plain[1] - plain[0]).cross(plain[2] - plain[0]).normalized();
    const Vec3 a = normal.unitOrthogonal(), b = normal.cross(a);
    all.push_back({normal + 0.1 * a, normal - 0.1 * a + 0.1 * b, normal - 0.1 * a - 0.1 * b});
  }
  return mesh_of(all);
}

TEST(Contacts, KeepTheExactOrderOfManyThatAreAboutAsNear) {
  const TriangleMesh mesh = tangents_of_ball(150);
  const bench::oracle::Oracle oracle(mesh, 1);
  const Question q = question_at(oracle, Vec3::Zero());
  const BruteForce brute = BruteForce::build(mesh);
  examine(brute, brute, mesh, q, "brute force");
  examine(GridGroup::build(mesh), brute, mesh, q, "grid group");
  examine(SphereCluster::build(mesh), brute, mesh, q, "sphere cluster");
  // Else this would be no test of the order.
  int out_of_order = 0;
  const auto computed = [&](std::size_t at) {
    return std::sqrt(squared_distance(prepare(mesh, q.order[at]), Vec3::Zero()));
  };
  for (std::size_t at = 1; at < q.order.size(); ++at) out_of_order += computed(at - 1) > computed(at) ? 1 : 0;
  EXPECT_GT(out_of_order, 10);
}

template <class D>
class ContactsOf : public testing::Test {};

using Detectors = testing::Types<BruteForce, AabbTree, GridGroup, SphereCluster, Signed<AabbTree>>;
TYPED_TEST_SUITE(ContactsOf, Detectors);

TYPED_TEST(ContactsOf, AreNoneForWhatIsNoNumberAndForANegativeReach) {
  const TypeParam detector = TypeParam::build(plate(3));
  typename TypeParam::Session session;
  std::array<Contact, 4> room;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(detector.contacts({{1, 1, 1}, 0}, nan, session, room), 0u);
  EXPECT_EQ(detector.contacts({{1, 1, 0}, 0}, -1, session, room), 0u);
  EXPECT_EQ(detector.contacts({{nan, 1, 0}, 0}, infinity, session, room), 0u);
  EXPECT_EQ(detector.contacts({{1, infinity, 0}, 0}, infinity, session, room), 0u);
  EXPECT_EQ(detector.contacts({{1, 1, 0}, nan}, infinity, session, room), 18u);  // the radius plays no part
}

TYPED_TEST(ContactsOf, AtAVertexAreItsTrianglesByIdAndTheFaceNormal) {
  const TypeParam detector = TypeParam::build(plate(3));
  typename TypeParam::Session session;
  std::array<Contact, 8> room;
  ASSERT_EQ(detector.contacts({{1, 1, 0}, 0}, 0, session, room), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(room[i].distance, 0);
    EXPECT_EQ(std::abs(room[i].normal.z()), 1);
    if (i > 0) {
      EXPECT_LT(room[i - 1].triangle, room[i].triangle);
    }
  }
}

TYPED_TEST(ContactsOf, FollowTheMeshOfAnUpdateFromASessionBegunBefore) {
  TypeParam detector = TypeParam::build(plate(3));
  typename TypeParam::Session session;
  std::array<Contact, 32> room;
  ASSERT_EQ(detector.contacts({{1, 1, 2}, 0}, 1.5, session, room), 0u);
  detector.update(plate(3).transformed(1, {0, 0, 1}));
  ASSERT_EQ(detector.contacts({{1, 1, 2}, 0}, 1, session, room), 6u);
  EXPECT_EQ(room[0].distance, 1);
}

TEST(Contacts, HaveTheSideOfTheCentreAllOfThem) {
  const TriangleMesh tetrahedron({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                 {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  const auto detector = Signed<AabbTree>::build(tetrahedron);
  Signed<AabbTree>::Session session;
  std::array<Contact, 8> room;
  ASSERT_EQ(detector.contacts({{0.125, 0.25, 0.25}, 0}, 1, session, room), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(room[i].side, Side::inside);
  ASSERT_EQ(detector.contacts({{-0.5, 0.25, 0.25}, 0}, 0.5, session, std::span(room).first(1)), 1u);
  EXPECT_EQ(room[0].side, Side::outside);
}

TEST(Contacts, OfTheFastLevelAreItsSpheres) {
  const TriangleMesh mesh = plate(4);
  const auto detector = PublishedSphereCluster::build(mesh, {.precise = false});
  PublishedSphereCluster::Session session;
  std::vector<Contact> room(mesh.size());
  const Vec3 center(1.3, 2.1, 0.4);
  const std::size_t count = detector.contacts({center, 0}, 0.5, session, room);
  ASSERT_GT(count, 4u);
  ASSERT_LT(count, mesh.size());
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_LE(room[i].distance, 0.5);
    if (i > 0) {
      EXPECT_GE(room[i].distance, room[i - 1].distance);
    }
  }
  const auto nearest = detector.nearest({center, 0}, 0.5, session);
  ASSERT_TRUE(nearest);
  EXPECT_TRUE(same_bits(*nearest, room[0]));
}

TEST(Contacts, AsDoublesHaveThemWhereNothingIsCertified) {
  const TriangleMesh mesh = octasphere(4);
  const AabbTree tree = AabbTree::build(mesh, {.certified = false});
  const GridGroup grid = GridGroup::build(mesh, {.certified = false});
  const SphereCluster spheres = SphereCluster::build(mesh, {.certified = false});
  AabbTree::Session a;
  GridGroup::Session b;
  SphereCluster::Session c;
  std::vector<Contact> of_tree(mesh.size()), of_grid(mesh.size()), of_spheres(mesh.size());
  for (int i = 0; i < 50; ++i) {
    const Vec3 center(1 + 0.01 * i, 0.02 * i, 0.3);
    const std::size_t count = tree.contacts({center, 0}, 0.6, a, of_tree);
    ASSERT_EQ(grid.contacts({center, 0}, 0.6, b, of_grid), count);
    ASSERT_EQ(spheres.contacts({center, 0}, 0.6, c, of_spheres), count);
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_TRUE(same_bits(of_tree[k], of_grid[k]));
      EXPECT_TRUE(same_bits(of_tree[k], of_spheres[k]));
    }
  }
}

}  // namespace
}  // namespace touchmark
