#include "bench/trajectories/trajectories.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "bench/support/random.h"
#include "bench/trajectories/mesh_edges.h"
#include "core/float_limits.h"
#include "tests/bench/trajectories/distances.h"
#include "tests/bench/trajectories/simple_meshes.h"

namespace touchmark::bench::trajectories {
namespace {

/// A closed surface without sharp edges: a torus of 24 x 16 quads.
TriangleMesh torus() {
  constexpr std::uint32_t n = 24, m = 16;
  std::vector<Vec3> v;
  std::vector<TriangleMesh::Corners> t;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < m; ++j) {
      const double a = 2 * M_PI * i / n, b = 2 * M_PI * j / m, r = 1 + 0.4 * std::cos(b);
      v.emplace_back(r * std::cos(a), r * std::sin(a), 0.4 * std::sin(b));
      const auto at = [](std::uint32_t x, std::uint32_t y) { return (x % n) * m + y % m; };
      t.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      t.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return TriangleMesh(v, t);
}

TriangleMesh soup() {
  support::Random random(5);
  std::vector<Vec3> v;
  std::vector<TriangleMesh::Corners> t;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const Vec3 center(random.unit(), random.unit(), random.unit());
    for (int k = 0; k < 3; ++k) v.emplace_back(center + 0.1 * random.direction());
    t.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return TriangleMesh(v, t);
}

TriangleMesh point() { return TriangleMesh({{1, 2, 3}}, {{0, 0, 0}}); }
TriangleMesh line() { return TriangleMesh({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}, {{0, 1, 2}}); }
TriangleMesh doubled() {
  const TriangleMesh once = torus();
  std::vector<TriangleMesh::Corners> twice(once.triangles().begin(), once.triangles().end());
  twice.insert(twice.end(), once.triangles().begin(), once.triangles().end());
  return TriangleMesh({once.vertices().begin(), once.vertices().end()}, twice);
}

std::vector<double> step_lengths(const Trajectory& path) {
  std::vector<double> all;
  for (std::size_t i = 1; i < path.size(); ++i)
    all.push_back((path.positions[i] - path.positions[i - 1]).norm());
  return all;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}
std::size_t longer_than(double length, const std::vector<double>& values) {
  return static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [&](double value) { return value > length; }));
}

/// How many cells of a grid of 1/8 diagonal the path enters.
std::size_t places_seen(const Trajectory& path, const TriangleMesh& mesh) {
  std::set<std::array<int, 3>> cells;
  for (const Vec3& p : path.positions) {
    const Vec3 cell = (8 / mesh.diagonal() * (p - mesh.bounds().min)).array().floor();
    cells.insert({static_cast<int>(cell.x()), static_cast<int>(cell.y()), static_cast<int>(cell.z())});
  }
  return cells.size();
}

Trajectory make(const std::string& name, const TriangleMesh& mesh, std::size_t steps, double radius,
                std::uint64_t seed = 1) {
  return make_trajectory(name, mesh, {steps, seed, radius});
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const TrajectoryInfo& info : trajectories()) all.push_back(info.name);
  return all;
}

TEST(Trajectories, AreTheEightOfTheDesign) {
  EXPECT_EQ(names(),
            (std::vector<std::string>{"slide", "approach", "hover", "jump", "tap", "edge", "cross", "hand"}));
}

TEST(Trajectories, HaveAsManyFiniteStepsAsAsked) {
  for (const std::string& name : names()) {
    for (const TriangleMesh& mesh : {cube(), torus(), plate(), soup(), point(), line(), doubled()}) {
      for (const double radius : {0.0, 0.01, 100.0, infinity}) {
        for (const std::size_t steps : {1, 2, 300}) {
          const Trajectory path = make(name, mesh, steps, radius);
          EXPECT_EQ(path.name, name);
          ASSERT_EQ(path.size(), steps) << name;
          EXPECT_TRUE(path.radii.empty() && path.times_s.empty());
          for (const Vec3& p : path.positions) ASSERT_TRUE(p.allFinite()) << name;
        }
      }
    }
  }
}

