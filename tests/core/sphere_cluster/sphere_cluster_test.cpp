#include "core/sphere_cluster/sphere_cluster.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/sphere_cluster/published/published_sphere_cluster.h"
#include "tests/core/sphere_cluster/test_meshes.h"
#include "tests/core/touch_then_nearest.h"

namespace touchmark {
namespace {

static_assert(AnswersTouches<SphereCluster> && AnswersNearest<SphereCluster> && AnswersSweep<SphereCluster>);
static_assert(Prepares<SphereCluster>);
static_assert(Updates<PublishedSphereCluster> && AnswersTouches<PublishedSphereCluster> &&
              AnswersNearest<PublishedSphereCluster> && AnswersSweep<PublishedSphereCluster> &&
              AnswersContacts<PublishedSphereCluster>);

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Calls check.operator()<D>(options) for the published form and ours.
template <class Check>
void for_each_exact_form(double size, const Check& check) {
  using Options = SphereCluster::Options;
  for (const double clustering : {0.0, 0.1 * size})
    check.template operator()<PublishedSphereCluster>({.clustering = clustering});
  for (const Options& options : {Options{}, Options{.widest = Simd::portable}, Options{.widest = Simd::avx2},
                                 Options{.clustering = 0.1 * size}})
    check.template operator()<SphereCluster>(options);
}

/// Bit for bit; NaN equals NaN (a contact at infinite distance has no point).
bool same_bits(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

void expect_same(const Contact& a, const Contact& b) {
  EXPECT_EQ(a.triangle, b.triangle);
  EXPECT_TRUE(same_bits(a.distance, b.distance)) << a.distance << " against " << b.distance;
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(same_bits(a.point[k], b.point[k]));
    EXPECT_TRUE(same_bits(a.normal[k], b.normal[k]));
  }
}

void expect_same(const std::optional<Contact>& a, const std::optional<Contact>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (a) expect_same(*a, *b);
}

void expect_same(const std::optional<Impact>& a, const std::optional<Impact>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  EXPECT_EQ(a->fraction, b->fraction);
  expect_same(a->contact, b->contact);
}

std::string label(const test::NamedMesh& named, const PublishedSphereCluster::Options& options) {
  return named.name + ", scan, clustering " + std::to_string(options.clustering);
}

std::string label(const test::NamedMesh& named, const SphereCluster::Options& options) {
  return named.name + ", tree, clustering " + std::to_string(options.clustering) +
         (options.widest == Simd::portable ? ", portable" : ", avx2");
}

TEST(SphereCluster, FindsTheNearestOfTwoTriangles) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}, {3, 9});
  for_each_exact_form(1, [&]<class D>(const typename D::Options& options) {
    const D detector = D::build(mesh, options);
    typename D::Session session;
    const auto contact = detector.nearest({{0.75, 0.75, 2}, 0}, infinity, session);
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->triangle, 9u);
    EXPECT_EQ(contact->distance, 2);
    EXPECT_EQ(contact->normal, Vec3(0, 0, 1));
    EXPECT_EQ(contact->point, Vec3(0.75, 0.75, 0));
    EXPECT_FALSE(detector.nearest({{0.75, 0.75, 2}, 0}, std::nextafter(2.0, 0.0), session));
  });
}

TEST(SphereCluster, ContactIsClosed) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  for_each_exact_form(1, [&]<class D>(const typename D::Options& options) {
    const D detector = D::build(mesh, options);
    typename D::Session session;
    EXPECT_TRUE(detector.touches({{0.25, 0.25, 0.5}, 0.5}, session));
    EXPECT_FALSE(detector.touches({{0.25, 0.25, 0.5}, std::nextafter(0.5, 0)}, session));
  });
}

