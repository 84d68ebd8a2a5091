/// Many points asked at once are answered as they are one by one, in whatever order, from however many
/// threads (std::thread, in core/search/threads/thread_crew.cpp), and whatever was asked before.
#include "core/search/many/nearest_many.h"

#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/grid_group/grid_group.h"
#include "core/sign/signed_detector.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/query_pass.h"

namespace touchmark {
namespace {

using Points = std::vector<Vec3>;
using Answers = std::vector<std::optional<Contact>>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr AskOrder orders[] = {AskOrder::automatic, AskOrder::as_given, AskOrder::curve};

/// About the sheet of query_pass.h, in random order.
Points scattered(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = unit(), y = unit(), z = unit();
    points.emplace_back(1.2 * x - 0.1, 1.2 * y - 0.1, 0.4 * z - 0.2);
  }
  return points;
}

Points moved(Points points, const Vec3& by) {
  for (Vec3& point : points) point += by;
  return points;
}

template <class D>
Answers one_by_one(const D& detector, const Points& points, double reach) {
  typename D::Session session;
  Answers answers;
  for (const Vec3& point : points) answers.push_back(detector.nearest({point, 0}, reach, session));
  return answers;
}

void expect_same_bits(const Answers& answers, const Answers& expected, const std::string& what) {
  ASSERT_EQ(answers.size(), expected.size()) << what;
  const auto bits = [](const Vec3& v) {
    return std::bit_cast<std::array<std::uint64_t, 3>>(std::array{v.x(), v.y(), v.z()});
  };
  for (std::size_t i = 0; i < answers.size(); ++i) {
    ASSERT_EQ(answers[i].has_value(), expected[i].has_value()) << what << ", point " << i;
    if (!answers[i]) continue;
    ASSERT_EQ(answers[i]->triangle, expected[i]->triangle) << what << ", point " << i;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(answers[i]->distance),
              std::bit_cast<std::uint64_t>(expected[i]->distance))
        << what << ", point " << i;
    ASSERT_EQ(bits(answers[i]->point), bits(expected[i]->point)) << what << ", point " << i;
    ASSERT_EQ(bits(answers[i]->normal), bits(expected[i]->normal)) << what << ", point " << i;
    ASSERT_EQ(answers[i]->side, expected[i]->side) << what << ", point " << i;
  }
}

template <class D>
void expect_as_one_by_one(const D& detector, const char* name) {
  // Followed from call to call, one that moves on, and more than are followed.
  const Points few = scattered(700, 1), many = scattered(2100, 2);
  for (const double reach : {0.03, infinity}) {
    for (const AskOrder order : orders) {
      for (const unsigned threads : {1U, 2U, 3U}) {
        ManySessions<D> sessions;
        for (const Points& points :
             {few, few, moved(few, Vec3(0.001, 0, 0)), moved(few, Vec3(0, 0.4, 0)), many}) {
          Answers answers(points.size(), Contact{});
          nearest_many(detector, points, reach, answers, sessions, {threads, order});
          expect_same_bits(answers, one_by_one(detector, points, reach),
                           std::string(name) + ", " + std::to_string(threads) + " threads, order " +
                               std::to_string(static_cast<int>(order)));
        }
      }
    }
  }
}

TEST(NearestMany, AnswersAsOneByOneOfAnyDetector) {
  const TriangleMesh mesh = test::sheet(12);
  expect_as_one_by_one(BruteForce::build(mesh), "brute force");
  expect_as_one_by_one(AabbTree::build(mesh), "tree of boxes");
  expect_as_one_by_one(GridGroup::build(mesh), "grid group");
  expect_as_one_by_one(GridGroup::build(mesh, {.construction = GridGroup::Construction::lazy}), "lazy grid");
  expect_as_one_by_one(SphereCluster::build(mesh), "sphere cluster");
  expect_as_one_by_one(SphereCluster::build(mesh, {.construction = SphereCluster::Construction::lazy}),
                       "lazy sphere cluster");
  expect_as_one_by_one(Signed<SphereCluster>::build(mesh), "with sides");
}

