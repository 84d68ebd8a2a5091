/// Each family of `touchmark stress` is what it says, by geometry and by the oracle.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/experiments/stress/family.h"
#include "bench/oracle/oracle.h"
#include "bench/trajectories/trajectories.h"
#include "bench/workload/content_hash.h"
#include "core/float_limits.h"

namespace touchmark::bench::experiments::stress {
namespace {

constexpr std::uint64_t seed = 7;
constexpr std::size_t few = 120;

std::vector<workload::Workload> made(const std::string& family, std::size_t probes = few) {
  return family_named(family).make(seed, probes);
}

/// Those that make a mesh at all.
std::vector<const Family*> all_but_the_empty_one() {
  std::vector<const Family*> list;
  for (const Family& family : families()) {
    if (family.name != "empty-mesh") list.push_back(&family);
  }
  return list;
}

std::vector<std::uint64_t> hashes(const std::vector<workload::Workload>& workloads) {
  std::vector<std::uint64_t> list;
  for (const workload::Workload& workload : workloads) {
    list.push_back(workload::hash_of(workload.mesh));
    for (const std::vector<workload::Step>& trace : workload.traces) list.push_back(workload::hash_of(trace));
  }
  return list;
}

oracle::GroundTruth truth_at(const oracle::Oracle& oracle, const workload::Step& step) {
  return oracle.solve(step.probe.center);
}

/// Longest side over the height on it, in long double: its cancellation is far below what the families need.
long double aspect_ratio(const TriangleMesh& mesh, std::size_t triangle) {
  long double side[3][3], length[3];
  for (int k = 0; k < 3; ++k) {
    const Vec3 &from = mesh.corner(triangle, k), &to = mesh.corner(triangle, (k + 1) % 3);
    for (int axis = 0; axis < 3; ++axis) side[k][axis] = static_cast<long double>(to[axis]) - from[axis];
    length[k] = std::hypot(side[k][0], side[k][1], side[k][2]);
  }
  const long double x = side[0][1] * side[1][2] - side[0][2] * side[1][1];
  const long double y = side[0][2] * side[1][0] - side[0][0] * side[1][2];
  const long double z = side[0][0] * side[1][1] - side[0][1] * side[1][0];
  const long double longest = std::max({length[0], length[1], length[2]});
  return longest * longest / std::hypot(x, y, z);
}

TEST(Families, AreTheSameForTheSameSeedAndOthersForAnother) {
  constexpr std::size_t enough = 600;  // the first centres of each mesh are the same for every seed
  for (const Family* family : all_but_the_empty_one()) {
    EXPECT_EQ(hashes(family->make(seed, enough)), hashes(family->make(seed, enough))) << family->name;
    EXPECT_NE(hashes(family->make(seed, enough)), hashes(family->make(seed + 1, enough))) << family->name;
  }
}

TEST(Families, AskAboutAsMuchAsTheyAreTold) {
  constexpr std::size_t many = 3000;
  for (const Family* family : all_but_the_empty_one()) {
    std::size_t asked = 0;
    for (const workload::Workload& workload : family->make(seed, many)) {
      EXPECT_EQ(workload.traces.size(), workload.trajectories.size());
      for (const std::vector<workload::Step>& trace : workload.traces) asked += trace.size();
    }
    EXPECT_GT(asked, many * 2 / 5) << family->name;
    EXPECT_LT(asked, many * 5 / 4) << family->name;
  }
}

TEST(Families, AdversarialOnesAskAtTheExactDistanceOrADoubleNextToIt) {
  std::size_t inside = 0, outside = 0;
  for (const Family& family : families()) {
    if (!family.adversarial) continue;
    for (const workload::Workload& workload : family.make(seed, few)) {
      const oracle::Oracle oracle(workload.mesh);
      for (const workload::Step& step : workload.traces.front()) {
        const oracle::GroundTruth truth = truth_at(oracle, step);
        const double radius = step.probe.radius;
        EXPECT_EQ(step.reach, radius);
        const bool next_to_it = radius == truth.high || radius == std::nextafter(truth.high, 0) ||
                                radius == std::nextafter(truth.high, infinity);
        EXPECT_TRUE(next_to_it || radius == 0) << family.name << ": " << radius << " at " << truth.high;
        ++(oracle.within(truth, step.probe.center, radius) ? inside : outside);
      }
    }
  }
  EXPECT_GT(inside, outside / 2) << "both sides of the edge of contact must be asked";
  EXPECT_GT(outside, inside / 4);
}

TEST(Families, ThresholdsHaveContactOnOneSideOnly) {
  for (const workload::Workload& workload : made("thresholds")) {
    const oracle::Oracle oracle(workload.mesh);
    const std::vector<workload::Step>& trace = workload.traces.front();
    for (std::size_t i = 0; i + 2 < trace.size(); ++i) {
      const oracle::GroundTruth truth = truth_at(oracle, trace[i]);
      if (trace[i].probe.center != trace[i + 2].probe.center || trace[i].probe.radius >= truth.high) continue;
      EXPECT_FALSE(oracle.within(truth, trace[i].probe.center, trace[i].probe.radius));
      EXPECT_TRUE(oracle.within(truth, trace[i].probe.center, trace[i + 2].probe.radius));
    }
  }
}

TEST(Families, NeedlesAndCapsAreThin) {
  for (const char* family : {"needles", "caps"}) {
    const TriangleMesh mesh = made(family).back().mesh;
    long double thinnest = 0;
    for (std::size_t i = 0; i < mesh.size(); ++i) {
      EXPECT_GT(aspect_ratio(mesh, i), 300) << family << ", triangle " << i;
      thinnest = std::max(thinnest, aspect_ratio(mesh, i));
    }
    EXPECT_GT(thinnest, 1e13L) << family;
  }
}

TEST(Families, NeedlesHaveAShortSideAndCapsHaveNone) {
  const auto shortest_over_longest = [](const TriangleMesh& mesh, std::size_t i) {
    double shortest = infinity, longest = 0;
    for (int k = 0; k < 3; ++k) {
      const double length = (mesh.corner(i, k) - mesh.corner(i, (k + 1) % 3)).norm();
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
    }
    return shortest / longest;
  };
  const TriangleMesh needles = made("needles").back().mesh, caps = made("caps").back().mesh;
  for (std::size_t i = 0; i < needles.size(); ++i) EXPECT_LT(shortest_over_longest(needles, i), 0.003);
  for (std::size_t i = 0; i < caps.size(); ++i) EXPECT_GT(shortest_over_longest(caps, i), 0.19);
}

TEST(Families, RadiusZeroIsExactlyOnTheSurfaceOrHardlyOffIt) {
  std::size_t on = 0, off = 0;
  for (const workload::Workload& workload : made("radius-zero")) {
    const oracle::Oracle oracle(workload.mesh);
    const std::vector<workload::Step>& trace = workload.traces.front();
    for (std::size_t i = 0; i < trace.size(); ++i) {
      const oracle::GroundTruth truth = truth_at(oracle, trace[i]);
      EXPECT_EQ(trace[i].probe.radius, 0);
      EXPECT_LT(truth.high, 1e-15);
      if (i % 2 == 0) {
        EXPECT_EQ(truth.high, 0) << "step " << i;
      }
      ++(truth.high == 0 ? on : off);
    }
  }
  EXPECT_GT(off, on / 8) << "a nudge must leave some faces";
}

TEST(Families, TangentBallsTouchInDoublesExactly) {
  for (const workload::Workload& workload : made("tangent")) {
    const oracle::Oracle oracle(workload.mesh);
    for (const workload::Step& step : workload.traces.front()) {
      const oracle::GroundTruth truth = truth_at(oracle, step);
      EXPECT_EQ(truth.low, 0) << "the distance must be a double";
      EXPECT_EQ(oracle.within(truth, step.probe.center, step.probe.radius), step.probe.radius >= truth.high);
    }
  }
}

TEST(Families, TiesHaveTwoNearestTrianglesAtLeast) {
  for (const workload::Workload& workload : made("ties")) {
    const oracle::Oracle oracle(workload.mesh);
    for (const workload::Step& step : workload.traces.front()) {
      const oracle::GroundTruth truth = truth_at(oracle, step);
      std::size_t tied = 0;
      for (const std::uint32_t other :
           oracle.all_within(step.probe.center, std::nextafter(truth.high, infinity))) {
        const oracle::GroundTruth same = oracle.solve(step.probe.center, other);
        const double known_to = 0x1p-99 * truth.high;  // of each low half 2^-100
        tied += same.high == truth.high && std::abs(same.low - truth.low) <= known_to ? 1 : 0;
      }
      EXPECT_GE(tied, 2U) << workload.mesh_name;
    }
  }
}

TEST(Families, BallCentreIsAboutTheMiddle) {
  for (const workload::Workload& workload : made("ball-centre")) {
    EXPECT_EQ(workload.traces.front().front().probe.center, Vec3::Zero());
    for (const workload::Step& step : workload.traces.front()) EXPECT_LT(step.probe.center.norm(), 0.02);
  }
}

TEST(Families, CellBordersLieAtFractionsOfTheBox) {
  const workload::Workload workload = made("cell-borders").front();
  EXPECT_EQ(workload.mesh.bounds().min, Vec3::Zero());
  EXPECT_EQ(workload.mesh.bounds().max, Vec3::Ones());
  std::size_t on_halves = 0;  // of the finest grid of all counts that are powers of two
  for (const workload::Step& step : workload.traces.front()) {
    const Vec3 cell = 64 * step.probe.center;
    on_halves += cell == Vec3(cell.array().round()) ? 1 : 0;
  }
  EXPECT_GT(on_halves, workload.traces.front().size() / 10);
}

TEST(Families, OneCellHoldsAllTrianglesButTwo) {
  for (const workload::Workload& workload : made("one-cell")) {
    const TriangleMesh& mesh = workload.mesh;
    Aabb cluster;
    for (std::size_t i = 0; i + 2 < mesh.size(); ++i)
      for (int k = 0; k < 3; ++k) cluster.extend(mesh.corner(i, k));
    EXPECT_LT(cluster.diagonal(), 2e-4 * mesh.diagonal());
  }
}

TEST(Families, TheSpanningTriangleIsAsLargeAsTheMesh) {
  for (const workload::Workload& workload : made("spanning-triangle")) {
    Aabb large, others;
    for (int k = 0; k < 3; ++k) large.extend(workload.mesh.corner(0, k));
    for (std::size_t i = 1; i < workload.mesh.size(); ++i)
      for (int k = 0; k < 3; ++k) others.extend(workload.mesh.corner(i, k));
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_LT(large.min[axis], others.min[axis]);
      EXPECT_GT(large.max[axis], others.max[axis]);
    }
  }
}

TEST(Families, SingleTrianglesAreSingle) {
  for (const workload::Workload& workload : made("single-triangle")) EXPECT_EQ(workload.mesh.size(), 1U);
}

TEST(Families, ScalesGoToTheEndsOfTheRangeOfDouble) {
  double least = infinity, most = 0;
  for (const workload::Workload& workload : made("scales")) {
    const double extent = workload.mesh.bounds().extent().maxCoeff();
    least = std::min(least, extent);
    most = std::max(most, extent);
    EXPECT_FALSE(workload.traces.front().empty()) << workload.mesh_name;
  }
  EXPECT_LT(least, 1e-299);
  EXPECT_GT(most, 1e299);
}

TEST(Families, OffsetsGoToWhereAMeshIsAFewDoublesWide) {
  double farthest = 0;
  for (const workload::Workload& workload : made("offsets")) {
    const Aabb& box = workload.mesh.bounds();
    farthest = std::max(farthest, box.max.cwiseAbs().maxCoeff() / box.extent().maxCoeff());
    EXPECT_GT(workload.traces.front().size(), 2U) << workload.mesh_name;
  }
  EXPECT_GE(farthest, 0x1p49);
  EXPECT_LE(farthest, 0x1p51);
}

TEST(Families, HugeProbesAreHuge) {
  double farthest = 0;
  std::set<double> reaches;
  for (const workload::Workload& workload : made("huge")) {
    for (const workload::Step& step : workload.traces.front()) {
      farthest = std::max(farthest, step.probe.center.cwiseAbs().maxCoeff());
      reaches.insert(step.reach);
    }
  }
  EXPECT_GT(farthest, 1e290);
  EXPECT_TRUE(reaches.contains(infinity));
}

TEST(Families, DenormalProbesAndMeshesAreDenormal) {
  const std::vector<workload::Workload> workloads = made("denormal");
  double smallest_mesh = infinity;
  for (const workload::Workload& workload : workloads)
    smallest_mesh = std::min(smallest_mesh, workload.mesh.bounds().max.cwiseAbs().maxCoeff());
  EXPECT_LT(smallest_mesh, std::numeric_limits<double>::min());
  EXPECT_GT(smallest_mesh, 0);
  for (const workload::Step& step : workloads.back().traces.front()) EXPECT_LE(step.probe.radius, 1e-300);
}

TEST(Families, NotANumberHasSomethingInEachProbeThatCannotTouch) {
  for (const workload::Workload& workload : made("not-a-number")) {
    for (const workload::Step& step : workload.traces.front()) {
      const bool negative_or_nan = !(step.probe.radius >= 0), zero = step.probe.radius == 0;
      EXPECT_TRUE(!step.probe.center.allFinite() || negative_or_nan || zero);
    }
  }
}

TEST(Families, TheEmptyMeshCannotBeMade) { EXPECT_THROW(made("empty-mesh"), MeshError); }

TEST(Families, MotionsAreAllThatThereAre) {
  std::set<std::string> names;
  for (const trajectories::TrajectoryInfo& trajectory : trajectories::trajectories())
    names.insert(trajectory.name);
  for (const workload::Workload& workload : made("motions"))
    EXPECT_EQ(std::set<std::string>(workload.trajectories.begin(), workload.trajectories.end()), names);
}

TEST(Families, OrdinaryProbesAreBothInContactAndNot) {
  for (const workload::Workload& workload : made("ordinary")) {
    const oracle::Oracle oracle(workload.mesh);
    std::size_t touching = 0;
    for (const workload::Step& step : workload.traces.front())
      touching += oracle.within(truth_at(oracle, step), step.probe.center, step.probe.radius) ? 1 : 0;
    EXPECT_GT(touching, workload.traces.front().size() / 10) << workload.mesh_name;
    EXPECT_LT(touching, workload.traces.front().size() * 9 / 10) << workload.mesh_name;
  }
}

TEST(Families, AnUnknownNameIsToldTheNearest) {
  try {
    family_named("neadles");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("needles"), std::string::npos);
  }
}

}  // namespace
}  // namespace touchmark::bench::experiments::stress
