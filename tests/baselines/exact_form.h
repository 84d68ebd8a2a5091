/// What is expected of a rival's exact form: the bits of brute force.
#pragma once

#include <limits>

#include <gtest/gtest.h>

#include "core/brute_force/brute_force.h"
#include "core/detector.h"
#include "core/triangle_mesh.h"
#include "tests/baselines/meshes.h"

namespace touchmark::baselines {

inline void expect_the_same(const Contact& actual, const Contact& expected) {
  EXPECT_EQ(actual.distance, expected.distance);
  EXPECT_EQ(actual.triangle, expected.triangle);
  EXPECT_EQ(actual.point, expected.point);
  EXPECT_EQ(actual.normal, expected.normal);
}

/// Asks about probes and sweeps in a box of half the edge `size` about `middle`, and on the mesh's corners.
template <class D>
void expect_the_bits_of_brute_force(const TriangleMesh& mesh, const D& detector, double size,
                                    const Vec3& middle) {
  const BruteForce reference = BruteForce::build(mesh);
  BruteForce::Session brute;
  typename D::Session session;
  Random random(5);
  int found = 0, hits = 0;
  for (std::size_t trial = 0; trial < 400; ++trial) {
    SCOPED_TRACE(trial);
    const double reach =
        trial % 9 == 0 ? std::numeric_limits<double>::infinity() : 0.3 * size * random.unit();
    const bool on_corner = trial % 11 == 0;
    const Vec3 center =
        on_corner ? mesh.corner(trial % mesh.size(), 1) : Vec3(size * random.point() + middle);
    const auto expected = reference.nearest({center, 0}, reach, brute);
    const auto actual = detector.nearest({center, 0}, reach, session);
    ASSERT_EQ(actual.has_value(), expected.has_value());
    EXPECT_EQ(detector.touches({center, reach}, session), expected.has_value());
    if (expected) expect_the_same(*actual, *expected);
    found += expected.has_value();
    if constexpr (AnswersSweep<D>) {
      const Vec3 way = size * (trial % 2 == 0 ? 0.01 : 1) * random.point();
      const Sweep sweep{center, center + way, trial % 3 == 0 ? 0.0 : 0.02 * size};
      const auto expected_hit = reference.first_hit(sweep, brute);
      const auto hit = detector.first_hit(sweep, session);
      ASSERT_EQ(hit.has_value(), expected_hit.has_value());
      if (!hit) continue;
      ++hits;
      EXPECT_EQ(hit->fraction, expected_hit->fraction);
      expect_the_same(hit->contact, expected_hit->contact);
    }
  }
  EXPECT_GT(found, 100);
  if constexpr (AnswersSweep<D>) {
    EXPECT_GT(hits, 30);
  }
}

/// On a surface, on slivers, far from the origin and on a mesh of microns; `build` makes the detector of a
/// mesh.
template <class Build>
void expect_the_bits_of_brute_force_everywhere(const Build& build) {
  const Vec3 origin = Vec3::Zero(), far(1e6, -1e6, 1e6);
  const auto expect_on = [&](const char* where, const TriangleMesh& mesh, double size, const Vec3& middle) {
    SCOPED_TRACE(where);
    expect_the_bits_of_brute_force(mesh, build(mesh), size, middle);
  };
  expect_on("a surface", bumps(12), 1, origin);
  expect_on("slivers", soup(300, 6), 1, origin);
  expect_on("slivers far from the origin", soup(300, 7).transformed(1, far), 1, far);
  expect_on("a surface of microns", bumps(12).transformed(1e-6, origin), 1e-6, origin);
}

}  // namespace touchmark::baselines
