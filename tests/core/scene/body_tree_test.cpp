// The tree of bodies' boxes against every box looked at in turn.
#include "core/scene/body_tree/body_tree.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "bench/support/random.h"
#include "core/float_limits.h"

namespace touchmark {
namespace {

using bench::support::Random;

using Boxes = std::map<std::uint32_t, Aabb>;

Aabb box_about(const Vec3& center, const Vec3& size) {
  Aabb box;
  box.extend(center - size.cwiseAbs());
  box.extend(center + size.cwiseAbs());
  return box;
}

double distance(const Aabb& a, const Aabb& b) {
  return (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(Vec3::Zero()).norm();
}

/// Every body within the limit is visited, and none twice.
void expect_finds_all_within(const BodyTree& tree, const Boxes& boxes, const Aabb& region, double limit) {
  std::map<std::uint32_t, int> visited;
  tree.for_each_within(region, limit, [&](std::uint32_t body) {
    ++visited[body];
    return limit;
  });
  if (region.min == region.max) {
    std::map<std::uint32_t, int> about_point;
    tree.for_each_within(region.min, limit, [&](std::uint32_t body) {
      ++about_point[body];
      return limit;
    });
    EXPECT_EQ(about_point, visited);
  }
  for (const auto& [body, times] : visited) {
    EXPECT_EQ(times, 1) << body;
    EXPECT_EQ(boxes.count(body), 1u) << body;
  }
  for (const auto& [body, box] : boxes)
    EXPECT_TRUE(visited.count(body) == 1 || distance(box, region) > limit) << body;
}

/// Bodies come, go and move at random, where `place` says.
template <class Place>
void expect_follows(std::uint64_t seed, std::uint32_t bodies, double size, const Place& place) {
  Random random(seed);
  BodyTree tree;
  Boxes boxes;
  for (int step = 0; step < 3000; ++step) {
    const auto body = static_cast<std::uint32_t>(random.below(bodies));
    // Growing, then shrinking to nothing, then growing again.
    const double share = step % 1500 < 1000 ? 0.2 : 0.9;
    const bool leaves = boxes.count(body) != 0 && random.between(0, 1) < share;
    if (boxes.count(body) != 0) tree.remove(body);
    boxes.erase(body);
    if (!leaves) {
      const Aabb box = box_about(place(random), random.point(0.05 * size));
      const double margin = random.below(2) == 0 ? 0 : 0.1 * size;
      tree.insert(body, box, margin);
      boxes[body] = box;
      EXPECT_GE(tree.room(body, box), margin == 0 ? 0 : 0.09 * size);
    }
    if (step % 10 != 0) continue;
    const Vec3 from = place(random);
    Aabb region = {from, from};
    if (random.below(2) == 0) region.extend(from + random.point(0.1 * size));
    for (const double limit : {0.0, 0.1 * size, 0.5 * size, infinity})
      expect_finds_all_within(tree, boxes, region, limit);
  }
  while (!boxes.empty()) {
    tree.remove(boxes.begin()->first);
    boxes.erase(boxes.begin());
    if (boxes.size() % 16 == 0) expect_finds_all_within(tree, boxes, {}, 0);
    expect_finds_all_within(tree, boxes, {Vec3::Zero(), Vec3::Zero()}, size);
  }
}

TEST(BodyTree, FindsWhoComesGoesAndMovesAnywhere) {
  expect_follows(1, 300, 1, [](Random& random) { return random.point(1); });
}

TEST(BodyTree, FindsThoseThatAreAllAtOnePlace) {
  expect_follows(2, 200, 1, [](Random&) { return Vec3(3, 4, 5); });
}

TEST(BodyTree, FindsThoseInClustersFarFromTheOrigin) {
  expect_follows(3, 200, 1, [](Random& random) {
    const double far = 1e6 * static_cast<double>(random.below(3));
    return Vec3(far + random.between(-1, 1), random.between(-1, 1), -far);
  });
}

TEST(BodyTree, FindsThoseOnALineInOrder) {
  double at = 0;
  expect_follows(4, 200, 1, [&](Random&) { return Vec3(std::fmod(at += 0.01, 2.0), 0, 0); });
}

TEST(BodyTree, FindsThoseOfSizesNearTheEndsOfSinglePrecision) {
  for (const double size : {1e-44, 1e-30, 1e30, 1e38, 1e200})
    expect_follows(5, 100, size, [&](Random& random) { return random.point(size); });
}

TEST(BodyTree, FindsABodyWhosePlaceIsNoNumberFromAnywhere) {
  BodyTree tree;
  Boxes boxes;
  Random random(6);
  for (std::uint32_t i = 0; i < 100; ++i) {
    boxes[i] = box_about(random.point(1), random.point(0.1));
    if (i % 10 == 3) boxes[i] = {Vec3::Constant(-infinity), Vec3::Constant(infinity)};
    tree.insert(i, boxes[i], 0);
  }
  for (int i = 0; i < 100; ++i) {
    const Vec3 at = random.point(2);
    expect_finds_all_within(tree, boxes, {at, at}, 0.1);
  }
  for (std::uint32_t i = 0; i < 100; ++i) tree.remove(i);
  tree.insert(0, box_about(Vec3::Zero(), Vec3::Ones()), 0);
  expect_finds_all_within(tree, {{0, box_about(Vec3::Zero(), Vec3::Ones())}}, {Vec3::Zero(), Vec3::Zero()},
                          0);
}

TEST(BodyTree, GoesOnWithTheLimitThatAVisitReturns) {
  Random random(7);
  BodyTree tree;
  std::vector<Vec3> places;
  for (std::uint32_t i = 0; i < 500; ++i) {
    places.push_back(random.point(1));
    tree.insert(i, {places[i], places[i]}, 0);
  }
  for (int i = 0; i < 200; ++i) {
    const Vec3 at = random.point(1.5);
    double nearest = infinity;
    std::size_t visits = 0;
    tree.for_each_within(Aabb{at, at}, nearest, [&](std::uint32_t body) {
      ++visits;
      return nearest = std::min(nearest, (places[body] - at).norm());
    });
    double expected = infinity;
    for (const Vec3& place : places) expected = std::min(expected, (place - at).norm());
    EXPECT_EQ(nearest, expected);
    EXPECT_LE(visits, 100u);
    tree.for_each_within(at, 10, [&](std::uint32_t) {
      ++visits;
      return -1.0;
    });
    EXPECT_LE(visits, 101u);
  }
}

TEST(BodyTree, TakesBoxesFromAnotherTree) {
  Random random(8);
  BodyTree tree, copy;
  Boxes boxes;
  for (std::uint32_t i = 0; i < 200; ++i) {
    boxes[i] = box_about(random.point(1), random.point(0.1));
    tree.insert(i, boxes[i], 0.1);
    copy.insert_as_in(i, tree);
    EXPECT_EQ(copy.room(i, boxes[i]), tree.room(i, boxes[i]));
  }
  for (int i = 0; i < 100; ++i) {
    const Vec3 at = random.point(2);
    expect_finds_all_within(copy, boxes, {at, at}, 0.2);
  }
}

}  // namespace
}  // namespace touchmark