TEST(Trajectories, HaveTwentyThousandStepsUnlessTold) {
  EXPECT_EQ(make_trajectory("jump", cube()).size(), 20'000u);
}

TEST(Trajectories, AreTheSameForTheSameSeedAndDifferForAnother) {
  for (const std::string& name : names()) {
    const Trajectory one = make(name, torus(), 500, 0.02);
    EXPECT_EQ(one.positions, make(name, torus(), 500, 0.02).positions) << name;
    EXPECT_NE(one.positions, make(name, torus(), 500, 0.02, 2).positions) << name;
  }
}

TEST(Trajectories, UseTheRandomBitsOfTheStandard) {
  support::Random random(5489);
  for (int i = 0; i < 9'999; ++i) random.unit();
  // [rand.predef]: the 10000th output of mt19937_64 is 9981545732273789042.
  EXPECT_EQ(random.unit(), static_cast<double>(9981545732273789042ULL >> 11) * 0x1p-53);
}

TEST(Trajectories, ScaleWithTheMesh) {
  for (const std::string& name : names()) {
    const Trajectory one = make(name, torus(), 300, 0.02);
    const Trajectory big = make(name, torus().transformed(1024, Vec3::Zero()), 300, 0.02 * 1024);
    // A power of two scales every operation without rounding.
    for (std::size_t i = 0; i < one.size(); ++i) ASSERT_EQ(1024 * one.positions[i], big.positions[i]) << name;
  }
}

TEST(Trajectories, WorkFarFromTheOrigin) {
  const TriangleMesh far = torus().transformed(1, Vec3::Constant(1e6));
  EXPECT_LE(most(distances(make("slide", far, 2000, 0.02), far)), 0.02);
  const std::vector<double> hover = distances(make("hover", far, 2000, 0.02), far);
  EXPECT_GE(least(hover), 0.02 * far.diagonal() - 1e-8);
  EXPECT_GT(places_seen(make("slide", far, 4000, 0.02), far), 8u);
}

TEST(Slide, StaysInContactOnEveryKindOfMesh) {
  for (const TriangleMesh& mesh : {cube(), torus(), plate(), soup(), line(), doubled(), point()}) {
    for (const double percent : {0.0, 0.01, 0.5, 4.0, 50.0}) {
      const double radius = percent / 100 * mesh.diagonal();
      // A rounding of the coordinates, for the bare point.
      EXPECT_LE(most(distances(make("slide", mesh, 2000, radius), mesh)), radius + 1e-14) << percent;
    }
  }
}

TEST(Slide, GoesHalfAThousandthOfTheDiagonalATick) {
  for (const TriangleMesh& mesh : {cube(), torus()}) {
    const double step = 0.0005 * mesh.diagonal();
    for (const double radius : {0.0, 0.01, 0.1}) {
      const std::vector<double> lengths = step_lengths(make("slide", mesh, 5000, radius));
      EXPECT_NEAR(median(lengths), step, 0.05 * step);
      EXPECT_LE(most(lengths), 2.0001 * step);
    }
  }
}

TEST(Slide, IsNeverStuck) {
  for (const TriangleMesh& mesh : {cube(), torus(), plate()}) {
    for (const double radius : {0.0, 0.01}) {
      const Trajectory path = make("slide", mesh, 20'000, radius);
      EXPECT_GT(places_seen(path, mesh), 25u) << radius;
      for (std::size_t i = 1000; i < path.size(); i += 1000) {
        Aabb box;
        for (std::size_t k = i - 1000; k < i; ++k) box.extend(path.positions[k]);
        EXPECT_GT(box.diagonal(), 0.01 * mesh.diagonal());
      }
    }
  }
  EXPECT_GT(places_seen(make("slide", soup(), 20'000, 0.0), soup()), 2u);
}

TEST(Slide, CrossesTheEdgesOfTheCube) {
  const Trajectory path = make("slide", cube(), 20'000, 0.0);
  std::set<int> faces;
  for (const Vec3& p : path.positions) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(p[axis]) < 1e-12) faces.insert(axis);
      if (std::abs(p[axis] - 1) < 1e-12) faces.insert(3 + axis);
    }
  }
  EXPECT_EQ(faces.size(), 6u);
}

TEST(Approach, ComesFromThreeTenthsOfTheDiagonalAndPresses) {
  const TriangleMesh mesh = cube();
  const double radius = 0.02;
  const Trajectory path = make("approach", mesh, 20'000, radius);
  const std::vector<double> distance = distances(path, mesh);
  EXPECT_NEAR(distance[0], 0.3 * mesh.diagonal(), 1e-12);
  std::set<std::array<int, 3>> pressed;
  for (std::size_t i = 1; i + 1 < distance.size(); ++i) {
    const bool deepest = std::abs(distance[i] - radius / 2) < 1e-9 && distance[i] < radius;
    const Vec3 p = 100 * path.positions[i];
    if (deepest) pressed.insert({static_cast<int>(p.x()), static_cast<int>(p.y()), static_cast<int>(p.z())});
  }
  EXPECT_GE(pressed.size(), 5u);
  EXPECT_LE(most(step_lengths(path)), 1.5 * mesh.diagonal() / 1000 * 1.0001);
}

TEST(Approach, PressesInAShortRunToo) {
  const std::vector<double> distance = distances(make("approach", cube(), 400, 0.02), cube());
  EXPECT_GE(std::count_if(distance.begin(), distance.end(), [](double d) { return d <= 0.02; }), 10);
  EXPECT_GT(most(distance), 0.29 * cube().diagonal());
}

TEST(Hover, StaysInItsBandAndCoversIt) {
  for (const TriangleMesh& mesh : {cube(), torus(), plate(), soup(), line(), doubled()}) {
    const Trajectory path = make("hover", mesh, 20'000, 0.01);
    const std::vector<double> distance = distances(path, mesh);
    EXPECT_GE(least(distance), 0.02 * mesh.diagonal() * (1 - 1e-12));
    EXPECT_LE(most(distance), 0.3 * mesh.diagonal() * (1 + 1e-12));
    EXPECT_LT(least(distance), 0.03 * mesh.diagonal());
    EXPECT_GT(most(distance), 0.2 * mesh.diagonal());
    EXPECT_NEAR(median(step_lengths(path)), 0.001 * mesh.diagonal(), 1e-9);
    EXPECT_GT(places_seen(path, mesh), 50u);
  }
}

TEST(Jump, IsUniformInOnePointTwoTimesTheBox) {
  const TriangleMesh mesh = cube().transformed(1, Vec3(10, -20, 30));
  const Trajectory path = make("jump", mesh, 40'000, 0.01);
  Vec3 mean = Vec3::Zero();
  Aabb seen;
  std::size_t inside = 0;
  for (const Vec3& p : path.positions) {
    seen.extend(p);
    mean += p / static_cast<double>(path.size());
    inside += mesh.bounds().contains(p) ? 1 : 0;
  }
  EXPECT_TRUE(mesh.bounds().padded(0.1 + 1e-12).contains(seen.min));
  EXPECT_TRUE(mesh.bounds().padded(0.1 + 1e-12).contains(seen.max));
  EXPECT_LT((seen.extent() - Vec3::Constant(1.2)).norm(), 0.001);
  // Five standard deviations of the mean of 40,000, and of the share inside, (1 / 1.2)^3.
  EXPECT_LT((mean - mesh.bounds().center()).cwiseAbs().maxCoeff(), 5 * 1.2 / std::sqrt(12 * 40'000.0));
  EXPECT_NEAR(static_cast<double>(inside) / 40'000, 1 / 1.728, 5 * std::sqrt(0.25 / 40'000));
  EXPECT_GT(median(step_lengths(path)), 0.5);
}

TEST(Jump, LeavesThePlaneOfAFlatMesh) {
  EXPECT_GT(median(distances(make("jump", plate(), 1000, 0), plate())), 0.01);
}

TEST(Tap, TouchesOftenAtManyPlacesAndLiftsBetween) {
  const TriangleMesh mesh = torus();
  const double radius = 0.01;
  const Trajectory path = make("tap", mesh, 20'000, radius);
  const std::vector<double> distance = distances(path, mesh);
  std::set<std::array<int, 3>> places;
  std::size_t contacts = 0, longest = 0, now = 0;
  for (std::size_t i = 1; i < distance.size(); ++i) {
    const bool begins = distance[i] <= radius && distance[i - 1] > radius;
    contacts += begins ? 1 : 0;
    const Vec3 p = 20 * path.positions[i];
    if (begins) places.insert({static_cast<int>(p.x()), static_cast<int>(p.y()), static_cast<int>(p.z())});
    now = distance[i] <= radius ? now + 1 : 0;
    longest = std::max(longest, now);
  }
  EXPECT_GT(contacts, 150u);
  EXPECT_GT(places.size(), 50u);
  EXPECT_LT(longest, 60u);
}

TEST(Edge, FollowsTheTwelveEdgesOfTheCubeAndNotTheDiagonals) {
  const double radius = 0.01;
  const Trajectory path = make("edge", cube(), 40'000, radius);
  std::set<int> followed;
  std::size_t near = 0;
  for (const Vec3& p : path.positions) {
    for (int axis = 0; axis < 3; ++axis) {
      const double u = p[(axis + 1) % 3], v = p[(axis + 2) % 3];
      const double du = std::min(std::abs(u), std::abs(u - 1)), dv = std::min(std::abs(v), std::abs(v - 1));
      if (std::hypot(du, dv) > radius || p[axis] < -radius || p[axis] > 1 + radius) continue;
      followed.insert(4 * axis + (u > 0.5 ? 2 : 0) + (v > 0.5 ? 1 : 0));
      ++near;
      break;
    }
  }
  EXPECT_EQ(followed.size(), 12u);
  EXPECT_GT(near, 34'000u);  // the rest is on the way to another place
  EXPECT_NEAR(median(step_lengths(path)), 0.0005 * cube().diagonal(), 0.0001);
}

TEST(Edge, FallsBackToAnyEdgesOfASmoothMesh) {
  const MeshEdges edges(torus());
  EXPECT_TRUE(
      std::none_of(edges.edges().begin(), edges.edges().end(), [](const MeshEdge& e) { return e.sharp; }));
  const std::vector<double> distance = distances(make("edge", torus(), 5000, 0.01), torus());
  EXPECT_LT(median(distance), 0.01);
}

TEST(Edge, SeesThroughSplitVerticesAndTurnedFaces) {
  // The cube with three vertices of its own for each triangle, every other triangle turned over.
  const TriangleMesh welded = cube();
  std::vector<Vec3> v;
  std::vector<TriangleMesh::Corners> t;
  for (std::uint32_t i = 0; i < welded.size(); ++i) {
    for (int k = 0; k < 3; ++k) v.push_back(welded.corner(i, i % 2 == 0 ? k : 2 - k));
    t.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const MeshEdges edges(TriangleMesh(v, t));
  EXPECT_EQ(edges.edges().size(), 18u);
  EXPECT_EQ(
      std::count_if(edges.edges().begin(), edges.edges().end(), [](const MeshEdge& e) { return e.sharp; }),
      12);
}

TEST(Edge, CountsBordersAsSharp) {
  const MeshEdges edges(plate());
  EXPECT_EQ(edges.edges().size(), 5u);
  EXPECT_EQ(
      std::count_if(edges.edges().begin(), edges.edges().end(), [](const MeshEdge& e) { return e.sharp; }),
      4);
}

TEST(Cross, FliesThroughAThinPlateSeveralRadiiATick) {
  // A slab 0.01 thick, so that from first to last contact it is less than a tick's way.
  const TriangleMesh mesh = cube();
  std::vector<Vec3> v(mesh.vertices().begin(), mesh.vertices().end());
  for (Vec3& p : v) p.z() *= 0.01;
  const TriangleMesh slab(v, {mesh.triangles().begin(), mesh.triangles().end()});
  const double radius = 0.01;
  const Trajectory path = make("cross", slab, 5000, radius);
  const std::vector<double> lengths = step_lengths(path);
  EXPECT_NEAR(median(lengths), 4 * radius, 1e-9);
  EXPECT_LE(most(lengths), 4 * radius * (1 + 1e-9));
  std::size_t through = 0, unnoticed = 0;
  const std::vector<double> distance = distances(path, slab);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const bool crossed = (path.positions[i].z() > 0.005) != (path.positions[i - 1].z() > 0.005);
    through += crossed ? 1 : 0;
    unnoticed += crossed && distance[i] > radius && distance[i - 1] > radius ? 1 : 0;
  }
  EXPECT_GT(through, 100u);
  EXPECT_GT(unnoticed, 10u);  // what only a swept query can find
}

TEST(Cross, PrefersTheThinParts) {
  // A cube with a slab beside it, of the same area.
  std::vector<Vec3> v;
  std::vector<TriangleMesh::Corners> t;
  const TriangleMesh one = cube();
  for (std::uint32_t part = 0; part < 2; ++part) {
    for (const Vec3& p : one.vertices())
      v.push_back(part == 0 ? p : Vec3(Vec3(3, 0, 0) + Vec3(1.7, 1.7, 0.02).cwiseProduct(p)));
    for (const TriangleMesh::Corners& c : one.triangles())
      t.push_back({c[0] + 8 * part, c[1] + 8 * part, c[2] + 8 * part});
  }
  const TriangleMesh mesh(v, t);
  const Trajectory path = make("cross", mesh, 5000, 0.01);
  std::size_t on_slab = 0;
  for (const Vec3& p : path.positions) on_slab += p.x() > 2.5 ? 1 : 0;
  EXPECT_GT(on_slab, 4500u);
}

TEST(Trajectories, RefuseAnUnknownNameAndListTheKnownOnes) {
  try {
    make("slied", cube(), 10, 0.01);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "unknown trajectory 'slied': it is one of slide, approach, hover, jump, tap, edge, cross, "
                 "hand, or a CSV file");
  }
}

TEST(Trajectories, MoveAsFastAsTheirNameSays) {
  const TriangleMesh mesh = torus();
  for (const double percent : {0.01, 0.4, 5.0}) {
    const double wanted = percent / 100 * mesh.diagonal();
    for (const char* shape : {"slide", "hover", "edge"}) {
      const std::string name = std::string(shape) + ":speed=" + std::to_string(percent) + "%";
      EXPECT_TRUE(is_generated(name));
      const Trajectory path = make(name, mesh, 400, 0.01 * mesh.diagonal());
      EXPECT_EQ(path.name, name);
      std::vector<double> steps;
      for (std::size_t i = 1; i < path.size(); ++i)
        steps.push_back((path.positions[i] - path.positions[i - 1]).norm());
      std::sort(steps.begin(), steps.end());
      // Back to the surface, or along its curve, a step is longer or shorter.
      EXPECT_GT(steps[steps.size() / 2], 0.5 * wanted) << name;
      EXPECT_LT(steps[steps.size() / 2], 2 * wanted) << name;
    }
  }
}

TEST(Trajectories, WithoutASpeedMoveAsWithTheirOwn) {
  const TriangleMesh mesh = torus();
  EXPECT_EQ(make("slide", mesh, 300, 0.02).positions, make("slide:speed=0.05%", mesh, 300, 0.02).positions);
  EXPECT_EQ(make("hover", mesh, 300, 0.02).positions, make("hover:speed=0.1%", mesh, 300, 0.02).positions);
  // What they say their own speed is, from where their short runs are no faster.
  for (const TrajectoryInfo& known : trajectories()) {
    if (known.own_percent == 0) continue;
    const std::string own = known.name + ":speed=" + std::to_string(known.own_percent) + "%";
    EXPECT_EQ(make(known.name, mesh, 8000, 0.02).positions, make(own, mesh, 8000, 0.02).positions) << own;
  }
  EXPECT_NE(make("slide", mesh, 300, 0.02).positions, make("slide:speed=0.06%", mesh, 300, 0.02).positions);
}

TEST(Trajectories, ApproachFasterInFewerTicks) {
  const TriangleMesh mesh = cube();
  const auto way = [&](const std::string& name) {
    const Trajectory path = make(name, mesh, 600, 0.01);
    double length = 0;
    for (std::size_t i = 1; i < path.size(); ++i)
      length += (path.positions[i] - path.positions[i - 1]).norm();
    return length;
  };
  EXPECT_GT(way("approach:speed=1%"), 5 * way("approach:speed=0.1%"));
}

TEST(Trajectories, RefuseASpeedThatMakesNoSense) {
  for (const char* name :
       {"slide:", "slide:speed", "slide:speed=", "slide:speed=0%", "slide:speed=1", "slide:speed=inf%",
        "slide:speed=51%", "slide:speed=-1%", "slide:pace=1%", "jump:speed=1%", "cross:speed=1%"}) {
    EXPECT_THROW(make(name, cube(), 10, 0.01), std::invalid_argument) << name;
  }
}

TEST(Trajectories, RefuseARadiusThatMakesNoSense) {
  EXPECT_THROW(make("slide", cube(), 10, -1), std::invalid_argument);
  EXPECT_THROW(make("slide", cube(), 10, std::nan("")), std::invalid_argument);
}

TEST(Trajectories, RefuseAMeshWhoseDiagonalOverflows) {
  EXPECT_THROW(make("jump", cube().transformed(1e200, Vec3::Zero()), 10, 1), std::invalid_argument);
}

TEST(Trajectories, JumpOnlyWhereTheyMustTakeOff) {
  // Between places a slide lands anew only from a dead end; on a closed smooth mesh there is none.
  const TriangleMesh mesh = torus();
  EXPECT_EQ(longer_than(0.0011 * mesh.diagonal(), step_lengths(make("slide", mesh, 20'000, 0.01))), 0u);
  for (const char* name : {"approach", "edge", "hover"}) {
    EXPECT_EQ(longer_than(0.01 * mesh.diagonal(), step_lengths(make(name, mesh, 20'000, 0.01))), 0u) << name;
  }
}

}  // namespace
}  // namespace touchmark::bench::trajectories