TEST(SphereCluster, EqualsBruteForceBitForBitOnEveryMesh) {
  for (const auto& named : test::test_meshes()) {
    const BruteForce oracle = BruteForce::build(named.mesh);
    for_each_exact_form(named.size, [&]<class D>(const typename D::Options& options) {
      SCOPED_TRACE(label(named, options));
      const D detector = D::build(named.mesh, options);
      typename D::Session used;
      BruteForce::Session oracle_session;
      test::Random random(17);
      for (int step = 0; step < 100; ++step) {
        const Vec3 center = test::random_point(named, random);
        const double radius = named.size * random.between(0, 0.1);
        const double exact = oracle.nearest({center, 0}, infinity, oracle_session)->distance;
        for (const double reach : {radius, exact, std::nextafter(exact, 0.0), 0.0, infinity}) {
          const auto expected = oracle.nearest({center, 0}, reach, oracle_session);
          typename D::Session fresh;
          expect_same(detector.nearest({center, 0}, reach, used), expected);
          expect_same(detector.nearest({center, 0}, reach, fresh), expected);
          EXPECT_EQ(detector.touches({center, reach}, used), expected.has_value());
          EXPECT_EQ(detector.touches({center, reach}, fresh), expected.has_value());
        }
        if (HasFailure()) return;
      }
    });
  }
}

TEST(SphereCluster, EqualsBruteForceOnACoherentWay) {
  for (const auto& named : test::test_meshes()) {
    const BruteForce oracle = BruteForce::build(named.mesh);
    for_each_exact_form(named.size, [&]<class D>(const typename D::Options& options) {
      SCOPED_TRACE(label(named, options));
      const D detector = D::build(named.mesh, options);
      typename D::Session used;
      BruteForce::Session oracle_session;
      test::Random random(19);
      Vec3 center = test::random_point(named, random);
      for (int step = 0; step < 600; ++step) {
        if (step % 200 == 199) center = test::random_point(named, random);
        center += random.point(0.01 * named.size);
        const double reach = step % 3 == 0 ? infinity : 0.05 * named.size;
        expect_same(detector.nearest({center, 0}, reach, used),
                    oracle.nearest({center, 0}, reach, oracle_session));
        const Probe probe{center, 0.1 * named.size};
        EXPECT_EQ(detector.touches(probe, used), oracle.touches(probe, oracle_session));
        if constexpr (Prepares<D>) {
          if (step % 5 < 2) detector.prepare(used);
        }
        if (HasFailure()) return;
      }
    });
  }
}

TEST(SphereCluster, AMissedTouchLeavesNoMoreFreeSpaceThanThereIs) {
  // The collinear triangle has no planes for a filter to reject it by, so the search sees it at 1.05; what
  // the filter leaves out is 3 away.
  const TriangleMesh mesh({{1.05, 0, 0}, {1.05, 0.1, 0}, {1.05, 0.2, 0}, {-3, 0, 0}, {-3, 1, 0}, {-3, 0, 1}},
                          {{0, 1, 2}, {3, 4, 5}});
  for_each_exact_form(1, [&]<class D>(const typename D::Options& options) {
    const D detector = D::build(mesh, options);
    typename D::Session session;
    EXPECT_FALSE(detector.touches({{0, 0, 0}, 1}, session));
    EXPECT_TRUE(detector.touches({{0.5, 0, 0}, 1}, session));
  });
}

// A touch ends at any triangle within the radius; what a session remembers of it is no bound of the nearest.
TEST(SphereCluster, ATouchTellsNothingOfWhatIsNearerThanWhatItFound) {
  test::Random random(59);
  for (const TriangleMesh& mesh : {test::bumpy_sphere(40, 0.01, 7), test::soup(3000, 0.05, 2)}) {
    const BruteForce brute = BruteForce::build(mesh, {});
    for_each_exact_form(1, [&]<class D>(const typename D::Options& options) {
      const D detector = D::build(mesh, options);
      typename D::Session session;
      for (int i = 0; i < 500; ++i) {
        const Vec3 center = random.point(i % 3 == 0 ? 3 : 1.3);
        BruteForce::Session measured;
        const auto contact = brute.nearest({center, 0}, infinity, measured);
        expect_same(test::nearest_after_touches(detector, center, contact->distance, session), contact);
        ASSERT_FALSE(HasFailure());
      }
    });
  }
}

TEST(SphereCluster, EqualsBruteForceWhereMoreIsNearThanASessionRemembers) {
  // About the centre of a sphere all of its triangles are equally near, but for the bumps.
  for (const double noise : {0.0, 1e-3}) {
    const TriangleMesh mesh = test::bumpy_sphere(24, noise, 37);
    const BruteForce oracle = BruteForce::build(mesh);
    for_each_exact_form(1, [&]<class D>(const typename D::Options& options) {
      const D detector = D::build(mesh, options);
      BruteForce::Session oracle_session;
      test::Random random(41);
      // New sessions, because one that could not list what is near waits ever longer before it tries again.
      for (int way = 0; way < 30; ++way) {
        typename D::Session used;
        Vec3 center = Vec3::Zero();
        for (int step = 0; step < 10; ++step) {
          center += random.point(step % 2 == 0 ? 3e-3 : 1e-3);
          expect_same(detector.nearest({center, 0}, infinity, used),
                      oracle.nearest({center, 0}, infinity, oracle_session));
          if (HasFailure()) return;
        }
      }
    });
  }
}

