#include "bench/oracle/oracle.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "bench/oracle/exact/exact_distance.h"
#include "bench/oracle/float_limits.h"
#include "tests/bench/oracle/corner_case_meshes.h"

namespace touchmark::bench::oracle {

namespace stress = experiments::stress;

namespace {

std::vector<Triangle> all_triangles(const TriangleMesh& mesh) {
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < mesh.size(); ++i) triangles.push_back(triangle_of(mesh, i));
  return triangles;
}

std::vector<Probe> probes_at(const std::vector<Vec3>& points) {
  std::vector<Probe> probes;
  for (const Vec3& point : points) probes.push_back({point, 0});
  return probes;
}

TEST(Oracle, CullsNothingThatAPlainSearchFinds) {
  stress::CornerCases cases(21);
  for (const auto& [name, mesh] : corner_case_meshes()) {
    const std::vector<Triangle> triangles = all_triangles(mesh);
    const std::vector<Vec3> points = corner_case_points(mesh, cases, 60);
    const std::vector<GroundTruth> truths = Oracle(mesh, 2).solve(probes_at(points));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const ExactNearest expected = nearest_exactly(points[i], triangles);
      ASSERT_TRUE(truths[i].defined);
      ASSERT_EQ(truths[i].triangle, expected.which) << name << ", point " << i;
      ASSERT_EQ(truths[i].high, expected.high) << name << ", point " << i;
      ASSERT_EQ(truths[i].low, expected.low) << name << ", point " << i;
      ASSERT_EQ(truths[i].point, expected.point) << name << ", point " << i;
      ASSERT_EQ(truths[i].direction, expected.direction) << name << ", point " << i;
    }
  }
}

TEST(Oracle, FindsAllThatAPlainSearchFindsWithinARadius) {
  stress::CornerCases cases(22);
  for (const auto& [name, mesh] : corner_case_meshes()) {
    const Oracle oracle(mesh, 1);
    for (const Vec3& point : corner_case_points(mesh, cases, 20)) {
      const double nearest = oracle.solve(point).high;
      for (const double radius : {nearest, std::nextafter(nearest, 0), 1.01 * nearest, infinity}) {
        std::vector<std::uint32_t> expected;
        for (std::uint32_t i = 0; i < mesh.size(); ++i)
          if (compare_distance(point, triangle_of(mesh, i), radius) <= 0) expected.push_back(i);
        ASSERT_EQ(oracle.all_within(point, radius), expected) << name;
      }
    }
  }
}

TEST(Oracle, ASegmentComesWithinARadiusWhenItDoesSoOfOneTriangle) {
  stress::CornerCases cases(23);
  int yes = 0, no = 0;
  for (const auto& [name, mesh] : corner_case_meshes()) {
    const Oracle oracle(mesh, 1);
    const std::vector<Vec3> points = corner_case_points(mesh, cases, 24);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Vec3 &from = points[i], &to = points[i + 1];
      const double at_end = oracle.solve(to).high;
      for (const double radius : {0.0, at_end, std::nextafter(at_end, 0), at_end * cases.fraction()}) {
        bool expected = false;
        for (std::uint32_t t = 0; t < mesh.size() && !expected; ++t)
          expected = compare_segment_distance(from, to, triangle_of(mesh, t), radius) <= 0;
        ASSERT_EQ(oracle.segment_within(from, to, radius), expected) << name << ", way " << i;
        ++(expected ? yes : no);
      }
    }
  }
  EXPECT_GT(yes, 50);
  EXPECT_GT(no, 50);
}

TEST(Oracle, DecidesTheRadiusToTheLastBit) {
  stress::CornerCases cases(24);
  for (const auto& [name, mesh] : corner_case_meshes()) {
    const Oracle oracle(mesh, 1);
    for (const Vec3& point : corner_case_points(mesh, cases, 40)) {
      const GroundTruth truth = oracle.solve(point);
      for (const double radius :
           {truth.high, std::nextafter(truth.high, 0), std::nextafter(truth.high, infinity)}) {
        const bool expected = compare_distance(point, triangle_of(mesh, truth.triangle), radius) <= 0;
        EXPECT_EQ(oracle.within(truth, point, radius), expected) << name;
        EXPECT_EQ(oracle.within(truth.triangle, point, radius), expected) << name;
      }
    }
  }
}

TEST(Oracle, OneTriangleOfManyIsMeasuredAlone) {
  const TriangleMesh mesh = plate(2);
  const GroundTruth truth =
      Oracle(mesh).solve({0.25, 0.25, 1}, 7);  // the square from (1,1) to (2,2), upper half
  EXPECT_EQ(truth.triangle, 7U);
  EXPECT_EQ(truth.point, Vec3(1.5, 1.5, 0));
}