TEST(NearestMany, AsksMorePointsThanAreFollowed) {
  const auto detector = SphereCluster::build(test::sheet(40));
  const Points points = scattered(ManySessions<SphereCluster>::max_followed + 1, 3);
  const Answers expected = one_by_one(detector, points, 0.03);
  for (const unsigned threads : {1U, 3U}) {
    ManySessions<SphereCluster> sessions;
    for (int call = 0; call < 2; ++call) {
      Answers answers(points.size());
      nearest_many(detector, points, 0.03, answers, sessions, {threads, AskOrder::automatic});
      expect_same_bits(answers, expected, std::to_string(threads));
    }
  }
}

TEST(NearestMany, AnswersNothingToPointsThatAreNotFinite) {
  const auto detector = GridGroup::build(test::sheet(12));
  Points points = scattered(600, 4);
  const Answers expected = one_by_one(detector, points, 0.05);
  for (std::size_t i = 0; i < points.size(); i += 3)
    points[i][static_cast<Eigen::Index>(i / 3 % 3)] = i % 2 == 0 ? nan : (i % 4 == 1 ? infinity : -infinity);
  points[1] = Vec3(1e308, -1e308, 1e308);  // The box is then larger than any double.
  for (const AskOrder order : orders) {
    ManySessions<GridGroup> sessions;
    for (int call = 0; call < 3; ++call) {
      Answers answers(points.size(), Contact{});
      nearest_many(detector, points, 0.05, answers, sessions, {2, order});
      for (std::size_t i = 0; i < points.size(); ++i) {
        const bool is_asked = i % 3 != 0 && i != 1;
        ASSERT_EQ(answers[i].has_value(), is_asked && expected[i].has_value()) << i;
        if (answers[i]) {
          ASSERT_EQ(answers[i]->distance, expected[i]->distance) << i;
        }
      }
    }
  }
}

TEST(NearestMany, TakesNoPointsAndOne) {
  const auto detector = SphereCluster::build(test::sheet(4));
  for (const AskOrder order : orders) {
    ManySessions<SphereCluster> sessions;
    nearest_many(detector, {}, 1, {}, sessions, {2, order});
    const Points one{{0.5, 0.5, 0.25}};
    Answers answers(1);
    nearest_many(detector, one, 1, answers, sessions, {2, order});
    expect_same_bits(answers, one_by_one(detector, one, 1), "one");
    nearest_many(detector, {}, 1, {}, sessions, {2, order});
  }
}

