#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "baselines/cgal/cgal_detector.h"
#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "tests/baselines/asking.h"
#include "tests/baselines/meshes.h"

namespace touchmark::baselines {
namespace {

static_assert(AnswersTouches<CgalDetector> && AnswersNearest<CgalDetector> && !AnswersSweep<CgalDetector>);

using Options = CgalDetector::Options;
using Kernel = CgalDetector::Kernel;
using Hint = CgalDetector::Hint;

std::vector<Options> all_forms() {
  std::vector<Options> forms;
  for (const Kernel kernel : {Kernel::epick, Kernel::simple, Kernel::epeck})
    for (const Hint hint : {Hint::none, Hint::last, Hint::bounded}) forms.push_back({kernel, hint});
  return forms;
}

/// Probes near the mesh and far from it, and reaches that hold the nearest triangle or do not.
TEST(Cgal, FindsWhatBruteForceFindsToSomeRoundings) {
  const TriangleMesh mesh = bumps(12);
  const BruteForce reference = BruteForce::build(mesh);
  for (const Options& form : all_forms()) {
    const CgalDetector cgal = CgalDetector::build(mesh, form);
    CgalDetector::Session session;
    BruteForce::Session brute;
    Random random(3);
    for (int i = 0; i < 300; ++i) {
      const Probe probe{(i % 10 == 0 ? 30 : 1.2) * random.point(), 0.1};
      EXPECT_EQ(cgal.touches(probe, session), reference.touches(probe, brute));
      for (const double reach : {0.0, probe.radius, infinity}) {
        const auto contact = cgal.nearest(probe, reach, session),
                   expected = reference.nearest(probe, reach, brute);
        ASSERT_EQ(contact.has_value(), expected.has_value()) << i << " within " << reach;
        if (!contact) continue;
        const double rounding = 1e-13 * probe.center.norm() + 1e-14;
        EXPECT_NEAR(contact->distance, expected->distance, rounding);
        EXPECT_LT((contact->point - expected->point).norm(), 1e-6);
        EXPECT_NEAR(contact->normal.norm(), 1, 1e-12);
      }
    }
  }
}

TEST(Cgal, ClosesItsContact) {
  for (const Options& form : all_forms()) {
    const CgalDetector cgal = CgalDetector::build(square(), form);
    CgalDetector::Session session;
    const Probe above{{0.25, 0.5, 0.5}, 0.5};
    EXPECT_TRUE(cgal.touches(above, session));
    const auto contact = cgal.nearest(above, 0.5, session);
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->distance, 0.5);
    EXPECT_EQ(contact->point, Vec3(0.25, 0.5, 0));
    EXPECT_EQ(contact->normal, Vec3(0, 0, 1));
    EXPECT_EQ(contact->triangle, 0U);
    EXPECT_FALSE(cgal.nearest(above, 0.499, session));
    const auto on = cgal.nearest({{0.25, 0.5, 0}, 0}, 0, session);
    ASSERT_TRUE(on);
    EXPECT_EQ(on->normal, Vec3(0, 0, 1));
  }
}

/// CGAL's sphere is hollow: its do_intersect says no where a triangle lies inside.
TEST(Cgal, TouchesWhatLiesInsideTheBall) {
  for (const Options& form : all_forms()) {
    CgalDetector::Session session;
    EXPECT_TRUE(CgalDetector::build(square(), form).touches({{0.5, 0.5, 0}, 10}, session));
    EXPECT_TRUE(CgalDetector::build(square(), form).touches({{0.5, 0.5, 0}, infinity}, session));
  }
}

/// A NaN in a query would raise SIGFPE.
TEST(Cgal, AProbeThatIsNotANumberTouchesNothing) {
  const Vec3 nan = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  for (const Options& form : all_forms()) {
    const CgalDetector cgal = CgalDetector::build(bumps(2), form);
    CgalDetector::Session session;
    EXPECT_FALSE(cgal.nearest({nan, 1}, infinity, session));
    EXPECT_FALSE(cgal.touches({nan, 1}, session));
    EXPECT_FALSE(cgal.nearest({{infinity, 0, 0}, 1}, infinity, session));
    EXPECT_FALSE(cgal.nearest({{0, 0, 0}, 1}, std::numeric_limits<double>::quiet_NaN(), session));
  }
}

/// The trees would be built by the first query, in the middle of the others.
TEST(Cgal, AnswersSeveralThreadsAtOnce) {
  const TriangleMesh mesh = bumps(20);
  for (const Options& form : all_forms()) {
    const CgalDetector cgal = CgalDetector::build(mesh, form);
    const auto distances = [&] {
      CgalDetector::Session session;
      Random random(9);
      std::vector<double> all;
      for (int i = 0; i < 200; ++i)
        all.push_back(cgal.nearest({random.point(), 0}, infinity, session)->distance);
      return all;
    };
    std::vector<std::vector<double>> found(4);
    std::vector<std::thread> threads;
    for (auto& mine : found) threads.emplace_back([&] { mine = distances(); });
    for (std::thread& thread : threads) thread.join();
    for (const auto& mine : found) EXPECT_EQ(mine, found.front());
  }
}

TEST(Cgal, KeepsTheMeshsIds) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}},
                          {{0, 1, 2}, {3, 4, 5}}, {7, 9});
  for (const Options& form : all_forms()) {
    const CgalDetector cgal = CgalDetector::build(mesh, form);
    CgalDetector::Session session;
    EXPECT_EQ(cgal.nearest({{5.1, 0.1, 1}, 0}, infinity, session)->triangle, 9U);
    EXPECT_EQ(cgal.nearest({{0.1, 0.1, 1}, 0}, infinity, session)->triangle, 7U);
  }
}

TEST(Cgal, CountsItsMemory) {
  const TriangleMesh mesh = bumps(20);
  const auto bytes = [&](Hint hint) { return CgalDetector::build(mesh, {Kernel::simple, hint}).bytes(); };
  EXPECT_GT(bytes(Hint::last), mesh.size() * 9 * sizeof(double));
  EXPECT_GT(bytes(Hint::none), bytes(Hint::last));  // the k-d tree
}

TEST(Cgal, AskingTheBoxAndTheLastTriangleFirstChangesNoAnswer) {
  for (const Options& form : all_forms()) {
    if (form.kernel != Kernel::simple && form.hint != Hint::bounded) continue;  // they take seconds
    expect_asking_changes_no_answer<CgalDetector>(bumps(12), form, true);
    expect_asking_to_save_work<CgalDetector>(form);
  }
}

}  // namespace
}  // namespace touchmark::baselines