TEST(Oracle, WhatIsNotFiniteTouchesNothing) {
  const TriangleMesh mesh = plate(2);
  const Oracle oracle(mesh);
  for (const double bad : {std::nan(""), infinity, -infinity}) {
    const Vec3 center(1, bad, 0);
    EXPECT_FALSE(oracle.solve(center).defined);
    EXPECT_FALSE(oracle.within(oracle.solve(center), center, infinity));
    EXPECT_FALSE(oracle.within(0, center, infinity));
    EXPECT_TRUE(oracle.all_within(center, infinity).empty());
    EXPECT_FALSE(oracle.solve(Sweep{center, {0, 0, 0}, 1}).hit);
    EXPECT_FALSE(oracle.solve(Sweep{{0, 0, 0}, center, 1}).hit);
  }
}

TEST(Oracle, ARadiusThatIsNoneTouchesNothing) {
  const TriangleMesh mesh = plate(2);
  const Oracle oracle(mesh);
  const Vec3 center(1, 1, 0);
  for (const double bad : {std::nan(""), -1.0, -infinity}) {
    EXPECT_FALSE(oracle.within(oracle.solve(center), center, bad));
    EXPECT_FALSE(oracle.segment_within(center, center, bad));
    EXPECT_FALSE(oracle.solve(Sweep{center, center, bad}).hit);
  }
  EXPECT_TRUE(oracle.within(oracle.solve(center), center, 0));
  EXPECT_TRUE(oracle.segment_within(center, center, 0));
}

TEST(Oracle, TheEdgeOfTheDoublesIsNotTheEndOfIt) {
  const double most = std::numeric_limits<double>::max();
  const TriangleMesh mesh =
      stress::mesh_of({{Vec3(-most, -most, -most), Vec3(-most, 0, 0), Vec3(-most, 1, 1)}});
  const Oracle oracle(mesh);
  const Vec3 center(most, most, most);
  const GroundTruth truth = oracle.solve(center);
  EXPECT_TRUE(truth.defined);
  EXPECT_EQ(truth.high, infinity);
  EXPECT_FALSE(oracle.within(truth, center, most));
  EXPECT_TRUE(oracle.within(truth, center, infinity));
  EXPECT_TRUE(oracle.solve(Sweep{center, -center, 0}).hit);
}

TEST(Oracle, ASweepHitsWhatStandsInItsWay) {
  const TriangleMesh mesh = plate(2);
  const Oracle oracle(mesh);
  const SweepGroundTruth through = oracle.solve(Sweep{{0.5, 0.5, 1}, {0.5, 0.5, -1}, 0});
  EXPECT_TRUE(through.hit);
  EXPECT_FALSE(through.touching_at_start);
  EXPECT_TRUE(oracle.solve(Sweep{{0.5, 0.5, 0.25}, {0.5, 0.5, 1}, 0.25}).touching_at_start);
  EXPECT_FALSE(oracle.solve(Sweep{{0.5, 0.5, 2}, {0.5, 0.5, 1}, std::nextafter(1, 0)}).hit);
  EXPECT_TRUE(oracle.solve(Sweep{{0.5, 0.5, 2}, {0.5, 0.5, 1}, 1}).hit);
}

TEST(Oracle, ACrossingIsSureWhenItKeepsAwayFromEndsAndEdges) {
  const TriangleMesh mesh = stress::mesh_of({{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)}});
  const Oracle oracle(mesh);
  const auto crosses = [&](double x, double top, double bottom) {
    return oracle.surely_crosses({x, 1, top}, {x, 1, bottom}, 0.5);
  };
  EXPECT_TRUE(crosses(1, 1, -1));
  EXPECT_FALSE(crosses(1, 1, 0.75));   // never reaches it
  EXPECT_FALSE(crosses(1, 1, -0.5));   // hardly goes through
  EXPECT_FALSE(crosses(1, 0.5, -1));   // hardly before it
  EXPECT_FALSE(crosses(0.5, 1, -1));   // close by an edge
  EXPECT_FALSE(crosses(-0.5, 1, -1));  // past it
}

TEST(Oracle, TheNumberOfThreadsChangesNothing) {
  stress::CornerCases cases(25);
  const TriangleMesh mesh = octasphere(8);
  const std::vector<Probe> probes = probes_at(corner_case_points(mesh, cases, 500));
  const std::vector<GroundTruth> one = Oracle(mesh, 1).solve(probes), many = Oracle(mesh, 8).solve(probes);
  for (std::size_t i = 0; i < probes.size(); ++i) {
    EXPECT_EQ(one[i].triangle, many[i].triangle);
    EXPECT_EQ(one[i].high, many[i].high);
    EXPECT_EQ(one[i].low, many[i].low);
  }
}

}  // namespace
}  // namespace touchmark::bench::oracle