TEST(NearestMany, RefusesAnswersOfAnotherSizeAndSaysBoth) {
  const auto detector = AabbTree::build(test::sheet(4));
  const Points points = scattered(5, 5);
  Answers answers(6);
  try {
    nearest_many(detector, points, 1, answers);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("6 answers for 5 points"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(answers[0]);
}

template <class D>
void expect_right_after_changes(const char* name) {
  auto detector = D::build(test::sheet(20));
  const Points points = scattered(500, 6);
  ManySessions<D> sessions;
  Answers answers(points.size());
  const auto check = [&](const char* when) {
    for (int call = 0; call < 2; ++call) {
      nearest_many(detector, points, 0.1, answers, sessions);
      expect_same_bits(answers, one_by_one(detector, points, 0.1), std::string(name) + when);
    }
  };
  check(" at first");
  detector = D::build(test::sheet(3));  // in the same place, with fewer triangles
  check(" built anew");
  const TriangleMesh mesh = test::sheet(3);
  Points vertices(mesh.vertices().begin(), mesh.vertices().end());
  vertices[5].z() += 0.05;
  detector.update(TriangleMesh(vertices, {mesh.triangles().begin(), mesh.triangles().end()}));
  check(" updated");
}

TEST(NearestMany, KnowsNothingOfADetectorBuiltAnewOrUpdated) {
  expect_right_after_changes<AabbTree>("tree of boxes");
  expect_right_after_changes<GridGroup>("grid group");
  expect_right_after_changes<SphereCluster>("sphere cluster");
}

TEST(NearestMany, LooksAtTheSameForAnyNumberOfThreads) {
  const auto detector = SphereCluster::build(test::sheet(20));
  const Points points = scattered(3000, 7);
  std::vector<std::uint64_t> work;
  for (const unsigned threads : {1U, 2U, 3U}) {
    ManySessions<SphereCluster> sessions;
    Answers answers(points.size());
    nearest_many(detector, points, 0.05, answers, sessions, {threads, AskOrder::automatic});
    work.push_back(sessions.work().total());
    sessions.forget();
    EXPECT_EQ(sessions.work().total(), 0u);
  }
  EXPECT_GT(work[0], 3000u);
  EXPECT_EQ(work, std::vector(3, work[0]));
}

TEST(NearestMany, LooksAtLessAlongTheCurveAndWherePointsAreFollowed) {
  const auto detector = AabbTree::build(test::sheet(40));
  const Points points = scattered(4000, 8);
  const auto work_of = [&](AskOrder order, int calls) {
    ManySessions<AabbTree> sessions;
    Answers answers(points.size());
    std::uint64_t before = 0;
    for (int call = 0; call < calls; ++call) {
      before = sessions.work().total();
      nearest_many(detector, points, infinity, answers, sessions, {1, order});
    }
    return sessions.work().total() - before;
  };
  EXPECT_LT(work_of(AskOrder::curve, 1), work_of(AskOrder::as_given, 1));
  EXPECT_EQ(work_of(AskOrder::automatic, 1), work_of(AskOrder::curve, 1));
  // In the second call each point has a session of its own, which knows something in the third.
  EXPECT_LT(work_of(AskOrder::curve, 3), work_of(AskOrder::curve, 1));
}

TEST(CurveOrder, HoldsEachPointOnceThoseNotFiniteLast) {
  Points points = scattered(1000, 9);
  points[10].y() = nan;
  points[20].x() = -infinity;
  CurveOrder order;
  order.sort(points);
  std::vector<int> seen(points.size(), 0);
  for (const std::uint32_t index : order.indices()) ++seen[index];
  EXPECT_EQ(seen, std::vector<int>(points.size(), 1));
  EXPECT_EQ(order.indices()[998], 10u);
  EXPECT_EQ(order.indices()[999], 20u);
}

TEST(CurveOrder, TakesNeighboursOneAfterTheOther) {
  // A cube of 8 * 8 * 8 points: along the curve every eight are a small cube.
  Points points;
  for (std::uint32_t i = 0; i < 512; ++i) {
    const std::uint32_t k = i * 149 % 512;
    points.emplace_back(k % 8, k / 8 % 8, k / 64);
  }
  CurveOrder order;
  order.sort(points);
  for (std::size_t first = 0; first < 512; first += 8) {
    const Vec3 corner = points[order.indices()[first]];
    for (std::size_t k = first; k < first + 8; ++k)
      EXPECT_LE((points[order.indices()[k]] - corner).cwiseAbs().maxCoeff(), 1) << k;
  }
  EXPECT_FALSE(is_coherent(points));
}

TEST(ThreadCrew, DoesEachPartOnceInEveryCall) {
  ThreadCrew crew;
  crew.reserve(4);
  for (std::size_t call = 0; call < 300; ++call) {
    std::vector<std::atomic<int>> done(call % 40);
    crew.run(1 + call % 5, done.size(), [&](std::size_t part) noexcept { ++done[part]; });
    for (const std::atomic<int>& times : done) ASSERT_EQ(times, 1);
  }
}

}  // namespace
}  // namespace touchmark
