#include "core/sign/side_finder.h"

#include <cmath>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "bench/oracle/exact/exact_winding.h"
#include "bench/oracle/judge.h"
#include "bench/oracle/oracle.h"
#include "tests/core/sign/closed_meshes.h"
#include "tests/core/sign/side_at.h"

namespace touchmark {

void PrintTo(Side side, std::ostream* out) {
  constexpr std::array<const char*, 5> names{"unasked", "outside", "inside", "on surface", "undecided"};
  *out << names[static_cast<std::size_t>(side)];
}

namespace {

using test::side_at, test::SignedBruteForce;

std::vector<bench::oracle::Triangle> triangles_of(const TriangleMesh& mesh) {
  std::vector<bench::oracle::Triangle> triangles;
  for (std::uint32_t i = 0; i < mesh.size(); ++i) triangles.push_back(bench::oracle::triangle_of(mesh, i));
  return triangles;
}

/// By the exact winding number, for solids: behind the faces.
Side truth(const Vec3& point, const std::vector<bench::oracle::Triangle>& triangles) {
  const std::optional<int> winding = bench::oracle::winding_exactly(point, triangles);
  if (!winding) return Side::on_surface;
  return *winding == 0 ? Side::outside : *winding > 0 ? Side::inside : Side::undecided;
}

void expect_true_sides(const Named& named, int count, std::uint64_t seed) {
  bench::support::Random random(seed);
  const SignedBruteForce detector = SignedBruteForce::build(named.mesh, {});
  const std::vector<bench::oracle::Triangle> triangles = triangles_of(named.mesh);
  for (const Vec3& point : telling_points(named.mesh, random, count)) {
    ASSERT_EQ(side_at(detector, point), truth(point, triangles))
        << named.name << " at " << std::hexfloat << point.transpose();
  }
}

TEST(SideFinder, AgreesWithTheExactWindingNumberOnSolids) {
  for (const Named& solid : solids()) expect_true_sides(solid, 40, 1);
}

TEST(SideFinder, AgreesWithTheExactWindingNumberWhereSurfacesCrossAndTouch) {
  for (const Named& tangle : tangles()) expect_true_sides(tangle, 40, 2);
}

TEST(SideFinder, AgreesWithTheExactWindingNumberFarFromTheOriginTinyAndHuge) {
  for (const Named& solid : solids()) {
    for (const double scale : {1e-9, 1.0, 1e9}) {
      for (const double shift : {0.0, 1e9}) {
        const std::string name = solid.name + " * " + std::to_string(scale) + " + " + std::to_string(shift);
        expect_true_sides({name, moved(solid.mesh, scale, Vec3::Constant(shift * scale))}, 4, 3);
      }
    }
  }
}

TEST(SideFinder, BehindTheFacesIsInsideThoughTheMeshBeInsideOut) {
  const SignedBruteForce room = SignedBruteForce::build(turned_over(bench::meshes::icosphere(2)), {});
  EXPECT_TRUE(room.sides().surface().inside_out);
  bench::support::Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Vec3 direction = random.direction();
    EXPECT_EQ(side_at(room, 0.9 * direction), Side::outside);
    EXPECT_EQ(side_at(room, 1.1 * direction), Side::inside);
  }
}

/// Thinner than any rounding of the volume: closed, and of the orientation given.
TriangleMesh leaf(double thickness, bool inwards) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, thickness}},
                          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  return inwards ? turned_over(mesh) : mesh;
}

