/// What is expected of every rival about the square, and of its touches and sessions.
#pragma once

#include <cmath>
#include <type_traits>

#include <gtest/gtest.h>

#include "core/brute_force/brute_force.h"
#include "core/detector.h"
#include "core/float_limits.h"
#include "core/triangle_mesh.h"
#include "tests/baselines/meshes.h"

namespace touchmark::baselines {

/// `square` is a detector of the unit square.
template <class D>
void expect_the_triangle_below_the_probe(const D& square, typename D::Session& session, double rounding) {
  const auto contact = square.nearest({{0.75, 0.75, 2}, 0}, 3, session);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->triangle, 1u);
  EXPECT_NEAR(contact->distance, 2, rounding);
  EXPECT_LT((contact->point - Vec3(0.75, 0.75, 0)).norm(), rounding);
  EXPECT_LT((contact->normal - Vec3(0, 0, 1)).norm(), rounding);
}

/// Half a unit above the square, a reach of `within` finds it, a little less than a half does not.
template <class D>
void expect_nothing_beyond_the_reach(const D& square, typename D::Session& session, double within,
                                     double less) {
  const Probe above{{0.25, 0.25, 0.5}, 0};
  EXPECT_TRUE(square.nearest(above, within, session));
  EXPECT_FALSE(square.nearest(above, less, session));
  EXPECT_FALSE(square.nearest(above, -1, session));
}

template <class D>
void expect_touches_up_to_the_radius(const D& square, typename D::Session& session, double within) {
  const Vec3 above(0.25, 0.25, 0.5);
  EXPECT_TRUE(square.touches({above, within}, session));
  EXPECT_FALSE(square.touches({above, 0.499}, session));
  EXPECT_TRUE(square.touches({above, infinity}, session));
}

template <class D>
void expect_what_is_not_a_number_to_touch_nothing(const D& detector, typename D::Session& session) {
  const Vec3 nan = Vec3::Constant(std::nan(""));
  EXPECT_FALSE(detector.nearest({nan, 1}, infinity, session));
  EXPECT_FALSE(detector.touches({nan, 1}, session));
  EXPECT_FALSE(detector.touches({Vec3::Constant(infinity), 1}, session));
  if constexpr (AnswersSweep<D>) {
    EXPECT_FALSE(detector.first_hit({Vec3::Zero(), nan, 1}, session));
  }
}

/// `build` makes the detector of a mesh. The probes are `away` from the triangles.
template <class Build>
void expect_the_ids_of_the_file(const Build& build, double away) {
  const auto detector =
      build(TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 9}, {1, 0, 9}, {0, 1, 9}},
                         {{0, 1, 2}, {1, 3, 2}, {4, 5, 6}}, {7, 7, 9}));
  using D = std::remove_const_t<decltype(detector)>;
  typename D::Session session;
  EXPECT_EQ(detector.nearest({{0.75, 0.75, away}, 0}, away + 0.5, session)->triangle, 7u);
  EXPECT_EQ(detector.nearest({{0.25, 0.25, 9 - away}, 0}, away + 0.5, session)->triangle, 9u);
  if constexpr (AnswersSweep<D>) {
    const auto hit = detector.first_hit({{0.25, 0.25, 20}, {0.25, 0.25, 1}, 0.5}, session);
    EXPECT_EQ(hit->contact.triangle, 9u);
  }
}

template <class D>
void expect_used_and_fresh_sessions_to_give_the_same_bits(const D& detector) {
  typename D::Session session;
  Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 center = random.point();
    typename D::Session fresh;
    const auto used = detector.nearest({center, 0}, 0.3, session);
    const auto first = detector.nearest({center, 0}, 0.3, fresh);
    ASSERT_EQ(used.has_value(), first.has_value()) << trial;
    if (!used) continue;
    EXPECT_EQ(used->distance, first->distance) << trial;
    EXPECT_EQ(used->triangle, first->triangle) << trial;
    EXPECT_EQ(used->point, first->point) << trial;
    EXPECT_EQ(used->normal, first->normal) << trial;
  }
}

/// A thousandth more than the true distance touches, a thousandth less does not. Calls check(contact, true
/// distance) for each contact within the reach, and returns how many there are.
template <class D, class Check>
int expect_the_touches_of_brute_force(const TriangleMesh& mesh, const D& detector, double size, double reach,
                                      const Check& check) {
  const BruteForce reference = BruteForce::build(mesh);
  BruteForce::Session reference_session;
  typename D::Session session;
  Random random(3);
  int touching = 0;
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(trial);
    const Vec3 center = size * random.point();
    const double distance = reference.nearest({center, 0}, infinity, reference_session)->distance;
    EXPECT_TRUE(detector.touches({center, distance * 1.001}, session));
    EXPECT_FALSE(detector.touches({center, distance * 0.999}, session));
    const auto contact = detector.nearest({center, 0}, reach, session);
    EXPECT_EQ(contact.has_value(), distance <= reach);
    if (!contact) continue;
    ++touching;
    check(*contact, distance);
  }
  EXPECT_GT(touching, 30);
  return touching;
}

}  // namespace touchmark::baselines