/// The most that one query looked at on a steady way over a bumpy sphere, once it has begun.
std::uint64_t max_work_on_a_way(bool prepares, std::vector<Contact>& contacts) {
  const SphereCluster detector = SphereCluster::build(test::bumpy_sphere(60, 1e-3, 53));
  SphereCluster::Session session;
  std::uint64_t most = 0;
  for (int step = 0; step < 2000; ++step) {
    const double turn = 5e-4 * step;
    const Vec3 center = 1.001 * Vec3(std::cos(turn), std::sin(turn) * 0.8, std::sin(turn) * 0.6);
    const std::uint64_t before = session.work.total();
    contacts.push_back(detector.nearest({center, 0}, 0.05, session).value());
    if (step > 1) most = std::max(most, session.work.total() - before);
    if (prepares) detector.prepare(session);
  }
  return most;
}

TEST(SphereCluster, PreparingTakesTheListingOutOfTheQueries) {
  std::vector<Contact> unprepared, prepared;
  const std::uint64_t without = max_work_on_a_way(false, unprepared);
  const std::uint64_t with = max_work_on_a_way(true, prepared);
  EXPECT_LT(2 * with, without) << "a listing goes down from the root, a query looks at a list";
  for (std::size_t i = 0; i < prepared.size(); ++i) expect_same(prepared[i], unprepared[i]);
}

// As a proxy asks on its way: sweeps that end where contacts are asked for.
TEST(SphereCluster, PreparingAsksForContactsAgainWhereTheNextSweepBegins) {
  const SphereCluster detector = SphereCluster::build(test::bumpy_sphere(60, 1e-3, 53));
  SphereCluster::Session prepared, plain;
  const auto place = [](int step) -> Vec3 {
    const double turn = 5e-4 * step;
    return 1.011 * Vec3(std::cos(turn), std::sin(turn) * 0.8, std::sin(turn) * 0.6);
  };
  const auto tick = [&](int step, SphereCluster::Session& session, std::vector<double>& told) {
    const std::uint64_t before = session.work.total();
    const auto hit = detector.first_hit({place(step), place(step + 1), 0.009}, session);
    std::array<Contact, 16> into;
    const std::size_t count = detector.nearest_contacts({place(step + 1), 0}, 0.012, session, into);
    told.push_back(hit ? hit->fraction : -1);
    for (std::size_t i = 0; i < count; ++i) told.push_back(into[i].distance);
    return session.work.total() - before;
  };
  std::uint64_t with = 0, without = 0;
  std::vector<double> told_with, told_without;
  for (int step = 0; step < 2000; ++step) {
    detector.prepare(prepared);
    with += tick(step, prepared, told_with);
    without += tick(step, plain, told_without);
  }
  EXPECT_LT(with, without) << "what was listed ahead is not listed in the tick";
  EXPECT_EQ(told_with, told_without);
  EXPECT_GT(told_with.size(), 4000u) << "there is something to tell";
}

TEST(SphereCluster, PreparesNothingWhereNothingIsNear) {
  const SphereCluster detector = SphereCluster::build(test::bumpy_sphere(10, 0, 59));
  SphereCluster::Session session;
  detector.prepare(session);
  EXPECT_FALSE(detector.nearest({{5, 0, 0}, 0}, 0.5, session));
  const std::uint64_t before = session.work.total();
  detector.prepare(session);
  EXPECT_EQ(session.work.total(), before);
}

TEST(SphereCluster, PreparingAsksATouchAgainAndNoMore) {
  const SphereCluster detector = SphereCluster::build(test::bumpy_sphere(10, 0, 61));
  SphereCluster::Session session;
  for (int step = 0; step < 20; ++step) {
    ASSERT_TRUE(detector.touches({{1.03, 0.03 * step, 0}, 0.08 + 0.02 * step}, session)) << step;
    const std::uint64_t before = session.work.total();
    detector.prepare(session);
    EXPECT_LE(session.work.total() - before, 1U) << step << ": the last triangle still touches";
  }
}