TEST(SideFinder, AVolumeBelowRoundingHasItsSignAllTheSame) {
  for (const bool inwards : {false, true}) {
    for (const double thickness : {1e-17, 1e-30, 0x1p-1074}) {
      for (const double scale : {0x1p-40, 1.0, 0x1p40}) {
        if (thickness * scale == 0) continue;
        const TriangleMesh mesh = moved(leaf(thickness, inwards), scale, Vec3::Zero());
        const bench::oracle::ExactSides oracle(mesh);
        const SignedBruteForce detector = SignedBruteForce::build(mesh, {});
        for (const Vec3& point : {Vec3(5, 5, 5), Vec3(0.25, 0.25, -1), Vec3(0.3, 0.3, 1e-3)}) {
          EXPECT_EQ(side_at(detector, scale * point), oracle.side(scale * point))
              << thickness << ' ' << scale;
          EXPECT_EQ(side_at(detector, scale * point), inwards ? Side::inside : Side::outside)
              << thickness << ' ' << scale;
        }
      }
    }
  }
}

TEST(SideFinder, AMeshThatEnclosesAsMuchEitherWayIsNotInsideOut) {
  const TriangleMesh cube = bench::meshes::cube();
  const TriangleMesh both = together({cube, turned_over(moved(cube, 1, {4, 0, 0}))});
  const TriangleMesh flat = together({leaf(0, false), leaf(0, true)});
  for (const TriangleMesh* mesh : {&both, &flat}) {
    const bench::oracle::ExactSides oracle(*mesh);
    const SignedBruteForce detector = SignedBruteForce::build(*mesh, {});
    EXPECT_FALSE(detector.sides().surface().inside_out);
    for (const Vec3& point : {Vec3(0.1, 0.2, 0.3), Vec3(4.1, 0.2, 0.3), Vec3(9, 9, 9)})
      EXPECT_EQ(side_at(detector, point), oracle.side(point)) << point.transpose();
  }
}

TEST(SideFinder, AShellTurnedAgainstTheRestIsUndecidedWithinAndTheRestIsNotDisturbed) {
  const TriangleMesh ball = bench::meshes::icosphere(1);
  const SignedBruteForce detector =
      SignedBruteForce::build(together({ball, turned_over(moved(ball, 0.5, {3, 0, 0}))}), {});
  EXPECT_FALSE(detector.sides().surface().inside_out);
  EXPECT_EQ(side_at(detector, {0.1, 0.2, 0.3}), Side::inside);
  EXPECT_EQ(side_at(detector, {1.5, 0, 0}), Side::outside);
  EXPECT_EQ(side_at(detector, {2.4, 0, 0}), Side::outside);  // nearest is the shell turned over
  EXPECT_EQ(side_at(detector, {3.1, 0, 0}), Side::undecided);
}

TEST(SideFinder, DecidesByPseudonormalsWhereNothingIsDifficult) {
  const TriangleMesh mesh = bench::meshes::noisy_sphere(2000);
  const SignedBruteForce detector = SignedBruteForce::build(mesh, {});
  EXPECT_EQ(detector.sides().surface().method, SideFinder::Method::pseudonormals);
  SignedBruteForce::Session session;
  bench::support::Random random(5);
  constexpr int count = 2000;
  for (int i = 0; i < count; ++i)
    detector.nearest({1.5 * random.unit() * random.direction(), 0}, infinity, session);
  EXPECT_LT(session.counted, count / 20u);
}

TEST(SideFinder, PiecesOfAPolygonAreToldApart) {
  const TriangleMesh cube = bench::meshes::cube();
  const TriangleMesh squares{{cube.vertices().begin(), cube.vertices().end()},
                             {cube.triangles().begin(), cube.triangles().end()},
                             {0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 9, 9}};
  const SignedBruteForce by_squares = SignedBruteForce::build(squares, {}),
                         by_triangles = SignedBruteForce::build(cube, {});
  bench::support::Random random(6);
  for (const Vec3& point : telling_points(cube, random, 100))
    ASSERT_EQ(side_at(by_squares, point), side_at(by_triangles, point)) << point.transpose();
}

TEST(SideFinder, MovingTheCentreByOneRoundingThroughAFaceChangesTheSide) {
  const SignedBruteForce cube = SignedBruteForce::build(bench::meshes::cube(), {});
  EXPECT_EQ(side_at(cube, {0.5, 0.1, 0.2}), Side::on_surface);
  EXPECT_EQ(side_at(cube, {std::nextafter(0.5, 1), 0.1, 0.2}), Side::outside);
  EXPECT_EQ(side_at(cube, {std::nextafter(0.5, 0), 0.1, 0.2}), Side::inside);
}

