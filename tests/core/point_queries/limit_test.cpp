// Queries within a limit of work: one that is decided answers as without a limit, one that is not counts as
// touching, and what is remembered stays true.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/support/random.h"
#include "core/detector.h"
#include "core/grid_group/grid_group.h"
#include "core/scene/scene.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/sphere_cluster/test_meshes.h"

namespace touchmark {
namespace {

using bench::support::Random;
using test::NamedMesh, test::random_point, test::test_meshes;

static_assert(KeepsToLimit<SphereCluster> && KeepsToLimit<GridGroup> && KeepsToLimit<Scene<GridGroup>>);

/// A query goes beyond its limit by a node, a leaf and what is decided at one place at once: which of the
/// triangles that are as near comes first, which all but `touches` may ask.
constexpr std::uint64_t beyond = 128 + 64 * LimitedWork::exact_weight;
constexpr std::uint64_t beyond_of_named = 128 + 512 * LimitedWork::exact_weight;

/// Needles that meet in a hub: beside it doubles tell none of them from its neighbours.
TriangleMesh needle_fan(std::uint32_t count) {
  std::vector<Vec3> vertices{Vec3::Zero()};
  std::vector<TriangleMesh::Corners> triangles;
  for (std::uint32_t i = 0; i <= count; ++i) {
    const double turn = 6.28 * i / count;
    vertices.emplace_back(std::cos(turn), std::sin(turn), 0.01 * (i % 2));
    if (i > 0) triangles.push_back({0, i, i + 1});
  }
  return {std::move(vertices), std::move(triangles)};
}

std::vector<NamedMesh> meshes() {
  std::vector<NamedMesh> all = test_meshes();
  all.push_back({"needle fan", needle_fan(3000), 2});
  return all;
}

/// Asks one question of a session within a limit, and a fresh one without.
template <class D>
class Limited {
 public:
  explicit Limited(const TriangleMesh& mesh) : detector_(D::build(mesh)) {}

  void ask(const Probe& probe, const Vec3& to, std::uint64_t limit, const std::string& where) {
    within(limit, beyond, where + ", touches", [&] {
      const bool touching = detector_.touches(probe, session_);
      EXPECT_TRUE(touching || !session_.work.undecided) << where;
      return session_.work.undecided || touching == detector_.touches(probe, *fresh());
    });
    within(limit, beyond_of_named, where + ", first_hit", [&] {
      const Sweep sweep{probe.center, to, probe.radius};
      const std::optional<Impact> hit = detector_.first_hit(sweep, session_);
      if (session_.work.undecided) {
        EXPECT_TRUE(hit && hit->fraction == 0) << where;
        return true;
      }
      const std::optional<Impact> expected = detector_.first_hit(sweep, *fresh());
      return hit.has_value() == expected.has_value() && (!hit || hit->fraction == expected->fraction);
    });
    within(limit, beyond_of_named, where + ", contacts", [&] {
      std::array<Contact, 8> found, expected;
      const std::size_t count = detector_.contacts(probe, probe.radius, session_, found);
      if (session_.work.undecided) return true;
      const std::size_t all = detector_.contacts(probe, probe.radius, *fresh(), expected);
      for (std::size_t i = 0; i < std::min(all, found.size()); ++i)
        EXPECT_EQ(found[i].triangle, expected[i].triangle) << where;
      return count == all;
    });
  }

  std::size_t decided = 0, undecided = 0;

 private:
  std::unique_ptr<typename D::Session> fresh() const { return std::make_unique<typename D::Session>(); }
  template <class Question>
  void within(std::uint64_t limit, std::uint64_t more, const std::string& where,
              const Question& is_as_expected) {
    LimitedWork& work = session_.work;
    const std::uint64_t before = work.spent();
    work.undecided = false;
    work.limit = limit == LimitedWork::unlimited ? limit : before + limit;
    EXPECT_TRUE(is_as_expected()) << where;
    if (limit == LimitedWork::unlimited) {
      EXPECT_FALSE(work.undecided) << where;
    } else {
      EXPECT_LE(work.spent() - before, limit + more) << where;
    }
    ++(work.undecided ? undecided : decided);
  }

  D detector_;
  typename D::Session session_;
};

template <class D>
class LimitOf : public testing::Test {};
using LimitedDetectors = testing::Types<SphereCluster, GridGroup, Scene<SphereCluster>, Scene<GridGroup>>;
TYPED_TEST_SUITE(LimitOf, LimitedDetectors);

TYPED_TEST(LimitOf, LeavesADecidedAnswerAsItIs) {
  std::size_t decided = 0, undecided = 0;
  for (const NamedMesh& named : meshes()) {
    if (!(named.mesh.diagonal() < 1e100)) continue;
    Limited<TypeParam> limited(named.mesh);
    Random random(5);
    Vec3 at = random_point(named, random);
    const double size = named.mesh.diagonal();
    for (int tick = 0; tick < 200; ++tick) {
      const std::uint64_t limit =
          tick % 7 == 0 ? LimitedWork::unlimited : std::uint64_t{1} << random.below(14);
      const Vec3 to =
          tick % 10 == 0 ? random_point(named, random) : Vec3(at + 0.003 * size * random.direction());
      const double radius = tick % 3 == 0 ? 0 : 0.1 * size * random.unit();
      limited.ask({at, radius}, to, limit, named.name + ", tick " + std::to_string(tick));
      if (this->HasFailure()) return;
      at = to;
    }
    decided += limited.decided;
    undecided += limited.undecided;
  }
  EXPECT_GT(decided, 4 * undecided / 10);
  EXPECT_GT(undecided, decided / 10);
}

/// A ball about the hub is exactly as far from a thousand needles as it is large.
TYPED_TEST(LimitOf, EndsAtTheHubOfAFan) {
  const TriangleMesh mesh = needle_fan(3000);
  Limited<TypeParam> limited(mesh);
  for (std::uint64_t limit = 1; limit < 5000; limit *= 2) {
    limited.ask({{0, 0, 0.25}, 0.25}, {0.001, 0, 0.25}, limit, "limit " + std::to_string(limit));
    limited.ask({{0, 0, 0.25}, std::nextafter(0.25, 0)}, {0.001, 0, 0.25}, limit, "just off the hub");
    limited.ask({{0, 0, 0}, 0}, {0, 0, 0.1}, limit, "in the hub, limit " + std::to_string(limit));
  }
  EXPECT_GT(limited.undecided, 0u);
}

}  // namespace
}  // namespace touchmark