TEST(SphereCluster, ASessionMayGoFromOneDetectorToTheNext) {
  // Built one after the other in the same place, so that addresses do not tell them apart.
  SphereCluster::Session session;
  for (const double height : {0.0, 1.0, 0.5}) {
    const TriangleMesh mesh({{0, 0, height}, {1, 0, height}, {0, 1, height}}, {{0, 1, 2}});
    const SphereCluster detector = SphereCluster::build(mesh);
    EXPECT_EQ(detector.nearest({{0.25, 0.25, 3}, 0}, infinity, session)->distance, 3 - height);
    EXPECT_FALSE(detector.touches({{0.25, 0.25, 3}, std::nextafter(3 - height, 0.0)}, session));
    EXPECT_TRUE(detector.touches({{0.25, 0.25, 3}, 3 - height}, session));
  }
}

TEST(SphereCluster, SweepsAsBruteForceDoes) {
  for (const auto& named : test::test_meshes()) {
    if (named.name == "vanishing" || named.name == "overflowing") continue;  // sweeps need squares
    const BruteForce oracle = BruteForce::build(named.mesh);
    for_each_exact_form(named.size, [&]<class D>(const typename D::Options& options) {
      SCOPED_TRACE(label(named, options));
      const D detector = D::build(named.mesh, options);
      typename D::Session session;
      BruteForce::Session oracle_session;
      test::Random random(23);
      for (int step = 0; step < 150; ++step) {
        const Vec3 from = test::random_point(named, random);
        const Vec3 to =
            step % 2 == 0 ? test::random_point(named, random) : Vec3(from + random.point(0.02 * named.size));
        const Sweep sweep{from, to, step % 5 == 0 ? 0 : named.size * random.between(0, 0.05)};
        expect_same(detector.first_hit(sweep, session), oracle.first_hit(sweep, oracle_session));
        if (HasFailure()) return;
      }
    });
  }
}

// The start is up to 2^17 sizes away, where single precision tells points apart that are 2^-7 sizes from each
// other, and the path is aimed so that the ball just touches or just misses.
TEST(SphereCluster, LongSweepsFromFarAwayGrazeAsBruteForceDoes) {
  test::Random random(79);
  for (const TriangleMesh& mesh : {test::bumpy_sphere(16, 0.01, 7), test::soup(500, 0.05, 2)}) {
    const BruteForce oracle = BruteForce::build(mesh);
    for_each_exact_form(1, [&]<class D>(const typename D::Options& options) {
      const D detector = D::build(mesh, options);
      int hits = 0;
      for (int i = 0; i < 1000; ++i) {
        const Vec3 target = mesh.corner(random.below(mesh.size()), 0);
        const Vec3 way = random.point(1).normalized();
        const Vec3 across = way.cross(random.point(1)).normalized();
        const double radius = i % 4 == 0 ? 0 : 0.05, miss = radius * (1 + random.between(-1e-3, 1e-3));
        const double before = std::ldexp(1.0, static_cast<int>(random.below(18))), after = i % 3;
        const Sweep sweep{target + miss * across - before * way, target + miss * across + after * way,
                          radius};
        typename D::Session session;
        BruteForce::Session oracle_session;
        const auto expected = oracle.first_hit(sweep, oracle_session);
        expect_same(detector.first_hit(sweep, session), expected);
        hits += expected ? 1 : 0;
        if (HasFailure()) return;
      }
      EXPECT_GT(hits, 300) << "the test is about sweeps of both kinds";
      EXPECT_LT(hits, 1000);
    });
  }
}