/// One that errs, and says so.
class Mistaken {
 public:
  struct Options {};
  struct Session {
    Work work;
  };
  static Mistaken build(const TriangleMesh&, const Options&) { return {}; }
  std::optional<Contact> nearest(const Probe& probe, double, Session&) const noexcept {
    return Contact{probe.center, Vec3::UnitX(), 0, 0};
  }
  std::size_t bytes() const noexcept { return 0; }
  Accuracy accuracy() const noexcept { return {Guarantee::approximate, 0, 0, false}; }
};

TEST(SideFinder, DoesNotTrustTheContactOfAnApproximateDetector) {
  const TriangleMesh ball = bench::meshes::icosphere(2);
  const auto detector = Signed<Mistaken>::build(ball, {});
  const std::vector<bench::oracle::Triangle> triangles = triangles_of(ball);
  Signed<Mistaken>::Session session;
  bench::support::Random random(7);
  for (const Vec3& point : telling_points(ball, random, 20))
    ASSERT_EQ(detector.nearest({point, 0}, infinity, session)->side, truth(point, triangles));
}

TEST(SideFinder, ASweepTellsTheSideItTouchesFrom) {
  const SignedBruteForce cube = SignedBruteForce::build(bench::meshes::cube(), {});
  SignedBruteForce::Session session;
  EXPECT_EQ(cube.first_hit({{2, 0.1, 0.2}, {-2, 0.1, 0.2}, 0.1}, session)->contact.side, Side::outside);
  EXPECT_EQ(cube.first_hit({{0.1, 0.1, 0.2}, {2, 0.1, 0.2}, 0.1}, session)->contact.side, Side::inside);
}

TEST(SideFinder, TheJudgeCatchesAWrongSideAndExcusesWhoDoesNotSay) {
  const TriangleMesh cube = bench::meshes::cube();
  const bench::oracle::Oracle oracle(cube, 1);
  const std::array<Probe, 2> probes{{{{0.1, 0.2, 0.3}, 0}, {{0.7, 0.2, 0.3}, 0}}};
  const std::vector<bench::oracle::GroundTruth> truths = oracle.solve(std::span<const Probe>(probes));
  const BruteForce detector = BruteForce::build(cube);
  const auto judged = [&](Side first, Side second) {
    std::vector<bench::workload::Answer> answers;
    for (const Probe& probe : probes) {
      BruteForce::Session session;
      answers.push_back(bench::workload::Answer::of(*detector.nearest(probe, infinity, session)));
    }
    answers[0].side = first;
    answers[1].side = second;
    return bench::oracle::judge(oracle, truths, bench::workload::Query::nearest, probes, infinity, answers,
                                detector.accuracy());
  };
  EXPECT_EQ(judged(Side::inside, Side::outside).wrong_side, 0u);
  EXPECT_EQ(judged(Side::undecided, Side::unasked).wrong_side, 0u);
  EXPECT_EQ(judged(Side::inside, Side::inside).wrong_side, 1u);
  EXPECT_EQ(judged(Side::on_surface, Side::inside).wrong_side, 2u);
  EXPECT_TRUE(bench::oracle::meets_guarantee(judged(Side::inside, Side::outside), detector.accuracy()));
  EXPECT_FALSE(bench::oracle::meets_guarantee(judged(Side::outside, Side::outside),
                                              {Guarantee::approximate, 0, 0, false}));
}

TEST(SideFinder, WhoDoesNotAskIsNotTold) {
  BruteForce::Session session;
  EXPECT_EQ(BruteForce::build(bench::meshes::cube()).nearest({{1, 0, 0}, 0}, infinity, session)->side,
            Side::unasked);
}

}  // namespace
}  // namespace touchmark
