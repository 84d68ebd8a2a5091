/// What `prepare` asks again must be what the next query does: the same kind of question, and the session's
/// answer to it as it was.
#include "core/search/memory/last_question.h"

#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

#include "core/grid_group/grid_group.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/sphere_cluster/test_meshes.h"

namespace touchmark {
namespace {

constexpr double radius = 0.05;

template <class D>
class LastQuestionOf : public testing::Test {
 protected:
  const D detector = D::build(test::bumpy_sphere(40, 1e-3, 67));

  /// Expects that preparing looks at something, and at as much as the question does when it is asked again;
  /// and that it then takes as much again, as if nothing had been prepared. A session that is asked for the
  /// second time may find out first what a search without a list takes, so that it is asked twice before.
  template <class Ask>
  void expect_asked_again(const Ask& ask) {
    typename D::Session session;
    ask(session);
    ask(session);
    const std::uint64_t before = session.work.total();
    detector.prepare(session);
    const std::uint64_t prepared = session.work.total() - before;
    typename D::Session unprepared;
    ask(unprepared);
    ask(unprepared);
    const std::uint64_t asked_twice = unprepared.work.total();
    ask(unprepared);
    const std::uint64_t asked_again = unprepared.work.total() - asked_twice;
    EXPECT_GE(prepared, asked_again);
    ask(session);
    EXPECT_LE(session.work.total() - before - prepared, asked_again);
  }
};

using RememberingDetectors = testing::Types<SphereCluster, GridGroup>;
TYPED_TEST_SUITE(LastQuestionOf, RememberingDetectors);

TYPED_TEST(LastQuestionOf, NearestIsAskedAgain) {
  this->expect_asked_again([this](typename TypeParam::Session& session) {
    EXPECT_TRUE(this->detector.nearest({{1.02, 0, 0}, radius}, radius, session));
  });
}

TYPED_TEST(LastQuestionOf, TouchesIsAskedAgain) {
  this->expect_asked_again([this](typename TypeParam::Session& session) {
    EXPECT_TRUE(this->detector.touches({{1.02, 0, 0}, radius}, session));
  });
}

TYPED_TEST(LastQuestionOf, ASweepIsAskedAgain) {
  this->expect_asked_again([this](typename TypeParam::Session& session) {
    EXPECT_TRUE(this->detector.first_hit({{1.02, 0, 0}, {1.02, 1e-3, 0}, radius}, session));
  });
}

TYPED_TEST(LastQuestionOf, NothingIsAskedWhereThePointIsKnownToBeClear) {
  typename TypeParam::Session session;
  this->detector.prepare(session);
  EXPECT_EQ(session.work.total(), 0U) << "nothing was asked before";
  EXPECT_FALSE(this->detector.nearest({{2, 0, 0}, radius}, radius, session));
  const std::uint64_t before = session.work.total();
  this->detector.prepare(session);
  EXPECT_EQ(session.work.total(), before);
}

TYPED_TEST(LastQuestionOf, AnotherDetectorsQuestionIsNotAsked) {
  typename TypeParam::Session session;
  EXPECT_TRUE(this->detector.nearest({{1.02, 0, 0}, radius}, radius, session));
  const TypeParam other = TypeParam::build(test::bumpy_sphere(10, 0, 71));
  const std::uint64_t before = session.work.total();
  other.prepare(session);
  EXPECT_EQ(session.work.total(), before);
}

// A point that jumps about, with a preparation after some answers: each is as of a fresh session.
TYPED_TEST(LastQuestionOf, PreparingChangesNoAnswer) {
  typename TypeParam::Session prepared;
  test::Random random(73);
  for (int step = 0; step < 3000; ++step) {
    const Vec3 center = random.point(step % 7 < 5 ? 1.05 : 2);
    const double reach = step % 11 == 0 ? std::numeric_limits<double>::infinity() : 0.2;
    typename TypeParam::Session fresh;
    if (step % 3 == 0) {
      EXPECT_EQ(this->detector.touches({center, 0.2}, prepared),
                this->detector.touches({center, 0.2}, fresh));
    } else {
      const auto contact = this->detector.nearest({center, 0}, reach, prepared);
      const auto expected = this->detector.nearest({center, 0}, reach, fresh);
      ASSERT_EQ(contact.has_value(), expected.has_value());
      if (contact) {
        EXPECT_EQ(contact->distance, expected->distance);
        EXPECT_EQ(contact->triangle, expected->triangle);
      }
    }
    if (step % 2 == 0) this->detector.prepare(prepared);
  }
}

}  // namespace
}  // namespace touchmark