TEST(SphereCluster, ProbesThatAreNotFiniteTouchNothing) {
  const auto scenes = test::test_meshes();
  for_each_exact_form(1, [&]<class D>(const typename D::Options& options) {
    const D detector = D::build(scenes[0].mesh, options);
    typename D::Session session;
    for (const double bad : {nan, infinity, -infinity}) {
      EXPECT_FALSE(detector.nearest({{0, bad, 0}, 1}, 1, session));
      EXPECT_FALSE(detector.touches({{0, bad, 0}, 1}, session));
      EXPECT_FALSE(detector.first_hit({{0, bad, 0}, {0, bad, 0}, 1}, session));
    }
    EXPECT_FALSE(detector.nearest({{nan, 0, 0}, 1}, infinity, session));
    EXPECT_FALSE(detector.nearest({{0, 0, 0}, 1}, nan, session));
    EXPECT_FALSE(detector.nearest({{0, 0, 1}, 1}, -1, session));
    EXPECT_FALSE(detector.touches({{0, 0, 1}, nan}, session));
    EXPECT_TRUE(detector.touches({{0, 0, 1}, infinity}, session));
  });
}

TEST(SphereCluster, FarProbesGetTheAnswerOfBruteForce) {
  const TriangleMesh mesh = test::bumpy_sphere(10, 0.05, 29);
  const BruteForce oracle = BruteForce::build(mesh);
  for_each_exact_form(1, [&]<class D>(const typename D::Options& options) {
    const D detector = D::build(mesh, options);
    typename D::Session session;
    BruteForce::Session oracle_session;
    for (const double far : {1e2, 1e4, 1e7, 1e10, 1e20, 1e100, 1e160, 1e300}) {
      const Vec3 center = far * Vec3(0.3, -0.8, 0.5);
      expect_same(detector.nearest({center, 0}, infinity, session),
                  oracle.nearest({center, 0}, infinity, oracle_session));
      EXPECT_FALSE(detector.nearest({center, 0}, 1, session));
    }
  });
}

TEST(SphereCluster, TheFastLevelNeverMissesAndKeepsItsBound) {
  for (const auto& named : test::test_meshes()) {
    if (named.name == "vanishing" || named.name == "overflowing") continue;
    const BruteForce oracle = BruteForce::build(named.mesh);
    for (const double clustering : {0.0, 0.1 * named.size}) {
      const auto detector = PublishedSphereCluster::build(named.mesh, {clustering, false});
      SCOPED_TRACE(named.name);
      EXPECT_EQ(detector.accuracy().guarantee, Guarantee::conservative);
      PublishedSphereCluster::Session session;
      BruteForce::Session oracle_session;
      test::Random random(31);
      for (int step = 0; step < 300; ++step) {
        const Vec3 center = test::random_point(named, random);
        const double radius = named.size * random.between(0, 0.1);
        const double exact = oracle.nearest({center, 0}, infinity, oracle_session)->distance;
        const auto fast = detector.nearest({center, 0}, infinity, session);
        ASSERT_TRUE(fast);
        const double rounding = 1e-14 * (named.size + named.mesh.diagonal());
        EXPECT_LE(fast->distance, exact + rounding);
        EXPECT_GE(fast->distance, exact - detector.accuracy().absolute - rounding);
        if (exact <= radius * (1 - 1e-14)) {
          EXPECT_TRUE(detector.touches({center, radius}, session));
          EXPECT_TRUE(detector.nearest({center, 0}, radius, session));
        }
      }
    }
  }
}

TEST(SphereCluster, TheFastLevelAnswersWithTheFirstSphereOfLeastGap) {
  for (const auto& named : test::test_meshes()) {
    if (named.name == "overflowing") continue;  // its distances are no doubles
    SCOPED_TRACE(named.name);
    const auto detector = PublishedSphereCluster::build(named.mesh, {0.05 * named.size, false});
    const std::vector<Sphere>& spheres = detector.clusters().spheres;
    PublishedSphereCluster::Session session;
    test::Random random(32);
    for (int step = 0; step < 300; ++step) {
      const Vec3 center = test::random_point(named, random);
      double least = infinity;
      std::size_t first = 0;
      for (std::size_t i = 0; i < spheres.size(); ++i) {
        const double gap = (center - spheres[i].center).norm() - spheres[i].radius;
        if (gap < least) first = i;
        least = std::min(least, gap);
      }
      const auto answer = detector.nearest({center, 0}, infinity, session);
      ASSERT_TRUE(answer);
      EXPECT_EQ(answer->triangle, named.mesh.id(detector.clusters().triangles_of(first).front()));
      EXPECT_EQ(answer->distance, std::max(least, 0.0));
      // A reach is closed, and a probe touches what is no farther than its radius.
      EXPECT_TRUE(detector.nearest({center, 0}, answer->distance, session));
      EXPECT_TRUE(detector.touches({center, answer->distance}, session));
      if (!(answer->distance > 0)) continue;
      EXPECT_FALSE(detector.nearest({center, 0}, std::nextafter(answer->distance, 0), session));
      EXPECT_FALSE(detector.touches({center, std::nextafter(answer->distance, 0)}, session));
    }
  }
}

