// The nearest triangle within a budget of work: the bracket holds the distance that a look at every triangle
// finds, the budget is kept, and no later answer suffers from it.
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "bench/support/random.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/detector.h"
#include "core/float_limits.h"
#include "core/grid_group/grid_group.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/sphere_cluster/test_meshes.h"

namespace touchmark {
namespace {

using bench::support::Random;
using test::NamedMesh, test::random_point, test::test_meshes;

/// Asks within a budget, and a brute force beside it.
template <class D>
class Asked {
 public:
  Asked(const NamedMesh& named, D detector)
      : named_(named), detector_(std::move(detector)), truth_(BruteForce::build(named.mesh)) {}

  void ask(const Vec3& at, double reach, std::uint64_t budget, const std::string& where) {
    const std::uint64_t before = session_.work.total();
    const Bracket bracket = detector_.nearest({at, 0}, reach, session_, budget);
    expect_within(budget, bracket, session_.work.total() - before, where);
    const std::optional<Contact> nearest = truth_.nearest({at, 0}, infinity, asked_);
    ASSERT_TRUE(nearest) << where;
    EXPECT_LE(bracket.lower, nearest->distance) << where;
    if (bracket.is_nearest) {
      ASSERT_EQ(bracket.contact.has_value(), nearest->distance <= reach) << where;
      if (bracket.contact) {
        EXPECT_EQ(bracket.contact->triangle, nearest->triangle) << where;
      }
    } else {
      ASSERT_TRUE(bracket.contact) << where;
      EXPECT_GE(bracket.contact->distance, nearest->distance * (1 - 1e-12)) << where;
      EXPECT_LE(bracket.lower, reach) << where;
    }
    ++(bracket.is_nearest ? finished : open);
  }
  void expect_nearest(const Vec3& at, const std::string& where) {
    EXPECT_EQ(detector_.nearest({at, 0}, infinity, session_)->triangle,
              truth_.nearest({at, 0}, infinity, asked_)->triangle)
        << where;
  }

  std::size_t finished = 0, open = 0;

 private:
  /// A node or a leaf is looked at as a whole, and the kept triangle with those beside it. Once more those
  /// are that may come first among the nearest. Squares of the lengths of one mesh vanish: a tree of boxes
  /// looks at all.
  void expect_within(std::uint64_t budget, const Bracket& bracket, std::uint64_t spent,
                     const std::string& where) {
    if (builds_lazily() || named_.name == "vanishing") return;
    EXPECT_LE(spent, budget + 64 + (bracket.is_nearest ? named_.mesh.size() : 0)) << where;
  }
  bool builds_lazily() const {
    if constexpr (BuildsLazily<D>) return detector_.builds_lazily();
    return false;
  }

  const NamedMesh& named_;
  D detector_;
  BruteForce truth_;
  typename D::Session session_;
  BruteForce::Session asked_;
};

/// Slow ticks, for which triangles are kept, and jumps.
template <class D>
void expect_brackets(const NamedMesh& named, D detector, std::size_t& finished, std::size_t& open) {
  Asked<D> asked(named, std::move(detector));
  Random random(9);
  const double size = named.mesh.diagonal();
  Vec3 at = random_point(named, random);
  for (int tick = 0; tick < 200; ++tick) {
    const std::string where = named.name + ", tick " + std::to_string(tick);
    const double reach = tick % 3 == 0 ? infinity : size * random.unit();
    asked.ask(at, reach, tick % 11 == 0 ? 1'000'000 : std::uint64_t{1} << random.below(11), where);
    if (tick % 5 == 0) asked.expect_nearest(at, where);
    const double step = (tick / 50 % 2 == 0 ? 1e-5 : 3e-3) * size;
    at = tick % 25 == 0 ? random_point(named, random) : Vec3(at + step * random.direction());
  }
  finished += asked.finished;
  open += asked.open;
}

template <class D>
class BracketOf : public testing::Test {};
using Detectors = testing::Types<SphereCluster, GridGroup, AabbTree>;
TYPED_TEST_SUITE(BracketOf, Detectors);

TYPED_TEST(BracketOf, HoldsTheTrueDistance) {
  static_assert(AnswersWithinBudget<TypeParam>);
  std::size_t finished = 0, open = 0;
  for (const NamedMesh& named : test_meshes()) {
    if (!(named.mesh.diagonal() < 1e100)) continue;
    expect_brackets(named, TypeParam::build(named.mesh), finished, open);
    if constexpr (BuildsLazily<TypeParam>) {
      typename TypeParam::Options lazy;
      lazy.construction = TypeParam::Construction::lazy;
      expect_brackets(named, TypeParam::build(named.mesh, lazy), finished, open);
    }
  }
  EXPECT_GT(finished, 0u);
  EXPECT_GT(open, finished / 20);
}

/// Asked again from the same place, it goes on from what it found: the bracket's upper end never rises.
TYPED_TEST(BracketOf, StartsFromWhatItFound) {
  const NamedMesh named = test_meshes().front();
  const TypeParam detector = TypeParam::build(named.mesh);
  typename TypeParam::Session session;
  Random random(3);
  for (int place = 0; place < 50; ++place) {
    const Vec3 at = random_point(named, random);
    double upper = infinity;
    for (int again = 0; again < 4; ++again) {
      const Bracket bracket = detector.nearest({at, 0}, infinity, session, 4);
      ASSERT_TRUE(bracket.contact);
      EXPECT_LE(bracket.contact->distance, upper);
      upper = bracket.contact->distance;
    }
  }
}

TYPED_TEST(BracketOf, FindsNothingWithinNoReach) {
  const NamedMesh named = test_meshes().front();
  const TypeParam detector = TypeParam::build(named.mesh);
  typename TypeParam::Session session;
  for (const double reach : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    const Bracket bracket = detector.nearest({named.center, 0}, reach, session, 8);
    EXPECT_TRUE(bracket.is_nearest);
    EXPECT_FALSE(bracket.contact);
  }
}

}  // namespace
}  // namespace touchmark
