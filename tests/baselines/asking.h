/// What is expected of every rival in its default form: that asking the mesh's box and the last contact's
/// triangle first changes no answer, whatever the session remembers.
#pragma once

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/detector.h"
#include "core/triangle_mesh.h"
#include "tests/baselines/meshes.h"

namespace touchmark::baselines {

/// Along a walk that leaves the mesh's box now and then, and at jumps: one session kept, against a fresh one
/// for each probe of the same form and of the plain one. `any_of_ties`: of triangles as near the rival names
/// any, by where its search started.
template <class D>
void expect_asking_changes_no_answer(const TriangleMesh& mesh, typename D::Options form,
                                     bool any_of_ties = false) {
  form.query = Asking::checked;
  const D checked = D::build(mesh, form);
  form.query = Asking::plain;
  const D plain = D::build(mesh, form);
  typename D::Session kept, kept_plain;
  Random random(31);
  Vec3 center(0, 0, 0.5), before = center;
  for (int i = 0; i < 400; ++i) {
    before = center;
    center = i % 20 == 0 ? Vec3(1.6 * random.point()) : Vec3(center + 0.03 * random.point());
    const double reach = i % 50 == 0 ? std::numeric_limits<double>::infinity() : 0.2;
    typename D::Session fresh, fresh_plain;
    const auto contact = checked.nearest({center, 0}, reach, kept),
               again = checked.nearest({center, 0}, reach, kept),
               alone = checked.nearest({center, 0}, reach, fresh),
               expected = plain.nearest({center, 0}, reach, fresh_plain);
    for (const auto& one : {contact, again, alone}) {
      ASSERT_EQ(one.has_value(), expected.has_value()) << i;
      if (!expected) continue;
      if (!any_of_ties) {
        EXPECT_EQ(one->triangle, expected->triangle) << i;
      }
      EXPECT_EQ(one->distance, expected->distance) << i;
    }
    typename D::Session again_fresh;
    for (const double radius : {0.2, expected ? expected->distance : 0.0}) {
      const bool touching = plain.touches({center, radius}, kept_plain);
      EXPECT_EQ(checked.touches({center, radius}, kept), touching) << i;
      EXPECT_EQ(checked.touches({center, radius}, kept), touching) << i;
      EXPECT_EQ(checked.touches({center, radius}, again_fresh), touching) << i;
    }
    if constexpr (AnswersSweep<D>) {
      const Sweep sweep{before, center, 0.1};
      const auto hit = checked.first_hit(sweep, kept), sought = plain.first_hit(sweep, fresh_plain);
      ASSERT_EQ(hit.has_value(), sought.has_value()) << i;
      if (hit) {
        EXPECT_EQ(hit->fraction, sought->fraction) << i;
      }
    }
  }
}

/// A probe beyond the box on any side costs nothing, and one that slides asks one triangle.
template <class D>
void expect_asking_to_save_work(typename D::Options form) {
  const TriangleMesh mesh = bumps(20);
  const D detector = D::build(mesh, form);
  typename D::Session session;
  const Aabb box = mesh.bounds();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vec3 center = box.center();
      center[axis] += side * (0.5 * box.extent()[axis] + 0.25);
      EXPECT_FALSE(detector.nearest({center, 0}, 0.125, session));
      EXPECT_FALSE(detector.touches({center, 0.125}, session));
    }
  }
  EXPECT_EQ(session.work.total(), 0u);
  ASSERT_TRUE(detector.touches({{0.31, 0.17, 0.2}, 0.2}, session));
  const std::uint64_t asked = session.work.total();
  EXPECT_TRUE(detector.touches({{0.311, 0.17, 0.2}, 0.2}, session));
  EXPECT_LE(session.work.total(), asked + 1);
}

}  // namespace touchmark::baselines