TEST(SphereCluster, TheFastLevelMeetsTheSphereWhereTheTriangleIsStillAway) {
  const TriangleMesh mesh({{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}, {{0, 1, 2}});  // centre (1, 1), radius sqrt 5
  const auto detector = PublishedSphereCluster::build(mesh, {.precise = false});
  PublishedSphereCluster::Session session;
  const double radius = std::sqrt(5.0);
  const auto contact = detector.nearest({{1, 1, 4}, 0}, 4, session);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->distance, 4 - radius, 1e-14);
  EXPECT_NEAR((contact->point - Vec3(1, 1, radius)).norm(), 0, 1e-14);
  EXPECT_EQ(contact->normal, Vec3(0, 0, 1));
  EXPECT_EQ(detector.nearest({{1, 1, 1}, 0}, 0, session)->distance, 0);
  const auto impact = detector.first_hit({{1, 1, 4}, {1, 1, -4}, 1}, session);
  ASSERT_TRUE(impact);
  EXPECT_NEAR(impact->fraction, (3 - radius) / 8, 1e-13);
}

template <class D>
void expect_to_refuse_clustering(double clustering) {
  try {
    D::build(test::plate(2), {.clustering = clustering});
    ADD_FAILURE() << "took a clustering distance of " << clustering;
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("clustering"), std::string::npos);
  }
}

TEST(SphereCluster, RefusesClusteringThatMakesNoSense) {
  for (const double bad : {-1.0, nan, infinity}) {
    expect_to_refuse_clustering<SphereCluster>(bad);
    expect_to_refuse_clustering<PublishedSphereCluster>(bad);
  }
}

TEST(SphereCluster, CountsWhatItLooksAt) {
  const TriangleMesh mesh = test::plate(16);
  PublishedSphereCluster::Session session;
  const auto scan = PublishedSphereCluster::build(mesh);
  scan.nearest({{0.01, 0.02, 5}, 0}, 0.1, session);
  EXPECT_EQ(session.work.spheres, mesh.size());  // the fast level tests them all
  EXPECT_EQ(session.work.triangles, 0u);         // and none is met
  const SphereCluster tree = SphereCluster::build(mesh);
  SphereCluster::Session tree_session;
  tree.nearest({{0.01, 0.02, 0.01}, 0}, 0.1, tree_session);
  EXPECT_GT(tree_session.work.triangles, 0u);
  EXPECT_LT(tree_session.work.total(), mesh.size());
}

TEST(SphereCluster, AccountsForItsMemory) {
  for_each_exact_form(1, [&]<class D>(const typename D::Options& options) {
    const std::size_t small = D::build(test::plate(8), options).bytes();
    const std::size_t large = D::build(test::plate(32), options).bytes();
    // Sixteen times the triangles, each kept with its corners.
    EXPECT_GT(small, 128 * sizeof(PreparedTriangle));
    EXPECT_GT(large, 2048 * sizeof(PreparedTriangle));
    EXPECT_LT(large, 2048 * 400u);
  });
}

/// The square of such an offset is no normal number, so no unit normal comes of it.
TEST(SphereCluster, FindsATriangleThatAShortSweepCrossesAtAnOffsetNearTheLeastNumber) {
  const TriangleMesh mesh({{1, -1, 0}, {0, 1, -1}, {-1, 0, 1}}, {{0, 1, 2}});
  const SphereCluster detector = SphereCluster::build(mesh);
  const Vec3 up(1, 1, 1);
  for (const double height : {1e-150, 1e-160, 3e-302, 5e-320}) {
    SphereCluster::Session session;
    EXPECT_TRUE(detector.first_hit({-height * up, 2 * height * up, 0.25 * height}, session)) << height;
    EXPECT_TRUE(detector.first_hit({2 * height * up, -height * up, 0.25 * height}, session)) << height;
    EXPECT_FALSE(detector.first_hit({2 * height * up, 3 * height * up, 0.25 * height}, session)) << height;
  }
}

}  // namespace
}  // namespace touchmark
