/// What is expected of every rival that follows a mesh whose vertices move.
#pragma once

#include <stdexcept>

#include <gtest/gtest.h>

#include "core/brute_force/brute_force.h"
#include "core/triangle_mesh.h"
#include "tests/baselines/meshes.h"

namespace touchmark::baselines {

/// There and back again, from one session, against brute force on the mesh as it is then.
template <class D>
void expect_to_follow(const TriangleMesh& mesh, const TriangleMesh& other, const typename D::Options& form) {
  D detector = D::build(mesh, form);
  typename D::Session session;
  for (const TriangleMesh* now : {&mesh, &other, &mesh, &other}) {
    detector.update(*now);
    const BruteForce reference = BruteForce::build(*now);
    BruteForce::Session brute;
    Random random(21);
    for (int i = 0; i < 200; ++i) {
      const Probe probe{1.2 * random.point(), 0.1};
      const auto contact = detector.nearest(probe, 0.3, session),
                 expected = reference.nearest(probe, 0.3, brute);
      ASSERT_EQ(contact.has_value(), expected.has_value()) << i;
      if (!contact) continue;
      EXPECT_NEAR(contact->distance, expected->distance, 0);
      EXPECT_EQ(contact->triangle, expected->triangle);
      EXPECT_EQ(detector.touches(probe, session), reference.touches(probe, brute));
    }
  }
  EXPECT_THROW(detector.update(TriangleMesh({{0, 0, 0}}, {{0, 0, 0}})), std::invalid_argument);
  EXPECT_THROW(detector.update(bumps(11)), std::invalid_argument);
}

}  // namespace touchmark::baselines
